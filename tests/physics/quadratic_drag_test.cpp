#include <pantin/physics/forces/quadratic_drag.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <support/hand_made_bodies.hpp>
#include <support/hand_made_particles.hpp>
#include <support/law_order.hpp>
#include <support/problems.hpp>

namespace pantin {
namespace {

using test::expect_problem;
using test::near;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(QuadraticDrag, GoesWithTheSquareOfTheVelocityAgainstTheMedium) {
  // v - u = (3, 4, 0), of size 5: F = -2 * 5 * (3, 4, 0); w = (0, 0, 2): T = -3 * 2 * (0, 0, 2).
  test::HandMadeBodies bodies;
  bodies.add({}, {.v_WBcm = {4, 4, 0}, .w_WB = {0, 0, 2}});
  test::HandMadeParticles particles;
  particles.add({7, 8, 9}, {4, 4, 0}, 0.1);
  const QuadraticDrag drag{.coefficient = 2, .angular_coefficient = 3, .medium_velocity = {1, 0, 0}};
  const std::unique_ptr<ForceLaw> law = make_law(drag);
  EXPECT_TRUE(near(test::wrenches_of(*law, bodies)[0].force, Vector3{-30, -40, 0}, 1e-15, 40));
  EXPECT_TRUE(near(test::wrenches_of(*law, bodies)[0].torque, Vector3{0, 0, -12}, 1e-15, 12));
  EXPECT_TRUE(near(test::forces_of(*law, particles)[0], Vector3{-30, -40, 0}, 1e-15, 40));
  EXPECT_TRUE(law->depends_on_velocity());
  EXPECT_FALSE(make_law(QuadraticDrag{})->depends_on_velocity());
  EXPECT_EQ(law->potential_energy(bodies.at()), 0);
}

TEST(QuadraticDrag, SlowsABodyAsTheClosedFormSays) {
  // m v' = -c v^2 along a line: v = v0 / (1 + c v0 t / m), x = m / c ln(1 + c v0 t / m). rk4 errs by 1e-9 at
  // this step; angular drag does the same to the spin about a principal axis.
  PhysicsManager physics;
  const BodyId body = physics.add(RigidBodySettings{
      .v_WBcm = {4, 0, 0}, .w_WB = {0, 0, 5}, .mass = {.mass = 2, .I_BBcm_B = Matrix3::Identity()}});
  physics.forces().add(QuadraticDrag{.body = body, .coefficient = 0.5, .angular_coefficient = 0.3});
  ASSERT_TRUE(test::run(physics, 0.01, 100));
  EXPECT_NEAR(physics.body(body).v_WBcm().x(), 4 / (1 + 0.25 * 4), 1e-8);
  EXPECT_NEAR(physics.body(body).p_WBcm().x(), 4 * std::log(2), 1e-8);
  EXPECT_NEAR(physics.body(body).w_WB().z(), 5 / (1 + 0.3 * 5), 1e-8);
}

TEST(QuadraticDrag, LetsIntegratorsKeepTheirOrder) {
  // It is smooth where the velocity is not that of the medium. The body spins fast: hence the short steps.
  test::expect_order_4(
      QuadraticDrag{.coefficient = 0.8, .angular_coefficient = 0.02, .medium_velocity = {5, 6, 7}}, 1, 200);
}

TEST(QuadraticDrag, ActsOnWhatItNames) {
  // One body, one system, or all.
  std::mt19937_64 random{1};
  test::HandMadeBodies bodies;
  const BodyId a = bodies.add_random(random);
  bodies.add_random(random);
  const ParticleSystemId system{.index = 3, .generation = 1}, other{.index = 4, .generation = 1};
  const std::unique_ptr<ForceLaw> one = make_law(QuadraticDrag{.body = a, .coefficient = 1});
  EXPECT_NE(test::wrenches_of(*one, bodies)[0].force, Vector3::Zero());
  EXPECT_EQ(test::wrenches_of(*one, bodies)[1].force, Vector3::Zero());
  EXPECT_EQ(one->acts_on(system), ParticleAction::None);
  EXPECT_TRUE(one->names(a));
  const std::unique_ptr<ForceLaw> those = make_law(QuadraticDrag{.coefficient = 1, .particles = system});
  EXPECT_EQ(test::wrenches_of(*those, bodies)[0].force, Vector3::Zero());
  EXPECT_EQ(those->acts_on(system), ParticleAction::Each);
  EXPECT_EQ(those->acts_on(other), ParticleAction::None);
  EXPECT_FALSE(those->names({}));
}

TEST(QuadraticDragProblem, SaysWhatIsWrong) {
  // One text a rule.
  EXPECT_FALSE(problem_with(QuadraticDrag{}));
  expect_problem(problem_with(QuadraticDrag{.body = {1, 1}, .particles = {1, 1}}), ProblemCode::OutOfRange,
                 "quadratic drag: both a body and a particle system are named");
  expect_problem(problem_with(QuadraticDrag{.coefficient = -1}), ProblemCode::OutOfRange,
                 "quadratic drag: coefficient is -1 N s^2/m^2");
  expect_problem(problem_with(QuadraticDrag{.angular_coefficient = -1}), ProblemCode::OutOfRange,
                 "quadratic drag: angular coefficient is -1 N m s^2/rad^2");
  expect_problem(problem_with(QuadraticDrag{.medium_velocity = {0, kNaN, 0}}), ProblemCode::NotFinite,
                 "quadratic drag: medium velocity is (0, nan, 0) m/s");
}

}  // namespace
}  // namespace pantin
