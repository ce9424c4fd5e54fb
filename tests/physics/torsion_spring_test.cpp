#include <pantin/physics/forces/torsion_spring.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <support/hand_made_bodies.hpp>
#include <support/problems.hpp>

#include <pantin/physics/physics_manager.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::expect_problem;
using test::near;

Quaternion turned(double angle, const Vector3& axis) { return Quaternion{Eigen::AngleAxisd{angle, axis}}; }

/// Two bodies in any state with a torsion spring, about all axes or about one.
struct TwistedPair {
  TwistedPair(std::mt19937_64& random, bool about_axis) {
    settings = {.a = bodies.add_random(random),
                .b = bodies.add_random(random),
                .q_AB = test::random_rotation(random),
                .stiffness = 20,
                .damping = 3};
    if (about_axis) settings.axis_A = test::random_vector(random).normalized();
  }
  test::HandMadeBodies bodies{};
  TorsionSpring settings{};
};

TEST(TorsionSpring, TurnsBackByStiffnessTimesAnglePlusDampingTimesRate) {
  // Turned by 0.5 rad about z from a rest attitude and turning at 2 rad/s: 10 * 0.5 + 3 * 2 = 11 N m back,
  // with the axis given or not.
  test::HandMadeBodies bodies;
  const Quaternion rest = turned(1.1, Vector3{1, 2, 2} / 3);
  const BodyId b =
      bodies.add({}, {.R_WB = (turned(0.5, Vector3::UnitZ()) * rest).toRotationMatrix(), .w_WB = {0, 0, 2}});
  TorsionSpring spring{.b = b, .q_AB = rest, .stiffness = 10, .damping = 3};
  EXPECT_TRUE(near(test::wrenches_of(*make_law(spring), bodies)[0].torque, Vector3{0, 0, -11}, 1e-14, 11));
  EXPECT_NEAR(make_law(spring)->potential_energy(bodies.at()), 1.25, 1e-14);
  spring.axis_A = Vector3::UnitZ();
  EXPECT_TRUE(near(test::wrenches_of(*make_law(spring), bodies)[0].torque, Vector3{0, 0, -11}, 1e-14, 11));
  EXPECT_EQ(test::wrenches_of(*make_law(spring), bodies)[0].force, Vector3::Zero());
}

TEST(TorsionSpring, TakesTheShorterWay) {
  // 3/2 pi about z is a quarter turn the other way.
  test::HandMadeBodies bodies;
  const BodyId b =
      bodies.add({}, {.R_WB = turned(1.5 * std::numbers::pi, Vector3::UnitZ()).toRotationMatrix()});
  const Vector3 forward{0, 0, 5 * std::numbers::pi};
  TorsionSpring spring{.b = b, .stiffness = 10};
  EXPECT_TRUE(near(test::wrenches_of(*make_law(spring), bodies)[0].torque, forward, 1e-14, 16));
  spring.axis_A = Vector3::UnitZ();
  EXPECT_TRUE(near(test::wrenches_of(*make_law(spring), bodies)[0].torque, forward, 1e-14, 16));
}

TEST(TorsionSpring, AboutAnAxisLeavesSwingFree) {
  // A swing about x has no twist about z.
  test::HandMadeBodies bodies;
  const BodyId b = bodies.add({}, {.R_WB = turned(1, Vector3::UnitX()).toRotationMatrix()});
  const std::unique_ptr<ForceLaw> law =
      make_law(TorsionSpring{.b = b, .axis_A = Vector3::UnitZ(), .stiffness = 10});
  EXPECT_LT(test::wrenches_of(*law, bodies)[0].torque.norm(), 1e-15);
  EXPECT_LT(law->potential_energy(bodies.at()), 1e-30);
}

TEST(TorsionSpring, IsMinusTheGradientOfItsPotential) {
  // For rotations of both bodies, about all axes and about one.
  std::mt19937_64 random{21};
  for (int round = 0; round < 40; ++round) {
    TwistedPair pair{random, round % 2 == 1};
    pair.settings.damping = 0;
    // Near half a turn the potential has its edge, and across it there is no derivative.
    const double energy = make_law(pair.settings)->potential_energy(pair.bodies.at());
    if (energy > 10 * std::pow(std::numbers::pi - 0.2, 2)) continue;
    test::expect_minus_gradient(*make_law(pair.settings), pair.bodies, 1000);
  }
}

TEST(TorsionSpring, ActsEquallyAndOppositelyAndItsDamperTakesEnergy) {
  // The torques cancel; the power of the damper alone is never above zero.
  std::mt19937_64 random{22};
  for (int round = 0; round < 100; ++round) {
    TwistedPair pair{random, round % 2 == 1};
    std::vector<Wrench> w = test::wrenches_of(*make_law(pair.settings), pair.bodies);
    EXPECT_EQ(w[0].torque, -w[1].torque);
    pair.settings.stiffness = 0;
    w = test::wrenches_of(*make_law(pair.settings), pair.bodies);
    const double power =
        w[0].torque.dot(pair.bodies.bodies[0].w_WB) + w[1].torque.dot(pair.bodies.bodies[1].w_WB);
    EXPECT_LT(power, 0);
  }
}

TEST(TorsionSpring, MakesASphereSwingAsAnOscillator) {
  // Moments of inertia all I: the angle about a fixed axis is 0.8 cos(sqrt(k / I) t), however large. rk4
  // errs by 2e-8 at 25 steps a radian of phase; energy likewise.
  PhysicsManager physics;
  const Vector3 axis = Vector3{2, -1, 2} / 3;
  const BodyId b = physics.add(RigidBodySettings{.X_WB = {.q = turned(0.8, axis)},
                                                 .mass = {.mass = 1, .I_BBcm_B = 0.5 * Matrix3::Identity()}});
  physics.forces().add(TorsionSpring{.b = b, .stiffness = 8});
  const double energy = physics.energy().total();
  EXPECT_NEAR(energy, 0.5 * 8 * 0.64, 1e-14);
  ASSERT_TRUE(test::run(physics, 0.01, 200));
  const Quaternion expected = turned(0.8 * std::cos(8.0), axis);
  EXPECT_LT((physics.body(b).q_WB().conjugate() * expected).vec().norm(), 1e-7);
  EXPECT_NEAR(physics.energy().total(), energy, 1e-7);
}

TEST(TorsionSpring, NamesBothEndsAndLooksAtVelocitiesWhereItDamps) {
  // The world's end is no body.
  const BodyId a{.index = 4, .generation = 2}, b{.index = 6, .generation = 1};
  const std::unique_ptr<ForceLaw> law = make_law(TorsionSpring{.a = a, .b = b});
  EXPECT_TRUE(law->names(a));
  EXPECT_TRUE(law->names(b));
  EXPECT_FALSE(make_law(TorsionSpring{.b = b})->names({}));
  EXPECT_FALSE(law->depends_on_velocity());
  EXPECT_TRUE(make_law(TorsionSpring{.b = b, .damping = 1})->depends_on_velocity());
}

TEST(TorsionSpringProblem, SaysWhatIsWrong) {
  // One text a rule.
  const BodyId b{.index = 6, .generation = 1};
  EXPECT_FALSE(problem_with(TorsionSpring{.b = b}));
  expect_problem(problem_with(TorsionSpring{}), ProblemCode::UnknownEntity, "both ends are on the world");
  expect_problem(problem_with(TorsionSpring{.a = b, .b = b}), ProblemCode::UnknownEntity,
                 "both ends are one body");
  expect_problem(problem_with(TorsionSpring{.b = b, .q_AB = Quaternion{2, 0, 0, 0}}), ProblemCode::NotUnit,
                 "torsion spring: rest attitude is");
  expect_problem(problem_with(TorsionSpring{.b = b, .axis_A = Vector3{1, 1, 0}}), ProblemCode::NotUnit,
                 "torsion spring: axis is (1, 1, 0)");
  expect_problem(problem_with(TorsionSpring{.b = b, .stiffness = -1}), ProblemCode::OutOfRange,
                 "torsion spring: stiffness is -1 N m/rad");
  expect_problem(problem_with(TorsionSpring{.b = b, .damping = -1}), ProblemCode::OutOfRange,
                 "torsion spring: damping is -1 N m s/rad");
}

}  // namespace
}  // namespace pantin
