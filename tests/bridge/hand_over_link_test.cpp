// Scene -> Physics: links become joints.
#include <gtest/gtest.h>

#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/pivot.hpp>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::moved;
using test::says;
using test::scaled;
using test::Stage;
using test::turned;

TEST(HandOver, SaysWhatOfLinksIsNotEnforced) {
  // A mimic outside of an instance is geometry only: one warning, with how many.
  Stage s;
  const NodeId top = box(s, s.scene.root(), "top", Affine::Identity());
  for (int k = 0; k < 3; ++k) {
    const NodeId id = box(s, top, "arm", Affine::Identity());
    Link link = test::pivot_link("p" + std::to_string(k), Affine::Identity(), {0, 0, 1});
    if (k == 2) link.mimic = LinkMimic{.source = "p0"};
    s.scene.set_link(id, link);
  }
  const std::vector<Diagnostic> notes = s.bridge.hand_over(top, Scope::Subtree);
  EXPECT_TRUE(says(notes, "top", "1 joint(s) here mimic another, which is not held while they are"));
}

TEST(HandOver, KeepsTheValueOfALinkWithItsTurns) {
  // Zero and sign are the link's, also under a mirrored parent and beyond whole turns.
  for (const double side : {1.0, -1.0}) {
    for (const double value : {0.0, 0.3, -2.0, 7.5, -20.0}) {
      Stage s;
      const NodeId parent =
          s.scene.create(s.scene.root(), "p", turned(0.4, {1, 0, 0}) * scaled({side, 1, 1}));
      const NodeId id = box(s, parent, "arm", Affine::Identity());
      s.scene.set_link(id, test::pivot_link("j", moved({0, 1, 0}), {1, 2, 0}, value));
      ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
      EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(id)), value, 1e-14);
      s.bridge.set_link_value(id, value + 0.5);
      EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(id)), value + 0.5, 1e-14);
      const Link& link = *s.scene.link(id);
      EXPECT_NEAR(link.value[0], value + 0.5, 1e-14);
      EXPECT_LT(test::relative_difference(s.scene.local(id), local_matrix(link, link.value)), 1e-14);
    }
  }
}

TEST(HandOver, KeepsASliderInTheUnitsOfItsLink) {
  // Under a parent scaled by 3 along the axis, 0.2 units of the link are 0.6 m of the joint, both ways.
  Stage s;
  const NodeId parent = s.scene.create(s.scene.root(), "p", scaled({1, 1, 3}));
  const NodeId id = box(s, parent, "lift", Affine::Identity());
  s.scene.set_link(id, test::slider_link("j", Affine::Identity(), {0, 0, 1}, 0.2));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(id)), 0.6, 1e-15);
  s.bridge.set_link_value(id, 0.5);
  EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(id)), 1.5, 1e-15);
  EXPECT_NEAR(s.scene.world(id).translation().z(), 1.5, 1e-15);
  EXPECT_NEAR(s.scene.link(id)->value[0], 0.5, 1e-15);
}

TEST(HandOver, TiesALinkAcrossUnboundNodesToTheNearestBody) {
  // Between the two bodies stands a node without body: the joint is between the bodies.
  Stage s;
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId between = s.scene.create(a, "between", moved({1, 0, 0}));
  const NodeId b = box(s, between, "b", Affine::Identity());
  s.scene.set_link(b, test::pivot_link("j", moved({0, 0, 1}), {0, 1, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(a, Scope::Subtree)));
  const JointDefinition& joint = s.physics.joint(s.bridge.joint_of(b));
  EXPECT_EQ(joint.a, s.bridge.body_of(a));
  EXPECT_LT((joint.X_AJ.p - Vector3{1, 0, 1}).norm(), 1e-15);
}

TEST(HandOver, TiesALinkUnderAStandingParentToTheWorld) {
  // Nothing above is bound or played: the joint's other end is the world.
  Stage s;
  const NodeId base = s.scene.create(s.scene.root(), "base", moved({0, 0, 2}));
  const NodeId arm = box(s, base, "arm", Affine::Identity());
  s.scene.set_link(arm, test::pivot_link("j", Affine::Identity(), {0, 1, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(arm)));
  const JointDefinition& joint = s.physics.joint(s.bridge.joint_of(arm));
  EXPECT_FALSE(joint.a);
  EXPECT_LT((joint.X_AJ.p - Vector3{0, 0, 2}).norm(), 1e-15);
}

TEST(HandOver, BindsAnAnimatedParentToCarryTheJoint) {
  // The parent is played by a clip but has no body: the bridge binds it, massless and animated, as long as it
  // is needed.
  Stage s;
  const NodeId base = s.scene.create(s.scene.root(), "base");
  const NodeId arm = box(s, base, "arm", Affine::Identity());
  s.scene.set_link(arm, test::pivot_link("j", Affine::Identity(), {0, 1, 0}));
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {base}).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(arm)));
  EXPECT_EQ(s.bridge.drive_of(base), Drive::Scene);
  EXPECT_EQ(s.physics.joint(s.bridge.joint_of(arm)).a, s.bridge.body_of(base));
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_LT((s.scene.world(arm).translation() - s.scene.world(base).translation()).norm(), 1e-10);
  s.bridge.release(arm);
  EXPECT_FALSE(s.bridge.drive_of(base).has_value());
}

TEST(HandOver, TakesALoopThatAnotherJointCloses) {
  // A ball of the user's own holds the arm at the origin already, and the link's pivot passes through it: the
  // arm turns about the pivot's axis as if the ball were not there.
  Stage s;
  const NodeId arm = box(s, s.scene.root(), "arm", Affine::Identity());
  ASSERT_TRUE(s.bridge.follow(arm).empty());
  s.physics.add(BallSettings{.name = "own", .b = s.bridge.body_of(arm)});
  s.scene.set_link(arm, test::pivot_link("j", Affine::Identity(), {0, 1, 0}));
  const std::vector<Diagnostic> notes = s.bridge.hand_over(arm);
  EXPECT_FALSE(has_error(notes)) << test::text_of(notes);
  EXPECT_EQ(s.bridge.drive_of(arm), Drive::Physics);
  EXPECT_EQ(s.physics.joints().size(), 2U);
  EXPECT_TRUE(s.bridge.advance(0.1).last.ok());
  EXPECT_LT(s.physics.joint_drift().distance, 1e-13);
  EXPECT_LT(s.physics.joint_drift().angle, 1e-13);
}

TEST(Follow, TakesALoopThatAnotherJointCloses) {
  // A followed node below a simulated one hangs on it by a driven joint; balls of the user's own tie both to
  // the world already. Its body stays where the scene wants it against the body above.
  Stage s;
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId b = box(s, a, "b", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.hand_over(a, Scope::Subtree)));
  s.physics.add(BallSettings{.name = "own a", .b = s.bridge.body_of(a)});
  s.physics.add(BallSettings{.name = "own b", .b = s.bridge.body_of(b)});
  EXPECT_FALSE(has_error(s.bridge.take_back(b)));
  EXPECT_EQ(s.bridge.drive_of(b), Drive::Scene);
  EXPECT_EQ(s.physics.joints().size(), 3U);
  EXPECT_TRUE(s.bridge.advance(0.05).last.ok());
  EXPECT_LT(s.physics.joint_drift().distance, 1e-12);
}

TEST(Reparent, TakesALoopThatAnotherJointCloses) {
  // Two bodies that the user has joined: one hung under the other by its link closes a loop, which starts
  // closed because joints are made where bodies stand.
  Stage s;
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId b = box(s, a, "b", moved({1, 0, 0}));
  const NodeId c = box(s, s.scene.root(), "c", moved({2, 0, 0}));
  s.scene.set_link(b, test::pivot_link("j", moved({1, 0, 0}), {0, 1, 0}, 0.2));
  ASSERT_FALSE(has_error(s.bridge.hand_over(s.scene.root(), Scope::Subtree)));
  s.physics.add(BallSettings{
      .a = s.bridge.body_of(b), .b = s.bridge.body_of(c), .X_AJ = {{0.5, 0, 0}}, .X_BJ = {{-0.5, 0, 0}}});
  EXPECT_FALSE(has_error(s.bridge.reparent(b, c)));
  EXPECT_EQ(s.scene.parent(b), c);
  EXPECT_EQ(s.physics.joint(s.bridge.joint_of(b)).a, s.bridge.body_of(c));
}

TEST(SetLinkValue, IsRefusedWhereALoopDoesNotAllowIt) {
  // A rod from the origin to (1, 0), its end tied by a bar of 2 m to the point (1, 2): a triangle, which has
  // no other shape. Turned by 0.5 rad the rod's end would be 1.53 m from that point.
  Stage s;
  const NodeId rod = box(s, s.scene.root(), "rod", Affine::Identity(), 1, {0.5, 0, 0});
  s.scene.set_link(rod, test::pivot_link("post", Affine::Identity(), {0, 0, 1}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(rod)));
  const NodeId bar = box(s, s.scene.root(), "bar", moved({1, 0, 0}), 1, {1, 0, 0});
  ASSERT_FALSE(has_error(s.bridge.hand_over(bar)));
  s.physics.add(PivotSettings{
      .name = "end", .a = s.bridge.body_of(rod), .b = s.bridge.body_of(bar), .X_AJ = {{1, 0, 0}}});
  s.physics.add(
      PivotSettings{.name = "wall", .b = s.bridge.body_of(bar), .X_AJ = {{1, 2, 0}}, .X_BJ = {{0, 2, 0}}});
  const std::vector<Affine> before = test::locals(s.scene);
  const std::vector<Diagnostic> notes = s.bridge.set_link_value(rod, 0.5);
  ASSERT_TRUE(has_error(notes));
  EXPECT_EQ(
      to_string(notes.front()),
      "rod: error: joint 'post': its loop cannot be closed with this value; nothing is changed; choose a "
      "value within its reach, or leave it to the others of its loop");
  EXPECT_EQ(s.scene.link(rod)->value[0], 0);
  EXPECT_TRUE(test::same_bits(before, test::locals(s.scene)));
}

TEST(HandOver, RefusesAStaticNodeBelow) {
  // Its body would stand while its node went along.
  Stage s;
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId b = box(s, a, "b", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.fix(b)));
  EXPECT_TRUE(says(s.bridge.hand_over(a), "a/b", "it is static and would be carried along"));
  s.bridge.release(b);
  ASSERT_FALSE(has_error(s.bridge.hand_over(a)));
  EXPECT_TRUE(says(s.bridge.fix(b), "a/b", "it would be carried along by a simulated node above it"));
}

TEST(HandOver, TellsOfAMatrixThatTheLinkCannotMake) {
  // The node was moved off its link; it is joined where it is, with a warning.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "arm", Affine::Identity());
  s.scene.set_link(id, test::pivot_link("j", Affine::Identity(), {0, 0, 1}));
  s.scene.set_local(id, moved({0, 0, 0.5}));
  EXPECT_TRUE(says(s.bridge.hand_over(id), "arm", "not one that its pivot link can make"));
  EXPECT_LT(s.physics.joint_drift().distance, 1e-15);
}

}  // namespace
}  // namespace pantin
