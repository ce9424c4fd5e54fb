#include <pantin/physics/forces/constant_load.hpp>

#include <cmath>
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

/// One body turned by 90 degrees about z, its centre of gravity at (1, 2, 3), 0.5 m along x_B from its
/// origin.
struct TurnedBody {
  test::HandMadeBodies bodies{};
  BodyId id =
      bodies.add({.mass = 2, .p_BBcm = {0.5, 0, 0}},
                 {.p_WBcm = {1, 2, 3},
                  .R_WB = Eigen::AngleAxisd{std::acos(-1.0) / 2, Vector3::UnitZ()}.toRotationMatrix()});
};

TEST(ConstantLoad, InWorldAxesKeepsItsDirection) {
  // Acts at p_BQ = (1.5, 0, 0), 1 m along x_B from the centre of gravity; x_B is y_W, so F x_W makes the
  // torque (0,1,0) x (4,0,0) = (0,0,-4), besides the one given.
  TurnedBody turned;
  const std::unique_ptr<ForceLaw> law =
      make_law(ConstantLoad{.body = turned.id, .force = {4, 0, 0}, .torque = {0, 7, 0}, .p_BQ = {1.5, 0, 0}});
  const Wrench wrench = test::wrenches_of(*law, turned.bodies)[0];
  EXPECT_EQ(wrench.force, (Vector3{4, 0, 0}));
  EXPECT_TRUE(near(wrench.torque, Vector3{0, 7, -4}, 1e-15));
}

TEST(ConstantLoad, InBodyAxesTurnsWithTheBody) {
  // x_B is y_W: the force along x_B passes through the centre of gravity, the torque about x_B is one about
  // y_W.
  TurnedBody turned;
  const std::unique_ptr<ForceLaw> law = make_law(ConstantLoad{.body = turned.id,
                                                              .force = {4, 0, 0},
                                                              .torque = {7, 0, 0},
                                                              .p_BQ = {1.5, 0, 0},
                                                              .axes = LoadAxes::Body});
  const Wrench wrench = test::wrenches_of(*law, turned.bodies)[0];
  EXPECT_TRUE(near(wrench.force, Vector3{0, 4, 0}, 1e-15));
  EXPECT_TRUE(near(wrench.torque, Vector3{0, 7, 0}, 1e-15));
}

TEST(ConstantLoad, ActsOnItsBodyOnly) {
  // The wrench of the body before and the body after stays zero.
  std::mt19937_64 random{3};
  test::HandMadeBodies bodies;
  bodies.add_random(random);
  const BodyId middle = bodies.add_random(random);
  bodies.add_random(random);
  const std::vector<Wrench> wrenches =
      test::wrenches_of(*make_law(ConstantLoad{.body = middle, .force = {1, 1, 1}}), bodies);
  EXPECT_EQ(wrenches[0].force, Vector3::Zero());
  EXPECT_EQ(wrenches[1].force, Vector3::Ones());
  EXPECT_EQ(wrenches[2].force, Vector3::Zero());
}

TEST(ConstantLoad, InWorldAxesIsMinusTheGradientOfItsPotential) {
  // A constant force at a point of the body has the potential -F . p, whose derivative by rotation is its
  // torque.
  std::mt19937_64 random{4};
  test::HandMadeBodies bodies;
  const BodyId body = bodies.add_random(random);
  test::expect_minus_gradient(
      *make_law(ConstantLoad{.body = body, .force = {1, 2, 3}, .p_BQ = {0.3, -0.2, 0.9}}), bodies, 30);
}

TEST(ConstantLoad, HasNoPotentialInBodyAxesOrOnAnAnimatedBody) {
  // A force that turns with the body does work on a closed path; work on an animated body is nobody's energy.
  TurnedBody turned;
  ConstantLoad load{.body = turned.id, .force = {4, 0, 0}, .axes = LoadAxes::Body};
  EXPECT_EQ(make_law(load)->potential_energy(turned.bodies.at()), 0);
  load.axes = LoadAxes::World;
  EXPECT_NE(make_law(load)->potential_energy(turned.bodies.at()), 0);
  turned.bodies.kinds[0] = BodyKind::Animated;
  EXPECT_EQ(make_law(load)->potential_energy(turned.bodies.at()), 0);
}

TEST(ConstantLoad, NamesItsBodyAndLooksAtNoVelocity) {
  // Another index or generation is another body; null is none.
  const std::unique_ptr<ForceLaw> law = make_law(ConstantLoad{.body = {.index = 4, .generation = 2}});
  EXPECT_TRUE(law->names({.index = 4, .generation = 2}));
  EXPECT_FALSE(law->names({.index = 4, .generation = 3}));
  EXPECT_FALSE(law->names({.index = 5, .generation = 2}));
  EXPECT_FALSE(law->names({}));
  EXPECT_FALSE(law->depends_on_velocity());
}

constexpr BodyId kSomeBody{.index = 1, .generation = 1};

TEST(ConstantLoadProblem, SaysWhereThereIsNoBody) {
  // The world cannot be pushed.
  EXPECT_FALSE(problem_with(ConstantLoad{.body = kSomeBody}));
  expect_problem(problem_with(ConstantLoad{}), ProblemCode::UnknownEntity, "constant load: body is null");
}

TEST(ConstantLoadProblem, SaysWhereTheForceIsNotFinite) {
  // One NaN of three.
  expect_problem(problem_with(ConstantLoad{.body = kSomeBody, .force = {0, kNaN, 0}}), ProblemCode::NotFinite,
                 "constant load: force is (0, nan, 0) N");
}

TEST(ConstantLoadProblem, SaysWhereTheTorqueIsNotFinite) {
  // One NaN of three.
  expect_problem(problem_with(ConstantLoad{.body = kSomeBody, .torque = {kNaN, 0, 0}}),
                 ProblemCode::NotFinite, "constant load: torque is (nan, 0, 0) N m");
}

TEST(ConstantLoadProblem, SaysWhereThePointIsNotFinite) {
  // One NaN of three.
  expect_problem(problem_with(ConstantLoad{.body = kSomeBody, .p_BQ = {0, 0, kNaN}}), ProblemCode::NotFinite,
                 "constant load: point is (0, 0, nan) m");
}

}  // namespace
}  // namespace pantin
