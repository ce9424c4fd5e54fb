// Moving nodes at once: what goes along, which velocity remains, what has no history afterwards.
#include <gtest/gtest.h>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::moved;
using test::says;
using test::Stage;
using test::turned;

TEST(Teleport, WritesPreviousAndSceneAtOnceInAFrameWithoutUpdates) {
  // After a teleport nothing remembers the old place: not the scene, not the presented matrix at any alpha,
  // and no later frame, though no update has run in between.
  Stage s{0.1};
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  s.physics.set_velocity(s.bridge.body_of(id), {1, 0, 0}, {0, 0, 0});
  static_cast<void>(s.bridge.advance(0.25));
  const Affine target = moved({50, 0, 0}) * turned(1, {0, 1, 0});
  ASSERT_TRUE(s.bridge.teleport(id, target).empty());
  EXPECT_LT(test::relative_difference(s.scene.world(id), target), 1e-15);
  const AdvanceReport report = s.bridge.advance(0.01);
  EXPECT_EQ(report.updates, 0);
  for (const double alpha : {0.0, 0.3, 1.0})
    EXPECT_LT(test::relative_difference(s.bridge.presented(id, alpha), target), 1e-15);
  static_cast<void>(s.bridge.advance(0.2));
  EXPECT_LT(test::relative_difference(s.scene.world(id), target), 1e-15);
}

TEST(Teleport, KeepsOrStopsTheVelocityAsTold) {
  // Zero is the default; Keep goes on with the world velocities.
  for (const TeleportVelocity velocity : {TeleportVelocity::Zero, TeleportVelocity::Keep}) {
    Stage s{0.1};
    const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
    ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
    s.physics.set_velocity(s.bridge.body_of(id), {1, 0, 0}, {0, 2, 0});
    ASSERT_TRUE(s.bridge.teleport(id, moved({5, 0, 0}), velocity).empty());
    const double kept = velocity == TeleportVelocity::Keep ? 1 : 0;
    const RigidBody body = s.physics.body(s.bridge.body_of(id));
    EXPECT_LT((body.v_WBcm() - Vector3{kept, 0, 0}).norm(), 1e-15);
    EXPECT_LT((body.w_WB() - Vector3{0, 2 * kept, 0}).norm(), 1e-15);
  }
}

TEST(Teleport, TakesAlongTheJointTreeBelowAndStopsItWhole) {
  // A floating robot of three bodies in full motion: teleported, all keep their places on each other, and all
  // stand.
  Stage s{0.01};
  const NodeId base = box(s, s.scene.root(), "base", Affine::Identity(), 3);
  const NodeId upper = box(s, base, "upper", Affine::Identity(), 1, {0.5, 0, 0});
  const NodeId lower = box(s, upper, "lower", Affine::Identity(), 1, {0, 0.5, 0});
  s.scene.set_link(upper, test::pivot_link("j1", moved({0, 0, 1}), {0, 1, 0}, 0.4));
  s.scene.set_link(lower, test::pivot_link("j2", moved({1, 0, 0}), {0, 0, 1}, -0.3));
  ASSERT_FALSE(has_error(s.bridge.hand_over(base, Scope::Subtree)));
  s.physics.set_joint_rate(s.bridge.joint_of(upper), 2.0);
  s.physics.set_joint_rate(s.bridge.joint_of(lower), -5.0);
  static_cast<void>(s.bridge.advance(0.2));
  const Affine M_upper = s.scene.local(upper), M_lower = s.scene.local(lower);
  ASSERT_TRUE(s.bridge.teleport(base, moved({9, 8, 7}) * turned(2, {1, 1, 1})).empty());
  EXPECT_LT(test::relative_difference(s.scene.local(upper), M_upper), 1e-13);
  EXPECT_LT(test::relative_difference(s.scene.local(lower), M_lower), 1e-13);
  EXPECT_LT(s.physics.energy().kinetic, 1e-25);
  static_cast<void>(s.bridge.advance(0.2));
  EXPECT_LT(s.physics.energy().kinetic, 1e-25);
  EXPECT_LT((s.scene.world(base).translation() - Vector3{9, 8, 7}).norm(), 1e-13);
}

TEST(Teleport, OfAnAnimatedBodyTakesAlongWhatHangsOnIt) {
  // A followed platform is put elsewhere: no velocity comes of it, and the pendulum below has gone along at
  // its angle.
  Stage s{0.01};
  const NodeId top = box(s, s.scene.root(), "top", Affine::Identity());
  const NodeId arm = box(s, top, "arm", Affine::Identity(), 1, {0, 0, -0.5});
  s.scene.set_link(arm, test::pivot_link("j", Affine::Identity(), {0, 1, 0}, 0.8));
  ASSERT_TRUE(s.bridge.follow(top).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(arm)));
  ASSERT_TRUE(s.bridge.teleport(top, moved({20, 0, 0})).empty());
  EXPECT_LT((s.scene.world(arm).translation() - Vector3{20, 0, 0}).norm(), 1e-13);
  EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(arm)), 0.8, 1e-14);
  EXPECT_EQ(s.physics.body(s.bridge.body_of(top)).v_WB(), Vector3::Zero());
  static_cast<void>(s.bridge.advance(0.1));
  EXPECT_LT(s.physics.energy().kinetic, 1e-20);
}

TEST(Teleport, OfAnUnboundNodeTakesAlongTheBodiesBelow) {
  // The group node only places the robot; moved, it takes the fixed base with its joint to the world along.
  Stage s{0.01};
  const NodeId group = s.scene.create(s.scene.root(), "group");
  const NodeId base = box(s, group, "base", moved({1, 0, 0}));
  s.scene.set_link(base, Link{.kind = LinkKind::Fixed, .M_PJ = moved({1, 0, 0})});
  const NodeId arm = box(s, base, "arm", Affine::Identity());
  s.scene.set_link(arm, test::pivot_link("j", Affine::Identity(), {0, 0, 1}, 0.5));
  ASSERT_FALSE(has_error(s.bridge.hand_over(group, Scope::Subtree)));
  ASSERT_TRUE(s.bridge.teleport(group, moved({0, 10, 0}) * turned(0.5, {0, 0, 1})).empty());
  const Affine want = moved({0, 10, 0}) * turned(0.5, {0, 0, 1}) * moved({1, 0, 0});
  static_cast<void>(s.bridge.advance(0.1));
  EXPECT_LT(test::relative_difference(s.scene.world(base), want), 1e-14);
  EXPECT_LT(test::relative_difference(s.scene.world(arm), want * turned(0.5, {0, 0, 1})), 1e-14);
  EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(arm)), 0.5, 1e-14);
}

TEST(Teleport, LeavesIndependentBodiesBelowWhereTheyAre) {
  // A free body below another one is no part of it: nested bodies are independent.
  Stage s;
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId b = box(s, a, "b", moved({0, 3, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(a, Scope::Subtree)));
  ASSERT_TRUE(s.bridge.teleport(a, moved({100, 0, 0})).empty());
  EXPECT_LT((s.scene.world(b).translation() - Vector3{0, 3, 0}).norm(), 1e-13);
}

TEST(Teleport, RefusesAMatrixThatItsBodyCannotHave) {
  // The residual is constant: another scale, shear or mirror is refused, and nothing has moved.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", test::scaled({1, 2, 1}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  const std::vector<Affine> before = test::locals(s.scene);
  EXPECT_TRUE(
      says(s.bridge.teleport(id, Affine::Identity()), "a", "scales, shears or mirrors it in another way"));
  EXPECT_TRUE(says(s.bridge.teleport(id, test::scaled({1, -2, 1})), "a",
                   "scales, shears or mirrors it in another way"));
  EXPECT_TRUE(says(s.bridge.teleport(id, test::scaled({1, 0, 1})), "a",
                   "scales, shears or mirrors it in another way"));
  Affine bad = Affine::Identity();
  bad.translation().x() = std::nan("");
  EXPECT_TRUE(says(s.bridge.teleport(id, bad), "a", "is not finite"));
  EXPECT_TRUE(says(s.bridge.teleport(s.scene.root(), Affine::Identity()), "/", "it cannot be teleported"));
  EXPECT_TRUE(test::same_bits(before, test::locals(s.scene)));
}

TEST(Teleport, RefusesWhatCannotStayThere) {
  // A clip would put the node back; under a flat parent no local matrix leads anywhere.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  EXPECT_TRUE(says(s.bridge.teleport(id, moved({1, 0, 0})), "a", "a clip animates it"));
  const NodeId flat = s.scene.create(s.scene.root(), "flat", test::scaled({1, 1, 0}));
  const NodeId below = s.scene.create(flat, "b");
  EXPECT_TRUE(
      says(s.bridge.teleport(below, Affine::Identity()), "flat/b", "its parent's world matrix is singular"));
}

TEST(Teleport, TellsOfAPlaceThatTheJointDoesNotAllow) {
  // A pivot arm 1 m off its axis is brought back by the joint; along its motion it stays.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  s.scene.set_link(id, test::pivot_link("hinge", Affine::Identity(), {0, 0, 1}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  EXPECT_TRUE(s.bridge.teleport(id, turned(0.6, {0, 0, 1})).empty());
  EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(id)), 0.6, 1e-14);
  EXPECT_TRUE(
      says(s.bridge.teleport(id, moved({1, 0, 0})), "a", "its joint 'hinge' does not allow this place"));
}

}  // namespace
}  // namespace pantin
