#include <pantin/physics/constraints/closure.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pantin/physics/integrators/dormand_prince.hpp>
#include <pantin/physics/integrators/gauss.hpp>

#include "support/four_bar.hpp"
#include "support/two_hands.hpp"

namespace pantin {
namespace {

using test::FourBar;
using test::joint_here;
using test::lopsided_mass;
using test::run;
using test::TwoHands;

TEST(Closure, MovesAFourBarAsItsOneCoordinateDoes) {
  // Four pivots in space hold a planar four-bar with five rows, of which three are redundant. Its motion in
  // one coordinate is a quadrature (FourBar::time). dormand-prince at 1e-12 a second leaves some 1e-12.
  FourBar bar;
  bar.physics.set_integrator(make_dormand_prince({.tolerance = 1e-12}));
  const double start = bar.physics.energy().total();
  ASSERT_TRUE(run(bar.physics, 0.05, 20));
  EXPECT_GT(bar.crank_angle(), FourBar::kStart + 2 * M_PI) << "it has turned, or the test shows little";
  const double late = FourBar::time(FourBar::kStart, FourBar::kRate, bar.crank_angle()) - 1;
  EXPECT_LT(std::abs(late * bar.physics.joint_rate(bar.joints[0])), 1e-10);
  EXPECT_LT(std::abs(bar.physics.energy().total() - start), 1e-9);
  EXPECT_LT(bar.physics.joint_drift().distance, 1e-13);
  EXPECT_LT(bar.physics.joint_drift().angle, 1e-13);
}

TEST(Closure, IsExactInAHundredStepsOfGauss) {
  // Let go at rest, with the three redundant rows, 2 s in 100 steps of order 16 leave nothing but rounding:
  // the same as in 400. Turning at 12 rad/s, a quarter of a radian a step, twice the steps do it; there the
  // quadrature is the oracle.
  const auto turned = [](FourBar& bar, int steps) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    bar.physics.set_integrator(make_gauss({.stages = 8, .tolerance = kNone}));
    EXPECT_TRUE(run(bar.physics, 2.0 / steps, steps));
    EXPECT_LT(bar.physics.joint_drift().distance, 1e-13);
    return bar.crank_angle();
  };
  FourBar coarse{{0, 1, 2, 3}, 0, false}, fine{{0, 1, 2, 3}, 0, false}, fast;
  EXPECT_NEAR(turned(coarse, 100), turned(fine, 400), 1e-12);
  const double late = FourBar::time(FourBar::kStart, FourBar::kRate, turned(fast, 200)) - 2;
  EXPECT_LT(std::abs(late * fast.physics.joint_rate(fast.joints[0])), 1e-12);
}

TEST(Closure, KeepsTheOrderOfAnIntegrator) {
  // Halving the step of rk4 divides the error by 16, against the quadrature; a projection that broke the
  // order would show as 4 or 2.
  double error[2];
  for (const int k : {0, 1}) {
    FourBar bar;
    ASSERT_TRUE(run(bar.physics, 5e-3 / (1 << k), 100 << k));
    const double late = FourBar::time(FourBar::kStart, FourBar::kRate, bar.crank_angle()) - 0.5;
    error[k] = std::abs(late * bar.physics.joint_rate(bar.joints[0]));
    EXPECT_LT(bar.physics.joint_drift().distance, 1e-13);
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 4, 0.4) << error[0] << " -> " << error[1];
}

TEST(Closure, MovesTheSameWhicheverJointIsCut) {
  // The order of adding decides which of equal joints is cut; motion, joint values, damping (in cut joints
  // too) and, in the plane where they are determined, reactions cannot depend on it. Added first, the joints
  // at the ground leave 'far' or 'tip' to be cut.
  FourBar one{{0, 1, 2, 3}, 0.05}, other{{0, 2, 1, 3}, 0.05};
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(one.physics.step(2e-3).ok());
    ASSERT_TRUE(other.physics.step(2e-3).ok());
  }
  // Both are rk4 with other coordinates: equal to its error.
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((one.physics.body(one.rods[i]).p_WBcm() - other.physics.body(other.rods[i]).p_WBcm()).norm(),
              1e-7);
  }
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_NEAR(one.physics.joint_value(one.joints[j]), other.physics.joint_value(other.joints[j]), 1e-7);
    EXPECT_NEAR(one.physics.joint_rate(one.joints[j]), other.physics.joint_rate(other.joints[j]), 1e-5);
    const Wrench a = one.physics.reaction(one.joints[j]), b = other.physics.reaction(other.joints[j]);
    EXPECT_LT((a.force - b.force).head<2>().norm(), 1e-4 * (1 + a.force.norm())) << j;
    EXPECT_NEAR(a.torque.z(), b.torque.z(), 1e-5) << j;
  }
}

TEST(Closure, IsHeldByReactionsThatNewtonWouldFind) {
  // At the start nothing has been integrated, so that the reactions of both cuts agree to rounding; those on
  // the crank with its weight give its acceleration, seen as the change of velocity over a short step.
  FourBar one{{0, 1, 2, 3}}, other{{0, 2, 1, 3}};
  for (std::size_t j = 0; j < 4; ++j) {
    const Wrench a = one.physics.reaction(one.joints[j]), b = other.physics.reaction(other.joints[j]);
    EXPECT_LT((a.force - b.force).norm(), 1e-10 * a.force.norm()) << j;
    EXPECT_LT((a.torque - b.torque).norm(), 1e-10 * a.force.norm()) << j;
  }
  const Vector3 f = one.physics.reaction(one.joints[0]).force - one.physics.reaction(one.joints[1]).force;
  const Vector3 a = f / FourBar::kMass[0] + Vector3{0, -FourBar::kG, 0};
  const Vector3 before = one.physics.body(one.rods[0]).v_WBcm();
  ASSERT_TRUE(one.physics.step(1e-6).ok());
  const Vector3 measured = (one.physics.body(one.rods[0]).v_WBcm() - before) / 1e-6;
  EXPECT_LT((measured - a).norm(), 1e-4 * a.norm()) << "a step of 1e-6 s and rounding of 1e-16 / 1e-6";
}

TEST(Closure, PassesThroughPositionsInWhichAllBarsAreInLine) {
  // A parallelogram of equal bars has three ways to go where its bars are in line; inertia chooses the one on
  // which the cranks stay parallel. It passes twice a turn. Its energy is that of a pendulum, conserved.
  for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-10}) {
    PhysicsManager physics;
    physics.set_integrator(make_dormand_prince({.tolerance = tolerance}));
    physics.forces().add(Gravity{.g_W = {0, -9.81, 0}});
    MassProperties rod;
    rod.I_BBcm_B = Vector3{1e-3, 1. / 12, 1. / 12}.asDiagonal();
    const Quaternion upright{Eigen::AngleAxisd{M_PI / 2, Vector3::UnitZ()}};
    const BodyId left = physics.add(RigidBodySettings{
        .X_WB = {{0, 0.5, 0}, upright}, .v_WBcm = {-1.0, 0, 0}, .w_WB = {0, 0, 2}, .mass = rod});
    const BodyId right = physics.add(RigidBodySettings{
        .X_WB = {{1, 0.5, 0}, upright}, .v_WBcm = {-1.0, 0, 0}, .w_WB = {0, 0, 2}, .mass = rod});
    const BodyId top =
        physics.add(RigidBodySettings{.X_WB = {{0.5, 1, 0}}, .v_WBcm = {-2, 0, 0}, .mass = rod});
    const auto pivot = [&](BodyId a, BodyId b, double x, double y) {
      return physics.add(joint_here<PivotSettings>(physics, a, b, {{x, y, 0}, Quaternion::Identity()}));
    };
    const JointId base = pivot({}, left, 0, 0);
    pivot({}, right, 1, 0);
    pivot(left, top, 0, 1);
    pivot(top, right, 1, 1);
    const double start = physics.energy().total();
    ASSERT_TRUE(run(physics, 0.05, 60)) << tolerance;
    EXPECT_GT(double{physics.joint_value(base)}, 2 * M_PI);
    EXPECT_LT((physics.body(right).p_WBcm() - physics.body(left).p_WBcm() - Vector3::UnitX()).norm(), 1e-11);
    EXPECT_LT(std::abs(physics.energy().total() - start), 1e3 * tolerance) << tolerance;
  }
}

class ClosureOf : public testing::TestWithParam<test::CutKind> {};

TEST_P(ClosureOf, HoldsWhatTheJointHoldsAndNothingElse) {
  // The joint costs at most as many rows as any other and lies farthest from the ground, so it is cut. That
  // it holds all it should is seen from its bodies' poses, that it holds nothing else from its reaction,
  // which must do no work on any of the joint's own motions, and from energy, which rk4 keeps to some 1e-8
  // here.
  TwoHands t;
  const JointId joint = GetParam().add(t);
  const double start = t.physics.energy().total();
  ASSERT_TRUE(run(t.physics, 2e-3, 250));
  EXPECT_LT(t.physics.joint_drift().distance, 1e-13);
  EXPECT_LT(t.physics.joint_drift().angle, 1e-13);
  EXPECT_LT(std::abs(t.physics.energy().total() - start), 1e-6);
  const JointDefinition& d = t.physics.joint(joint);
  const Wrench reaction = t.physics.reaction(joint);
  const Pose X_WA = t.physics.body(t.a).X_WB() * d.X_AJ, X_WB = t.physics.body(t.b).X_WB() * d.X_BJ;
  const Vector3 z = X_WA.q * Vector3::UnitZ(), x = X_WA.q * Vector3::UnitX(), y = X_WA.q * Vector3::UnitY();
  const double size = 1e-10 * (reaction.force.norm() + reaction.torque.norm());
  EXPECT_GT(size, 1e-10);
  switch (d.kind) {
    case JointKind::Ball:
      EXPECT_LT(reaction.torque.norm(), size);
      break;
    case JointKind::Slider:
      EXPECT_LT(std::abs(reaction.force.dot(z)), size);
      break;
    case JointKind::Universal:
      EXPECT_LT(std::abs(reaction.torque.dot(X_WB.q * Vector3::UnitX())), size);
      EXPECT_LT(std::abs(reaction.torque.dot(z)), size);
      break;
    case JointKind::Planar:
      EXPECT_LT(std::abs(reaction.force.dot(x)), size);
      EXPECT_LT(std::abs(reaction.force.dot(y)), size);
      EXPECT_LT(std::abs(reaction.torque.dot(z)), size);
      break;
    case JointKind::Cylindrical:
      EXPECT_LT(std::abs(reaction.force.dot(z)), size);
      EXPECT_LT(std::abs(reaction.torque.dot(z)), size);
      break;
    default:  // Pivot, Screw
      EXPECT_LT(std::abs(reaction.torque.dot(z) + d.pitch * reaction.force.dot(z)), size);
  }
}

TEST_P(ClosureOf, CanBeReplacedByItsReaction) {
  // Without the joint, but with its reaction as a load on both bodies, the accelerations are the same: one
  // Euler step of either ends in the same velocities, to rounding.
  TwoHands with, without;
  with.physics.set_integrator(make_integrator("euler"));
  without.physics.set_integrator(make_integrator("euler"));
  const JointId joint = GetParam().add(with);
  const Wrench r = with.physics.reaction(joint);
  const Vector3 p = (with.physics.body(with.b).X_WB() * with.physics.joint(joint).X_BJ).p;
  without.physics.apply_force(without.b, r.force, p);
  without.physics.apply_torque(without.b, r.torque);
  without.physics.apply_force(without.a, -r.force, p);
  without.physics.apply_torque(without.a, -r.torque);
  ASSERT_TRUE(with.physics.step(1e-5).ok());
  ASSERT_TRUE(without.physics.step(1e-5).ok());
  for (const auto& [x, y] : {std::pair{with.a, without.a}, std::pair{with.b, without.b}}) {
    // The loop's velocities are settled at the new place, which is h^2 away: 1e-10 times accelerations of
    // 1e1.
    EXPECT_LT((with.physics.body(x).v_WBcm() - without.physics.body(y).v_WBcm()).norm(), 1e-8);
    EXPECT_LT((with.physics.body(x).w_WB() - without.physics.body(y).w_WB()).norm(), 1e-8);
    EXPECT_GT(with.physics.body(x).v_WBcm().norm(), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ClosureOf, testing::ValuesIn(test::kCutKinds),
                         [](const auto& test) { return std::string{test.param.name}; });

TEST(Closure, FollowsAnAnimatedBody) {
  // A rocker driven through a coupler by an animated crank that turns at a constant rate: where it stands is
  // geometry alone, the loop's other end being the crank.
  PhysicsManager physics;
  const auto motion = [](double t, Side) {
    const Quaternion q{Eigen::AngleAxisd{FourBar::kStart + 2 * t, Vector3::UnitZ()}};
    return RigidMotion{.X_AB = {Vector3::Zero(), q}, .w_AB = {0, 0, 2}};
  };
  const auto shape = FourBar::shape(FourBar::kStart);
  const BodyId crank = physics.add(RigidBodySettings{
      .name = "crank", .kind = BodyKind::Animated, .driver = std::make_unique<test::FunctionDriver>(motion)});
  std::array<BodyId, 2> rods{};
  for (std::size_t i = 0; i < 2; ++i) {
    rods[i] = physics.add(
        RigidBodySettings{.X_WB = {{shape.centre[i + 1].x, shape.centre[i + 1].y, 0},
                                   Quaternion{Eigen::AngleAxisd{shape.angle[i + 1], Vector3::UnitZ()}}},
                          .mass = lopsided_mass()});
  }
  const Vector3 tip = FourBar::kLength[0] * Vector3{std::cos(FourBar::kStart), std::sin(FourBar::kStart), 0};
  const Vector3 far{FourBar::kGround + FourBar::kLength[2] * std::cos(shape.angle[2]),
                    FourBar::kLength[2] * std::sin(shape.angle[2]), 0};
  physics.add(joint_here<PivotSettings>(physics, crank, rods[0], {tip, Quaternion::Identity()}));
  physics.add(joint_here<PivotSettings>(physics, rods[0], rods[1], {far, Quaternion::Identity()}));
  const JointId post = physics.add(
      joint_here<PivotSettings>(physics, {}, rods[1], {{FourBar::kGround, 0, 0}, Quaternion::Identity()}));
  ASSERT_TRUE(run(physics, 0.01, 200));
  const auto then = FourBar::shape(FourBar::kStart + 4);
  EXPECT_NEAR(physics.joint_value(post), then.angle[2] - shape.angle[2], 1e-12);
  EXPECT_NEAR(physics.joint_rate(post), 2 * then.rate[2], 1e-11);
}

}  // namespace
}  // namespace pantin
