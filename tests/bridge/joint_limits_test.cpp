// Limits of links while their nodes are simulated, and joints that break.
#include <gtest/gtest.h>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::moved;
using test::says;
using test::scaled;
using test::Stage;

/// Runs under gravity along `g_W` until things have come to rest.
void settle(Stage& s, const Vector3& g_W) {
  s.physics.forces().add(Gravity{.g_W = g_W});
  for (int i = 0; i < 120; ++i) ASSERT_TRUE(s.bridge.advance(1.0 / 60).last.ok());
}

TEST(JointLimits, HoldASliderInTheUnitsOfItsLink) {
  // Under a parent that scales by 3 along the axis, limits of -0.1 and 0.5 of the link are -0.3 and 1.5 m of
  // the joint; a mirror along the axis leaves them what they are for the link.
  for (const double scale : {3.0, -3.0}) {
    for (const double g : {9.81, -9.81}) {
      Stage s;
      const NodeId parent = s.scene.create(s.scene.root(), "p", scaled({1, 1, scale}));
      const NodeId id = box(s, parent, "lift", Affine::Identity());
      Link link = test::slider_link("j", Affine::Identity(), {0, 0, 1}, 0.2);
      link.limits[0] = {-0.1, 0.5};
      s.scene.set_link(id, link);
      ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
      settle(s, {0, 0, g});
      const double expected = g * scale > 0 ? 0.5 : -0.1;
      EXPECT_NEAR(s.scene.link(id)->value[0], expected, 1e-12);
      EXPECT_NEAR(s.scene.world(id).translation().z(), scale * expected, 1e-12);
    }
  }
}

TEST(JointLimits, HoldAPivotUnderAMirror) {
  // The value of a link counts the other way round in a mirrored parent; its limits are its own either way,
  // and shift with its zero.
  for (const double side : {1.0, -1.0}) {
    for (const double offset : {0.0, 2.0}) {
      Stage s;
      const NodeId parent = s.scene.create(s.scene.root(), "p", scaled({side, 1, 1}));
      const NodeId id = box(s, parent, "arm", Affine::Identity(), 1, {0, 0, 1});
      Link link = test::pivot_link("j", Affine::Identity(), {1, 0, 0}, 0.1);
      link.limits[0] = {-0.4, 0.7};
      link = with_zero_offset(link, offset);
      s.scene.set_link(id, link);
      ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
      const double begin = s.scene.link(id)->value[0];
      settle(s, {0, 0, -9.81});  // the arm stands upside down and falls to the side it leans to
      EXPECT_NEAR(s.scene.link(id)->value[0] - begin, 0.6, 1e-12) << side << ' ' << offset;
    }
  }
}

TEST(JointLimits, AreLeftOutWhereAskedTo) {
  // Joints made free have neither limits nor dry friction: the arm falls through to the other side.
  Stage s;
  s.bridge.leave_joints_free(true);
  const NodeId id = box(s, s.scene.root(), "arm", Affine::Identity(), 1, {0, 0, 1});
  NodeBody body = *s.bridge.node_body(id);
  body.joint_friction = 100;
  s.bridge.set_node_body(id, body);
  Link link = test::pivot_link("j", Affine::Identity(), {1, 0, 0}, 0.1);
  link.limits[0] = {-0.4, 0.7};
  s.scene.set_link(id, link);
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  s.physics.forces().add(Gravity{});
  for (int i = 0; i < 60; ++i) static_cast<void>(s.bridge.advance(1.0 / 60));
  EXPECT_GT(s.scene.link(id)->value[0], 1);
}

TEST(JointLimits, WarnOfALinkThatStartsBeyondThem) {
  // It is handed over where it is; the stop is there until it has moved back.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "arm", Affine::Identity(), 1, {0, 0, 1});
  Link link = test::pivot_link("j", Affine::Identity(), {1, 0, 0}, 0.9);
  link.limits[0] = {-0.4, 0.7};
  s.scene.set_link(id, link);
  const std::vector<Diagnostic> notes = s.bridge.hand_over(id);
  EXPECT_TRUE(says(notes, "arm", "1 joint(s) here start beyond their limits")) << test::text_of(notes);
  settle(s, {0, 0, -9.81});
  EXPECT_NEAR(s.scene.link(id)->value[0], 0.9, 1e-14);
}

TEST(JointLimits, GoWithDryFriction) {
  // Friction that can bear the arm's weight holds it for ever, to the bit.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "arm", Affine::Identity(), 1, {0, 0, 1});
  NodeBody body = *s.bridge.node_body(id);
  body.joint_friction = 5;  // the weight asks for 9.81 sin(0.1)
  s.bridge.set_node_body(id, body);
  s.scene.set_link(id, test::pivot_link("j", Affine::Identity(), {1, 0, 0}, 0.1));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  settle(s, {0, 0, -9.81});
  EXPECT_NEAR(s.scene.link(id)->value[0], 0.1, 1e-15);
  EXPECT_EQ(s.physics.axis_mode(s.bridge.joint_of(id)), AxisMode::Stuck);
}

TEST(JointLimits, LetABrokenJointGoUntilTheNodeIsHandedOverAnew) {
  // A joint that cannot bear the weight breaks in the first update: the node has no joint, a warning says so,
  // it falls freely, and what comes next works as ever.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "arm", Affine::Identity());
  NodeBody body = *s.bridge.node_body(id);
  body.joint_strength = {.force = 5};
  s.bridge.set_node_body(id, body);
  s.scene.set_link(id, test::pivot_link("j", Affine::Identity(), {1, 0, 0}));
  s.physics.forces().add(Gravity{.g_W = {0, 0, -9.81}});
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  const AdvanceReport report = s.bridge.advance(0.1);
  ASSERT_TRUE(report.last.ok());
  EXPECT_TRUE(says(report.notes, "arm", "its joint bore more than its strength and broke"));
  EXPECT_FALSE(s.bridge.joint_of(id));
  EXPECT_EQ(s.bridge.drive_of(id), Drive::Physics);
  ASSERT_TRUE(s.bridge.advance(0.4).notes.empty());
  EXPECT_LT(s.scene.world(id).translation().z(), -1);
  // Something else changes: the joint does not come back by itself.
  ASSERT_FALSE(has_error(s.bridge.hand_over(box(s, id, "tool", moved({0, 0, 1})))));
  EXPECT_FALSE(s.bridge.joint_of(id));
  ASSERT_FALSE(has_error(s.bridge.take_back(id)));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  EXPECT_TRUE(s.bridge.joint_of(id));
  EXPECT_TRUE(s.bridge.advance(0.01).last.ok());
}

}  // namespace
}  // namespace pantin
