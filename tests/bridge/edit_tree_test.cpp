// Reparenting, releasing and removing under bound nodes.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::moved;
using test::says;
using test::Stage;
using test::turned;

TEST(Reparent, KeepsTheWorldMatrixAndTheMotion) {
  // A flying body changes parents under scale and shear: matrix and velocities are what they were, and
  // nothing is flung.
  Stage s{0.01};
  const NodeId old_parent = s.scene.create(s.scene.root(), "old", turned(1, {1, 0, 0}));
  const NodeId new_parent = s.scene.create(
      s.scene.root(), "new", moved({5, 5, 5}) * test::scaled({1, 3, 0.5}) * turned(1, {0, 1, 1}));
  const NodeId id = box(s, old_parent, "a", moved({1, 2, 3}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  s.physics.set_velocity(s.bridge.body_of(id), {1, 2, 3}, {0.5, 0, 0});
  static_cast<void>(s.bridge.advance(0.1));
  const Affine before = s.scene.world(id);
  ASSERT_TRUE(s.bridge.reparent(id, new_parent).empty());
  EXPECT_EQ(s.scene.parent(id), new_parent);
  EXPECT_LT(test::relative_difference(s.scene.world(id), before), 1e-14);
  EXPECT_EQ(s.physics.body(s.bridge.body_of(id)).v_WBcm(), (Vector3{1, 2, 3}));
  static_cast<void>(s.bridge.advance(0.1));
  EXPECT_LT((s.scene.world(id).translation() - before.translation() - Vector3{0.1, 0.2, 0.3}).norm(), 1e-13);
}

TEST(Reparent, RebasesTheJointToTheNewBody) {
  // The arm is hung from another body: joint frame and value stay as they are in the world, the other end
  // changes, and the link makes the same matrix under the new parent.
  Stage s{0.01};
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId b = box(s, s.scene.root(), "b", moved({3, 0, 0}) * turned(0.5, {1, 1, 0}));
  const NodeId arm = box(s, a, "arm", Affine::Identity(), 1, {0, 0, 0.5});
  s.scene.set_link(arm, test::pivot_link("j", moved({1, 0, 0}), {0, 1, 0}, 0.4));
  ASSERT_FALSE(has_error(s.bridge.hand_over(s.scene.root(), Scope::Subtree)));
  const Affine before = s.scene.world(arm);
  ASSERT_TRUE(s.bridge.reparent(arm, b).empty());
  const JointDefinition& joint = s.physics.joint(s.bridge.joint_of(arm));
  EXPECT_EQ(joint.a, s.bridge.body_of(b));
  EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(arm)), 0.4, 1e-14);
  const Vector3 p_WJ = s.physics.body(joint.a).X_WB() * joint.X_AJ.p;
  EXPECT_LT((p_WJ - Vector3{1, 0, 0}).norm(), 1e-14);
  EXPECT_LT(test::relative_difference(s.scene.world(arm), before), 1e-14);
  EXPECT_LT(test::relative_difference(s.scene.local(arm), local_matrix(*s.scene.link(arm), 0.4)), 1e-14);
}

TEST(Reparent, OfAFollowedNodeTurnsItsTrajectoryIntoADrivenJoint) {
  // Under a simulated body the followed node hangs on it by a driven joint; back under the root it has a
  // trajectory.
  Stage s;
  const NodeId body = box(s, s.scene.root(), "body", Affine::Identity());
  const NodeId tool = box(s, s.scene.root(), "tool", moved({1, 0, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(body)));
  ASSERT_TRUE(s.bridge.follow(tool).empty());
  EXPECT_EQ(s.physics.body(s.bridge.body_of(tool)).kind(), BodyKind::Animated);
  ASSERT_TRUE(s.bridge.reparent(tool, body).empty());
  EXPECT_EQ(s.physics.joint(s.bridge.joint_of(tool)).kind, JointKind::Driven);
  ASSERT_TRUE(s.bridge.reparent(tool, s.scene.root()).empty());
  EXPECT_EQ(s.physics.body(s.bridge.body_of(tool)).kind(), BodyKind::Animated);
  EXPECT_FALSE(s.bridge.joint_of(tool));
}

TEST(Reparent, OnTheWayBackToTheClipGoesOnFromThere) {
  // The node is on its way back while it changes parents: pose and velocity go on.
  Stage s;
  const NodeId other = s.scene.create(s.scene.root(), "other", moved({1, 1, 1}) * turned(0.3, {1, 0, 0}));
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  static_cast<void>(s.bridge.advance(0.5));
  ASSERT_TRUE(s.bridge.take_back(id).empty());
  static_cast<void>(s.bridge.advance(0.1));
  const Affine before = s.scene.world(id);
  const Vector3 v = s.physics.body(s.bridge.body_of(id)).v_WB();
  EXPECT_TRUE(says(s.bridge.reparent(id, other), "other/a",
                   "a clip animates it with values made for its old parent"));
  EXPECT_LT(test::relative_difference(s.scene.world(id), before), 1e-14);
  static_cast<void>(s.bridge.advance_until(s.bridge.time() + 1e-6));
  EXPECT_LT((s.scene.world(id).translation() - before.translation() - 1e-6 * v).norm(), 1e-9);
}

TEST(Reparent, RefusesASingularParent) {
  // No local matrix keeps the world matrix under a flat parent; nothing changes.
  Stage s;
  const NodeId flat = s.scene.create(s.scene.root(), "flat", test::scaled({1, 0, 1}));
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  EXPECT_TRUE(says(s.bridge.reparent(id, flat), "a", "its new parent 'flat' has a singular world matrix"));
  EXPECT_EQ(s.scene.parent(id), s.scene.root());
}

TEST(Reparent, RefusesALinkThatCannotBeRebased) {
  // The old parent is flat, so its joint frame has no place under another.
  Stage s;
  const NodeId flat = s.scene.create(s.scene.root(), "flat", test::scaled({1, 0, 1}));
  const NodeId id = s.scene.create(flat, "a");
  s.scene.set_link(id, test::pivot_link("j", Affine::Identity(), {0, 0, 1}));
  EXPECT_TRUE(says(s.bridge.reparent(id, s.scene.root()), "flat/a", "its link cannot be re-based"));
}

TEST(Reparent, RefusesAStaticNodeUnderASimulatedOne) {
  // Its body would stand while its node went along; the followed group above it may not bring it there
  // either.
  Stage s;
  const NodeId body = box(s, s.scene.root(), "body", Affine::Identity());
  const NodeId group = s.scene.create(s.scene.root(), "group");
  const NodeId wall = box(s, group, "wall", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.hand_over(body)));
  ASSERT_FALSE(has_error(s.bridge.fix(wall)));
  EXPECT_TRUE(says(s.bridge.reparent(group, body), "group/wall", "it is static and would be carried along"));
  EXPECT_EQ(s.scene.parent(group), s.scene.root());
}

TEST(Release, KeepsTheNodeAndTiesWhatHungOnItToTheNextBody) {
  // The middle of three joined bodies is released: its node follows its parent rigidly, and the joint of the
  // last one is now between the outer bodies.
  Stage s{0.01};
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId b = box(s, a, "b", Affine::Identity());
  const NodeId c = box(s, b, "c", Affine::Identity());
  s.scene.set_link(b, test::pivot_link("jb", moved({1, 0, 0}), {0, 1, 0}));
  s.scene.set_link(c, test::pivot_link("jc", moved({1, 0, 0}), {0, 1, 0}, 0.2));
  ASSERT_FALSE(has_error(s.bridge.hand_over(a, Scope::Subtree)));
  s.bridge.release(b);
  EXPECT_FALSE(s.bridge.drive_of(b).has_value());
  EXPECT_EQ(s.physics.joint(s.bridge.joint_of(c)).a, s.bridge.body_of(a));
  EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(c)), 0.2, 1e-14);
  const Affine M_ab = s.scene.local(b);
  s.physics.set_joint_rate(s.bridge.joint_of(c), 2.0);
  static_cast<void>(s.bridge.advance(0.3));
  EXPECT_EQ(s.scene.local(b).matrix(), M_ab.matrix());
  EXPECT_LT(test::relative_difference(test::by_body(s, c), s.scene.world(c)), 1e-13);
}

TEST(Release, OfASubtreeLeavesPhysicsEmpty) {
  // Nothing of the bridge stays behind: no body, no joint.
  Stage s;
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId b = box(s, a, "b", Affine::Identity());
  s.scene.set_link(b, test::pivot_link("j", Affine::Identity(), {0, 1, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(a, Scope::Subtree)));
  s.bridge.release(a, Scope::Subtree);
  EXPECT_TRUE(s.physics.bodies().empty());
  EXPECT_TRUE(s.physics.joints().empty());
  EXPECT_TRUE(s.bridge.bound().empty());
}

TEST(Release, LetsTheClipWriteTheNodeAgain) {
  // While simulated the node is held; released, the player has it back.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  static_cast<void>(s.bridge.advance(0.4));
  s.bridge.release(id);
  static_cast<void>(s.bridge.advance_until(1.0));
  EXPECT_LT((s.scene.local(id).translation() - Vector3{1, 0.5, 0.2}).norm(), 1e-14);
}

TEST(Remove, InAnyOrderIsSafe) {
  // Nodes of robots with all kinds of drives, clips and pending moves are removed in random order, with steps
  // between; the sanitizers watch. What is left goes on.
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    std::mt19937_64 rng{seed};
    Stage s{0.01};
    s.physics.forces().add(Gravity{});
    std::vector<NodeId> nodes;
    for (int k = 0; k < 12; ++k) {
      const NodeId parent = nodes.empty() || rng() % 4 == 0 ? s.scene.root() : nodes[rng() % nodes.size()];
      nodes.push_back(box(s, parent, "n" + std::to_string(k), moved({0.5, 0, 0.1})));
      if (rng() % 2)
        s.scene.set_link(nodes.back(),
                         test::pivot_link("j" + std::to_string(k), moved({0.5, 0, 0.1}), {0, 1, 1}));
    }
    for (const NodeId id : nodes) {
      if (rng() % 4 == 0) static_cast<void>(s.bridge.play(test::swinging_clip(), {id}));
      if (rng() % 3 == 0) static_cast<void>(s.bridge.follow(id));
      if (rng() % 2 == 0) static_cast<void>(s.bridge.hand_over(id));
      if (rng() % 4 == 0) static_cast<void>(s.bridge.take_back(id));
    }
    std::shuffle(nodes.begin(), nodes.end(), rng);
    for (const NodeId id : nodes) {
      if (!s.scene.contains(id)) continue;
      if (s.bridge.drive_of(id) == Drive::Scene) s.bridge.set_local(id, moved({0.4, 0, 0}));
      ASSERT_TRUE(s.bridge.advance(0.03).last.ok()) << seed;
      if (rng() % 3 == 0) s.scene.remove(id);  // behind the bridge's back
      else s.bridge.remove(id);
      EXPECT_FALSE(s.bridge.drive_of(id).has_value() && s.scene.contains(id));
    }
    static_cast<void>(s.bridge.advance(0.03));
    EXPECT_TRUE(s.physics.bodies().empty()) << seed;
    EXPECT_TRUE(s.physics.joints().empty()) << seed;
  }
}

TEST(Remove, TakesItsMassFromTheBodyThatCarriedIt) {
  // An unbound node with mass rode on its parent's body; removed, its mass is gone.
  Stage s;
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity(), 3);
  const NodeId b = box(s, a, "b", moved({1, 0, 0}), 2);
  ASSERT_FALSE(has_error(s.bridge.hand_over(a)));
  EXPECT_DOUBLE_EQ(s.physics.body(s.bridge.body_of(a)).mass(), 5);
  s.bridge.remove(b);
  EXPECT_DOUBLE_EQ(s.physics.body(s.bridge.body_of(a)).mass(), 3);
}

TEST(BridgeLifetime, TakesItsBodiesAlong) {
  // Trajectories point into the bridge, so its bodies leave physics with it; bodies of others stay.
  Scene scene;
  PhysicsManager physics;
  const BodyId own = physics.add(RigidBodySettings{.name = "own"});
  {
    Bridge bridge{scene, physics};
    const NodeId id = scene.create(scene.root(), "a");
    bridge.set_node_body(id, {.mass = test::box_mass(1, {1, 1, 1})});
    ASSERT_TRUE(bridge.play(test::swinging_clip(), {id}).empty());
    ASSERT_TRUE(bridge.follow(id).empty());
    EXPECT_EQ(physics.bodies().size(), 2U);
  }
  ASSERT_EQ(physics.bodies().size(), 1U);
  EXPECT_EQ(physics.bodies()[0], own);
  EXPECT_TRUE(physics.step(0.01).ok());
}

}  // namespace
}  // namespace pantin
