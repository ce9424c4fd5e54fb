// Joints that break.
#include <gtest/gtest.h>

#include <cmath>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::facing;
using test::joint_here;
using test::run;

TEST(JointStrength, BreaksAPendulumWhereItsRodBearsTooMuch) {
  // A point pendulum let go from the horizontal bears 3 m g sin(angle) along its rod: with a strength of 2 m
  // g it breaks at the end of the first step past asin(2/3), and flies on with the momenta that it had.
  PhysicsManager physics;
  physics.set_integrator(make_integrator("gauss16"));
  physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  MassProperties mass;
  mass.mass = 1;
  mass.p_BBcm = {1, 0, 0};
  mass.I_BBcm_B = 1e-12 * Matrix3::Identity();
  const BodyId bob = physics.add(RigidBodySettings{.name = "bob", .mass = mass});
  PivotSettings pivot = joint_here<PivotSettings>(physics, BodyId{}, bob, {{0, 0, 0}, facing({0, 1, 0})});
  pivot.strength = {.force = 20};
  const JointId joint = physics.add(std::move(pivot));
  while (physics.contains(joint)) {
    const double angle = physics.joint_value(joint);
    EXPECT_LT(std::sin(angle), 2.0 / 3);
    const StepReport report = physics.step(0.001);
    ASSERT_TRUE(report.ok()) << report.message;
    ASSERT_LT(physics.time(), 2);
    if (report.broken.empty()) continue;
    EXPECT_EQ(report.broken, std::vector<JointId>{joint});
    ASSERT_EQ(physics.joint_events().size(), 1u);
    EXPECT_EQ(physics.joint_events()[0].kind, JointEventKind::Broken);
  }
  const Vector3 p = physics.body(bob).p_WBcm(), v = physics.body(bob).v_WBcm();
  EXPECT_NEAR(-p.z(), 2.0 / 3, 0.005);
  EXPECT_NEAR(v.squaredNorm(), 2 * 10 * -p.z(), 1e-8);
  ASSERT_TRUE(run(physics, 0.01, 20));
  EXPECT_LT((physics.body(bob).p_WBcm() - (p + 0.2 * v + Vector3{0, 0, -10 * 0.02})).norm(), 1e-9);
}

TEST(JointStrength, LetsTheWeakestOfARowOfFixedJointsGo) {
  // Fixed joints make one body for the solver; the one that bears the most weight beyond its strength breaks,
  // those below it, which bear less, stay.
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  std::vector<JointId> joints;
  BodyId above;
  for (int i = 0; i < 3; ++i) {
    MassProperties mass;
    mass.mass = 1;
    mass.I_BBcm_B = Matrix3::Identity();
    const Vector3 at{0, 0, -1.0 * i};
    const BodyId body =
        physics.add(RigidBodySettings{.name = "link", .X_WB = {at, Quaternion::Identity()}, .mass = mass});
    FixedSettings fixed = joint_here<FixedSettings>(physics, above, body, {at, Quaternion::Identity()});
    fixed.strength = {.force = i == 1 ? 15.0 : 35.0};
    joints.push_back(physics.add(std::move(fixed)));
    above = body;
  }
  const StepReport report = physics.step(0.01);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report.broken, std::vector<JointId>{joints[1]});
  EXPECT_TRUE(physics.contains(joints[0]) && physics.contains(joints[2]));
  ASSERT_TRUE(run(physics, 0.01, 10));
  EXPECT_NEAR(physics.body(above).v_WBcm().z(), -1, 1e-12);
}

TEST(JointStrength, JudgesAllJointsAsReactionDoes) {
  // Strengths just above and just below what reaction says of a moving chain: those below break, all in the
  // same step, none else.
  const auto chain = [](PhysicsManager& physics, std::span<const double> strengths) {
    physics.forces().add(Gravity{});
    std::vector<JointId> joints;
    BodyId above;
    for (int i = 0; i < 4; ++i) {
      const Vector3 at{0.3 * i, 0, 0};
      const BodyId rod = physics.add(RigidBodySettings{
          .name = "rod", .X_WB = {at, Quaternion::Identity()}, .mass = test::lopsided_mass()});
      SliderSettings slider = joint_here<SliderSettings>(physics, above, rod, {at, facing({1, 0.5 * i, -1})});
      PivotSettings pivot = joint_here<PivotSettings>(physics, above, rod, {at, facing({0.1 * i, 1, 0})});
      if (!strengths.empty())
        slider.strength.torque = pivot.strength.torque = strengths[static_cast<std::size_t>(i)];
      joints.push_back(i == 2 ? physics.add(slider) : physics.add(pivot));
      above = rod;
    }
    return joints;
  };
  PhysicsManager sound;
  const std::vector<JointId> joints = chain(sound, {});
  ASSERT_TRUE(run(sound, 0.01, 30));
  std::vector<double> strengths;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    strengths.push_back(sound.reaction(joints[i]).torque.norm() * (i % 2 == 0 ? 1 - 1e-9 : 1 + 1e-9));
  }
  PhysicsManager weak;
  const std::vector<JointId> weak_joints = chain(weak, strengths);
  weak.restore([&] {
    State state = sound.snapshot();
    state.topology = weak.snapshot().topology;
    state.time -= 1e-9;
    return state;
  }());
  const StepReport report = weak.step(1e-12);
  EXPECT_EQ(report.broken, (std::vector<JointId>{weak_joints[0], weak_joints[2]}));
}

}  // namespace
}  // namespace pantin
