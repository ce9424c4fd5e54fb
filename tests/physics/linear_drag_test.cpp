#include <pantin/physics/forces/linear_drag.hpp>

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

TEST(LinearDrag, OpposesVelocityAgainstTheMediumOfEveryBody) {
  // F = -c (v - u), T = -k w: closed form, for all bodies where none is named.
  std::mt19937_64 random{5};
  test::HandMadeBodies bodies;
  for (int i = 0; i < 10; ++i) bodies.add_random(random);
  const Vector3 u{1, -2, 3};
  const std::vector<Wrench> wrenches = test::wrenches_of(
      *make_law(LinearDrag{.coefficient = 0.5, .angular_coefficient = 0.25, .medium_velocity = u}), bodies);
  for (std::size_t i = 0; i < wrenches.size(); ++i) {
    EXPECT_TRUE(near(wrenches[i].force, Vector3{-0.5 * (bodies.bodies[i].v_WBcm - u)}, 1e-15));
    EXPECT_TRUE(near(wrenches[i].torque, Vector3{-0.25 * bodies.bodies[i].w_WB}, 1e-15));
  }
}

TEST(LinearDrag, ActsOnOneBodyWhereItIsNamed) {
  // The neighbours in the arrays feel nothing.
  std::mt19937_64 random{6};
  test::HandMadeBodies bodies;
  bodies.add_random(random);
  const BodyId middle = bodies.add_random(random);
  bodies.add_random(random);
  const std::vector<Wrench> wrenches =
      test::wrenches_of(*make_law(LinearDrag{.body = middle, .coefficient = 2}), bodies);
  EXPECT_EQ(wrenches[0].force, Vector3::Zero());
  EXPECT_EQ(wrenches[1].force, (-2 * bodies.bodies[1].v_WBcm).eval());
  EXPECT_EQ(wrenches[2].force, Vector3::Zero());
}

TEST(LinearDrag, TakesEnergyFromWhateverMovesInAMediumAtRest) {
  // Its power F . v + T . w = -c v^2 - k w^2 is negative.
  std::mt19937_64 random{7};
  test::HandMadeBodies bodies;
  for (int i = 0; i < 10; ++i) bodies.add_random(random);
  const std::vector<Wrench> wrenches =
      test::wrenches_of(*make_law(LinearDrag{.coefficient = 0.5, .angular_coefficient = 0.25}), bodies);
  for (std::size_t i = 0; i < wrenches.size(); ++i) {
    EXPECT_LT(wrenches[i].force.dot(bodies.bodies[i].v_WBcm), 0);
    EXPECT_LT(wrenches[i].torque.dot(bodies.bodies[i].w_WB), 0);
  }
}

TEST(LinearDrag, HasNoPotentialAndLooksAtVelocitiesUnlessItIsZero) {
  // Drag dissipates; one with both coefficients zero is no reason for integrators to evaluate again.
  test::HandMadeBodies bodies;
  bodies.add({}, {});
  EXPECT_EQ(make_law(LinearDrag{.coefficient = 1})->potential_energy(bodies.at()), 0);
  EXPECT_TRUE(make_law(LinearDrag{.coefficient = 1})->depends_on_velocity());
  EXPECT_TRUE(make_law(LinearDrag{.angular_coefficient = 1})->depends_on_velocity());
  EXPECT_FALSE(make_law(LinearDrag{})->depends_on_velocity());
}

TEST(LinearDrag, NamesTheBodyItIsLimitedTo) {
  // One for all bodies names none and stays when a body goes.
  const BodyId body{.index = 4, .generation = 2};
  EXPECT_TRUE(make_law(LinearDrag{.body = body})->names(body));
  EXPECT_FALSE(make_law(LinearDrag{.body = body})->names({.index = 4, .generation = 1}));
  EXPECT_FALSE(make_law(LinearDrag{})->names(body));
  EXPECT_FALSE(make_law(LinearDrag{})->names({}));
}

TEST(LinearDragProblem, SaysWhereTheCoefficientIsNegative) {
  // Drag that pushes is no drag.
  EXPECT_FALSE(problem_with(LinearDrag{}));
  expect_problem(problem_with(LinearDrag{.coefficient = -1}), ProblemCode::OutOfRange,
                 "linear drag: coefficient is -1 N s/m");
}

TEST(LinearDragProblem, SaysWhereTheAngularCoefficientIsNegative) {
  // As for the coefficient.
  expect_problem(problem_with(LinearDrag{.angular_coefficient = -2}), ProblemCode::OutOfRange,
                 "linear drag: angular coefficient is -2 N m s/rad");
}

TEST(LinearDragProblem, SaysWhereACoefficientIsNotFinite) {
  // NaN compares as neither negative nor positive.
  expect_problem(problem_with(LinearDrag{.coefficient = kNaN}), ProblemCode::NotFinite, "coefficient is nan");
  expect_problem(problem_with(LinearDrag{.angular_coefficient = kNaN}), ProblemCode::NotFinite,
                 "angular coefficient is nan");
}

TEST(LinearDragProblem, SaysWhereTheMediumVelocityIsNotFinite) {
  // One NaN of three.
  expect_problem(problem_with(LinearDrag{.medium_velocity = {kNaN, 0, 0}}), ProblemCode::NotFinite,
                 "linear drag: medium velocity is (nan, 0, 0) m/s");
}

}  // namespace
}  // namespace pantin
