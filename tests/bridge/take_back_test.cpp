// Physics -> Scene: pose kept, link's value measured, the way back to the clip, driven joints below what is
// simulated.
#include <gtest/gtest.h>

#include <pantin/bridge/rigid_motion.hpp>
#include <pantin/physics/constraints/driven.hpp>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::moved;
using test::Stage;
using test::turned;

struct Motion {
  Affine M_WN;
  Vector3 v, w;
};
Motion motion_of(const Stage& s, NodeId id) {
  const RigidBody body = s.physics.body(s.bridge.body_of(id));
  return {s.scene.world(id), body.v_WB(), body.w_WB()};
}

TEST(TakeBack, LeavesANodeWithoutClipExactlyWhereItIsAtRest) {
  // The matrix that was written last stays, bit for bit, and the body stands there.
  Stage s;
  const NodeId parent = s.scene.create(s.scene.root(), "p", turned(0.3, {1, 1, 0}) * test::scaled({1, 2, 3}));
  const NodeId id = box(s, parent, "a", moved({1, 0, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  s.physics.set_velocity(s.bridge.body_of(id), {1, 2, 3}, {4, 5, 6});
  static_cast<void>(s.bridge.advance(0.3));
  const std::vector<Affine> before = test::locals(s.scene);
  ASSERT_TRUE(s.bridge.take_back(id).empty());
  EXPECT_EQ(s.bridge.drive_of(id), Drive::Scene);
  static_cast<void>(s.bridge.advance(0.3));
  EXPECT_TRUE(test::same_bits(before, test::locals(s.scene)));
  EXPECT_EQ(motion_of(s, id).v, Vector3::Zero());
  EXPECT_LT(test::relative_difference(test::by_body(s, id), s.scene.world(id)), 1e-14);
}

TEST(TakeBack, MakesTheMeasuredCoordinateTheLinksValue) {
  // A pendulum that has fallen for a while is taken back: the link's value is the joint's, and makes the same
  // matrix.
  Stage s;
  s.physics.forces().add(Gravity{});
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity(), 1, {0.5, 0, 0});
  s.scene.set_link(id, test::pivot_link("j", moved({0, 0, 1}), {0, 1, 0}, 0.1));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  static_cast<void>(s.bridge.advance(0.4));
  const double angle = s.physics.joint_value(s.bridge.joint_of(id));
  EXPECT_GT(std::abs(angle - 0.1), 0.5);
  ASSERT_TRUE(s.bridge.take_back(id).empty());
  const Link& link = *s.scene.link(id);
  EXPECT_DOUBLE_EQ(link.value[0], angle);
  EXPECT_LT((local_matrix(link, link.value).affine() - s.scene.local(id).affine()).norm(), 1e-12);
  EXPECT_FALSE(s.bridge.joint_of(id));
  EXPECT_TRUE(s.physics.joints().empty());
}

TEST(TakeBack, LeadsBackToTheClipWithoutAJump) {
  // At the instant of taking back, pose and velocity go on (differences over 1e-6 s of a motion with
  // accelerations of some 1e2 m/s^2 show up to 1e-4); after many time constants the node is where the clip
  // is, to round-off.
  Stage s{1.0 / 240};
  const NodeId parent = s.scene.create(s.scene.root(), "p", moved({1, 2, 0}) * turned(0.7, {1, 2, 0}));
  const NodeId id = box(s, parent, "a", Affine::Identity(), 1, {0.2, 0.1, 0});
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  s.physics.forces().add(Gravity{});
  static_cast<void>(s.bridge.advance_until(0.25));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  static_cast<void>(s.bridge.advance_until(0.75));
  const Motion before = motion_of(s, id);
  ASSERT_TRUE(s.bridge.take_back(id, Scope::Node, {.blend_time = 0.1}).empty());
  const Motion after = motion_of(s, id);
  EXPECT_LT(test::relative_difference(after.M_WN, before.M_WN), 1e-15);
  EXPECT_LT((after.v - before.v).norm() + (after.w - before.w).norm(), 1e-12);
  static_cast<void>(s.bridge.advance_until(0.75 + 1e-6));
  const Motion next = motion_of(s, id);
  const Affine step = before.M_WN.inverse() * next.M_WN;
  EXPECT_LT((next.M_WN.translation() - before.M_WN.translation() - 1e-6 * before.v).norm(), 1e-9);
  EXPECT_LT((next.v - before.v).norm(), 1e-3);
  EXPECT_LT((step.linear() - Matrix3::Identity()).norm(), 1e-4);
  // The scene shows what physics has, all the way.
  for (int k = 0; k < 20; ++k) {
    static_cast<void>(s.bridge.advance(0.05));
    EXPECT_LT(test::relative_difference(test::by_body(s, id), s.scene.world(id)), 1e-13);
  }
  static_cast<void>(s.bridge.advance_until(0.75 + 0.1 * 42));
  const Player player{s.scene, test::swinging_clip(), {id}};
  EXPECT_LT((s.scene.local(id).affine() - player.motion(id, s.bridge.time()).value).norm(), 1e-13);
}

TEST(TakeBack, DecaysTheDistanceAsACriticallyDampedSystem) {
  // A node at rest 1 m off a clip that stands: the distance is (1 + t / T) exp(-t / T), in closed form.
  Stage s{0.01};
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  Track still{.target = 0, .channel = Channel::Translation, .times = {0, 1}, .values = {0, 0, 0, 0, 0, 0}};
  ASSERT_TRUE(s.bridge.play({.name = "still", .duration = 1, .tracks = {still}}, {id}).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  ASSERT_FALSE(has_error(s.bridge.teleport(id, moved({1, 0, 0}))));
  ASSERT_TRUE(s.bridge.take_back(id, Scope::Node, {.blend_time = 0.2}).empty());
  for (int k = 1; k <= 50; ++k) {
    static_cast<void>(s.bridge.advance(0.02));
    const double x = s.bridge.time() / 0.2;
    EXPECT_NEAR(s.scene.world(id).translation().x(), (1 + x) * std::exp(-x), 1e-13);
  }
}

TEST(TakeBack, ReturnsAtOnceWithoutABlend) {
  // A blend time of 0 is a jump to the clip, and what hangs on the node jumps along.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId arm = box(s, id, "arm", Affine::Identity());
  s.scene.set_link(arm, test::pivot_link("j", moved({0, 0, 1}), {0, 1, 0}, 0.3));
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id, Scope::Subtree)));
  ASSERT_FALSE(has_error(s.bridge.teleport(id, moved({10, 0, 0}))));
  ASSERT_TRUE(s.bridge.take_back(id, Scope::Node, {.blend_time = 0}).empty());
  EXPECT_LT((s.scene.world(id).translation()).norm(), 1e-14);
  EXPECT_LT((s.scene.world(arm).translation() - Vector3{0, 0, 1}).norm(), 1e-14);
  EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(arm)), 0.3, 1e-14);
}

TEST(TakeBack, OfAWholeRobotKeepsItsJointsTogetherOnTheWayBack) {
  // Base and two arms are played, simulated apart and taken back: on the way back each arm's pivot stays on
  // its parent, because every node is led back in the frame of its parent.
  Stage s;
  s.physics.forces().add(Gravity{});
  const NodeId base = box(s, s.scene.root(), "base", Affine::Identity());
  const NodeId upper = box(s, base, "upper", Affine::Identity());
  const NodeId lower = box(s, upper, "lower", Affine::Identity());
  s.scene.set_link(upper, test::pivot_link("j1", moved({0, 0, 1}), {0, 1, 0}));
  s.scene.set_link(lower, test::pivot_link("j2", moved({1, 0, 0}), {0, 1, 1}));
  Clip clip = test::swinging_clip();
  clip.tracks.push_back(test::link_track(1, 0.5));
  clip.tracks.push_back(test::link_track(2, -0.8));
  ASSERT_TRUE(s.bridge.play(clip, {base, upper, lower}).empty());
  static_cast<void>(s.bridge.advance(0.3));
  ASSERT_FALSE(has_error(s.bridge.hand_over(base, Scope::Subtree)));
  static_cast<void>(s.bridge.advance(0.7));
  ASSERT_TRUE(s.bridge.take_back(base, Scope::Subtree).empty());
  EXPECT_TRUE(s.physics.joints().empty());
  for (int k = 0; k < 30; ++k) {
    static_cast<void>(s.bridge.advance(0.05));
    EXPECT_LT((s.scene.local(upper).translation() - Vector3{0, 0, 1}).norm(), 1e-9);
    EXPECT_LT((s.scene.local(lower).translation() - Vector3{1, 0, 0}).norm(), 1e-9);
  }
}

TEST(TakeBack, BelowASimulatedBodyMakesADrivenJoint) {
  // The hand of a falling body is taken back: it stays where it is on the body, and the body carries its mass
  // on.
  Stage s{0.01};
  s.physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  const NodeId body = box(s, s.scene.root(), "body", Affine::Identity(), 3);
  const NodeId hand = box(s, body, "hand", moved({1, 0, 0}), 2);
  s.scene.set_link(hand, test::pivot_link("j", moved({1, 0, 0}), {0, 1, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(body, Scope::Subtree)));
  s.physics.set_velocity(s.bridge.body_of(body), {0, 0, 1}, {0, 1, 0});
  static_cast<void>(s.bridge.advance(0.2));
  const test::Momentum before = test::momentum(s.physics);
  const Affine M_BH = s.scene.local(hand);
  ASSERT_TRUE(s.bridge.take_back(hand).empty());
  EXPECT_EQ(s.physics.joint(s.bridge.joint_of(hand)).kind, JointKind::Driven);
  static_cast<void>(s.bridge.advance(0.5));
  const test::Momentum after = test::momentum(s.physics);
  // Gravity on 5 kg for 0.5 s, and nothing else from outside.
  EXPECT_LT((after.linear - before.linear - Vector3{0, 0, -25}).norm(), 1e-10);
  EXPECT_EQ(s.scene.local(hand).matrix(), M_BH.matrix());
  EXPECT_LT(test::relative_difference(test::by_body(s, hand), s.scene.world(hand)), 1e-13);
}

TEST(TakeBack, KeepsAPendulumOnAnAnimatedBodyJoined) {
  // The upper of two joined bodies is taken back; the lower one stays simulated on the same joint.
  Stage s;
  s.physics.forces().add(Gravity{});
  const NodeId top = box(s, s.scene.root(), "top", Affine::Identity());
  const NodeId arm = box(s, top, "arm", Affine::Identity(), 1, {0, 0, -0.5});
  s.scene.set_link(arm, test::pivot_link("j", moved({0, 0, -1}), {0, 1, 0}, 0.7));
  ASSERT_FALSE(has_error(s.bridge.hand_over(top, Scope::Subtree)));
  const JointId joint = s.bridge.joint_of(arm);
  static_cast<void>(s.bridge.advance(0.2));
  const double angle = s.physics.joint_value(joint);
  ASSERT_TRUE(s.bridge.take_back(top).empty());
  EXPECT_EQ(s.bridge.joint_of(arm), joint);
  EXPECT_DOUBLE_EQ(s.physics.joint_value(joint), angle);
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_LT(s.physics.joint_drift().distance, 1e-12);
}

TEST(TakeBack, RefusesABlendTimeThatMeansNothing) {
  // Checked first, as a diagnostic.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  for (const double time : {-1.0, std::nan("")}) {
    const std::vector<Diagnostic> notes = s.bridge.take_back(id, Scope::Node, {.blend_time = time});
    ASSERT_TRUE(has_error(notes));
    EXPECT_NE(notes[0].problem.find("blend time is"), std::string::npos);
  }
  EXPECT_EQ(s.bridge.drive_of(id), Drive::Physics);
}

TEST(TakeBack, OfWhatIsNotSimulatedDoesNothing) {
  // Taking back twice, or what was never handed over, is no error.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  EXPECT_TRUE(s.bridge.take_back(id).empty());
  EXPECT_FALSE(s.bridge.drive_of(id).has_value());
}

TEST(TakeBack, AndHandOverAgainInFlightKeepsPoseAndVelocity) {
  // Toggling in the middle of the way back takes the blended motion along.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity(), 1, {0.1, 0, 0});
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  static_cast<void>(s.bridge.advance(0.3));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  static_cast<void>(s.bridge.advance(0.3));
  ASSERT_TRUE(s.bridge.take_back(id).empty());
  static_cast<void>(s.bridge.advance(0.1));
  const Motion before = motion_of(s, id);
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  const Motion after = motion_of(s, id);
  EXPECT_EQ(before.M_WN.matrix(), after.M_WN.matrix());
  EXPECT_LT((before.v - after.v).norm() + (before.w - after.w).norm(), 1e-13);
  EXPECT_LT(test::relative_difference(test::by_body(s, id), s.scene.world(id)), 1e-14);
}

}  // namespace
}  // namespace pantin
