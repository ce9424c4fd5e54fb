#include <pantin/physics/constraints/slider.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::facing;
using test::joint_here;
using test::lopsided_mass;
using test::run;

TEST(Slider, AcceleratesDownAnInclineLikeAPoint) {
  // Without friction s = g sin(angle) t^2 / 2 whatever the inertia, a quadratic that RK4 integrates exactly.
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  const double angle = 0.5;
  const Vector3 down{std::cos(angle), 0, -std::sin(angle)};
  const BodyId block = physics.add(RigidBodySettings{.name = "block", .mass = lopsided_mass(3)});
  const JointId slider =
      physics.add(joint_here<SliderSettings>(physics, BodyId{}, block, {{1, 2, 3}, facing(down)}));
  ASSERT_TRUE(run(physics, 0.01, 100));
  EXPECT_NEAR(physics.joint_value(slider), 9.81 * std::sin(angle) / 2, 1e-12);
  EXPECT_NEAR(physics.joint_rate(slider), 9.81 * std::sin(angle), 1e-12);
  EXPECT_LT((physics.body(block).X_WB().p - 9.81 * std::sin(angle) / 2 * down).norm(), 1e-12);
  EXPECT_EQ(physics.body(block).w_WB(), Vector3(0, 0, 0));
}

TEST(Slider, SharesMomentumWithAFreeBase) {
  // Two free bodies that slide on each other: the total momentum stays, and relative motion without force is
  // uniform.
  PhysicsManager physics;
  MassProperties mass;
  mass.mass = 1;
  const BodyId a = physics.add(RigidBodySettings{.name = "a", .mass = mass});
  mass.mass = 3;
  const BodyId b = physics.add(RigidBodySettings{.name = "b", .mass = mass});
  const JointId slider =
      physics.add(joint_here<SliderSettings>(physics, a, b, {Vector3::Zero(), facing({1, 0, 0})}));
  physics.apply_impulse(b, {6, 0, 0});
  ASSERT_TRUE(run(physics, 0.01, 101));
  EXPECT_NEAR(physics.body(b).v_WBcm().x(), 2, 1e-14);
  EXPECT_NEAR(physics.body(a).v_WBcm().norm(), 0, 1e-14);
  EXPECT_NEAR(physics.joint_value(slider), 2.0, 1e-12);
}

TEST(Slider, FeelsTheRotationOfItsGround) {
  // A mass on a radial slider that turns at constant w: s'' = w^2 s, so s = s0 cosh(w t). Tests the Coriolis
  // and centrifugal terms of the elimination.
  PhysicsManager physics;
  const double w = 2;
  RigidBodySettings arm{.name = "arm", .kind = BodyKind::Animated};
  arm.driver = std::make_unique<test::FunctionDriver>([w](double t, Side) {
    RigidMotion m;
    m.X_AB.q = Quaternion{Eigen::AngleAxisd{w * t, Vector3::UnitZ()}};
    m.w_AB = {0, 0, w};
    return m;
  });
  const BodyId a = physics.add(std::move(arm));
  MassProperties mass;
  mass.I_BBcm_B = 0.01 * Matrix3::Identity();
  const BodyId bead = physics.add(RigidBodySettings{.name = "bead", .X_WB = {{0.5, 0, 0}}, .mass = mass});
  SliderSettings s{.name = "rail", .a = a, .b = bead, .X_AJ = {Vector3::Zero(), facing({1, 0, 0})}};
  s.X_BJ = {Vector3::Zero(), facing({1, 0, 0})};
  const JointId rail = physics.add(s);
  physics.set_joint_rate(rail, 0.0);
  ASSERT_TRUE(run(physics, 0.001, 1000));
  EXPECT_NEAR(physics.joint_value(rail), 0.5 * std::cosh(w), 1e-10);
}

}  // namespace
}  // namespace pantin
