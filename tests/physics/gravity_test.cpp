#include <pantin/physics/forces/gravity.hpp>

#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <support/hand_made_bodies.hpp>
#include <support/problems.hpp>

namespace pantin {
namespace {

using test::expect_problem;
using test::near;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Gravity, PullsEachBodyByItsMassAtItsCentreOfGravity) {
  // F = m g, no torque about the centre of gravity, and what was there before stays: closed form.
  std::mt19937_64 random{1};
  test::HandMadeBodies bodies;
  for (int i = 0; i < 20; ++i) bodies.add_random(random);
  std::vector<Wrench> wrenches(20, Wrench{{1, 2, 3}, {4, 5, 6}});
  const Vector3 g{0.5, -1, -9};
  make_law(Gravity{.g_W = g})->add_wrenches(bodies.at(), wrenches);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(wrenches[i].force, (Vector3{1, 2, 3} + bodies.masses[i].mass * g));
    EXPECT_EQ(wrenches[i].torque, (Vector3{4, 5, 6}));
  }
}

TEST(Gravity, HasThePotentialOfTheSimulatedBodies) {
  // -m g . p of the centre of gravity: 2 kg at 3 m under 10 m/s^2 make 60 J; animated and static bodies have
  // no energy.
  test::HandMadeBodies bodies;
  const BodyKinematics high{.p_WBcm = {7, 8, 3}};
  bodies.add({.mass = 2}, high);
  bodies.add({.mass = 2}, high, BodyKind::Animated);
  bodies.add({.mass = 2}, high, BodyKind::Static);
  EXPECT_DOUBLE_EQ(make_law(Gravity{.g_W = {0, 0, -10}})->potential_energy(bodies.at()), 60);
}

TEST(Gravity, IsMinusTheGradientOfItsPotential) {
  // Any displacement, any body.
  std::mt19937_64 random{2};
  test::HandMadeBodies bodies;
  for (int i = 0; i < 5; ++i) bodies.add_random(random);
  test::expect_minus_gradient(*make_law(Gravity{.g_W = {1, 2, -9}}), bodies, 100);
}

TEST(Gravity, NamesNobodyAndLooksAtNoVelocity) {
  // It acts on all bodies alike and must not vanish with one of them.
  const std::unique_ptr<ForceLaw> law = make_law(Gravity{});
  EXPECT_FALSE(law->names({.index = 1, .generation = 1}));
  EXPECT_FALSE(law->names({}));
  EXPECT_FALSE(law->depends_on_velocity());
}

TEST(GravityProblem, SaysWhereTheAccelerationIsNotFinite) {
  // Zero gravity is fine, NaN is not.
  EXPECT_FALSE(problem_with(Gravity{.g_W = {0, 0, 0}}));
  expect_problem(problem_with(Gravity{.g_W = {0, 0, kNaN}}), ProblemCode::NotFinite,
                 "gravity: acceleration is (0, 0, nan) m/s^2");
}

}  // namespace
}  // namespace pantin
