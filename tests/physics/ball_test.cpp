#include <pantin/physics/constraints/ball.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::joint_here;
using test::lopsided_mass;
using test::run;

TEST(Ball, PrecessesSteadily) {
  // A symmetric top on a ball joint precesses steadily at tilt theta if
  // (I1' - I3) W^2 cos(theta) - I3 W s + m g l = 0, with s the spin rate and I1' about the point
  // (Goldstein, Classical Mechanics, section 5.7): its axis then turns about the vertical at the constant
  // rate W.
  const double m = 1.5, l = 0.2, I1 = 0.004, I3 = 0.006, g = 9.81, tilt = 0.6, W = 2.0;
  const double I1p = I1 + m * l * l;
  const double spin = ((I1p - I3) * W * W * std::cos(tilt) + m * g * l) / (I3 * W);
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -g}});
  RigidBodySettings top{.name = "top"};
  top.mass.mass = m;
  top.mass.p_BBcm = {0, 0, l};
  top.mass.I_BBcm_B = Vector3{I1, I1, I3}.asDiagonal();
  top.X_WB.q = Quaternion{Eigen::AngleAxisd{tilt, Vector3::UnitX()}};
  const Vector3 axis = top.X_WB.q * Vector3::UnitZ();
  top.w_WB = W * Vector3::UnitZ() + spin * axis;
  top.v_WBcm = top.w_WB.cross(l * axis);
  const BodyId id = physics.add(std::move(top));
  const JointId ball = physics.add(BallSettings{.b = id});
  ASSERT_TRUE(run(physics, 5e-5, 20000));
  const Vector3 expected = Eigen::AngleAxisd{W * 1.0, Vector3::UnitZ()} * axis;
  EXPECT_LT((physics.body(id).R_WB().col(2) - expected).norm(), 1e-8);
  EXPECT_EQ(physics.joint_value(ball).size(), 4);
  EXPECT_NEAR(physics.joint_rate(ball)[2], spin + W * std::cos(tilt), 1e-6);
}

TEST(Ball, KeepsMomentumAndEnergyOfAFloatingChain) {
  // Without outer forces momentum, angular momentum and energy of the whole are constant; RK4 at this step
  // keeps the latter two to 1e-9, and P to round-off.
  PhysicsManager physics;
  BodyId last = physics.add(RigidBodySettings{.name = "0", .w_WB = {1, 2, 3}, .mass = lopsided_mass()});
  for (int i = 1; i < 5; ++i) {
    RigidBodySettings s{.name = std::to_string(i), .X_WB = {{0.5 * i, 0, 0}}, .mass = lopsided_mass(1.0 + i)};
    s.v_WBcm = {0, 0.3 * i, 1};
    const BodyId id = physics.add(std::move(s));
    physics.add(
        joint_here<BallSettings>(physics, last, id, {{0.5 * i - 0.2, 0.1, 0}, Quaternion::Identity()}));
    last = id;
  }
  const test::Momenta first = test::momenta_of(physics);
  ASSERT_TRUE(run(physics, 1e-6, 1));
  // The given velocities do not fit the joints: projecting them keeps the momenta of the whole.
  const test::Momenta start = test::momenta_of(physics);
  EXPECT_LT((start.linear - first.linear).norm(), 1e-12);
  EXPECT_LT((start.angular - first.angular).norm(), 1e-12);
  const double energy = physics.energy().total();
  ASSERT_TRUE(run(physics, 1e-3, 1000));
  const test::Momenta end = test::momenta_of(physics);
  EXPECT_LT((end.linear - start.linear).norm(), 1e-10);
  EXPECT_LT((end.angular - start.angular).norm(), 1e-8);
  EXPECT_NEAR(physics.energy().total(), energy, 1e-8 * energy);
  EXPECT_LT(physics.joint_drift().distance, 1e-14);
}

TEST(Ball, ReportsTheQuaternionOfBInA) {
  // The value is what was set, seen from either side: the conjugate.
  for (const bool swapped : {false, true}) {
    PhysicsManager physics;
    const BodyId a = physics.add(RigidBodySettings{.name = "a", .mass = lopsided_mass()});
    const BodyId b =
        physics.add(RigidBodySettings{.name = "b", .X_WB = {{1, 0, 0}}, .mass = lopsided_mass()});
    physics.add(joint_here<PivotSettings>(physics, BodyId{}, a, Pose{}));
    const Pose here{{0.5, 0, 0}, Quaternion::Identity()};
    const JointId ball = swapped ? physics.add(joint_here<BallSettings>(physics, b, a, here))
                                 : physics.add(joint_here<BallSettings>(physics, a, b, here));
    const Quaternion q{Eigen::AngleAxisd{1.1, Vector3{1, -2, 0.5}.normalized()}};
    physics.set_joint_value(ball, {q.w(), q.x(), q.y(), q.z()});
    physics.set_joint_rate(ball, {0.1, 0.2, 0.3});
    const JointNumbers value = physics.joint_value(ball), rate = physics.joint_rate(ball);
    EXPECT_NEAR(value[0], q.w(), 1e-15);
    EXPECT_NEAR(value[3], q.z(), 1e-15);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(rate[i], 0.1 * (i + 1), 1e-14);
    const Quaternion measured = physics.body(a).q_WB().conjugate() * physics.body(b).q_WB();
    EXPECT_LT(measured.angularDistance(swapped ? q.conjugate() : q), 1e-14);
  }
}

}  // namespace
}  // namespace pantin
