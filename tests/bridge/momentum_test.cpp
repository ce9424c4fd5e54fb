// What an animated body does to what it hangs on, and what hangs on it: conserved quantities and closed
// forms.
#include <gtest/gtest.h>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::momentum;
using test::moved;
using test::Stage;
using test::turned;

/// A floating body with an arm that a clip swings about a pivot, and a forearm on the arm.
struct Swimmer {
  Stage s{1.0 / 480};
  NodeId body{}, arm{}, forearm{};

  Swimmer() {
    body = box(s, s.scene.root(), "body", turned(0.3, {1, 0, 1}), 4);
    arm = box(s, body, "arm", Affine::Identity(), 2, {0.5, 0, 0});
    s.scene.set_link(arm, test::pivot_link("shoulder", moved({0.2, 0, 0.1}), {0, 1, 1}));
    forearm = box(s, arm, "forearm", Affine::Identity(), 1, {0.3, 0.1, 0});
    s.scene.set_link(forearm, test::pivot_link("elbow", moved({1, 0, 0}), {1, 1, 0}));
  }
  static Clip clip() {
    return {.name = "swing",
            .duration = 2,
            .tracks = {test::cubic_track(0, Channel::LinkValue, 1, {{0}, {1.2}, {-0.5}}, {{0}, {0.5}, {0}})}};
  }
  void swing_arm() { ASSERT_TRUE(s.bridge.play(clip(), {arm}, {.loop = Loop::Once}).empty()); }
};

TEST(AnimatedBelowSimulated, CannotChangeTheMomentumOfAFreeSystem) {
  // A clip moves an arm of a floating body: forces are internal, so linear momentum stays zero and so does
  // the angular momentum about any point, to the accuracy of the integrator (rk4 at 1/480 s: about 1e-9),
  // though the body turns.
  Swimmer swimmer;
  Stage& s = swimmer.s;
  ASSERT_FALSE(has_error(s.bridge.hand_over(swimmer.body, Scope::Subtree)));
  ASSERT_TRUE(s.bridge.take_back(swimmer.arm).empty());
  swimmer.swing_arm();
  const Affine start = s.scene.world(swimmer.body);
  static_cast<void>(s.bridge.advance(1.3));
  EXPECT_EQ(s.physics.joint(s.bridge.joint_of(swimmer.arm)).kind, JointKind::Driven);
  EXPECT_LT(momentum(s.physics).linear.norm(), 1e-8);
  EXPECT_LT(momentum(s.physics).angular.norm(), 1e-8);
  EXPECT_GT((s.scene.world(swimmer.body).affine() - start.affine()).norm(), 0.05);  // it is a real motion
}

TEST(AnimatedBelowSimulated, JumpInTheVelocityOfTheClipIsAnInternalImpulse) {
  // Linear keys set the arm off with a jump in velocity in the middle of the run: momentum is conserved
  // through it.
  Swimmer swimmer;
  Stage& s = swimmer.s;
  ASSERT_FALSE(has_error(s.bridge.hand_over(swimmer.body, Scope::Subtree)));
  ASSERT_TRUE(s.bridge.take_back(swimmer.arm).empty());
  Track track{
      .target = 0, .channel = Channel::LinkValue, .width = 1, .times = {0, 0.5, 1}, .values = {0, 0, 2}};
  ASSERT_TRUE(
      s.bridge.play({.name = "kick", .duration = 1, .tracks = {track}}, {swimmer.arm}, {.loop = Loop::Once})
          .empty());
  static_cast<void>(s.bridge.advance(0.8));
  EXPECT_GT(s.physics.energy().kinetic, 0.1);
  EXPECT_LT(momentum(s.physics).linear.norm(), 1e-8);
  EXPECT_LT(momentum(s.physics).angular.norm(), 1e-8);
}

TEST(AnimatedBelowSimulated, FollowsItsClipWhileTheBodyTumbles) {
  // The relative pose is the clip's, whatever the body does: link value read from the relative matrix.
  Swimmer swimmer;
  Stage& s = swimmer.s;
  ASSERT_FALSE(has_error(s.bridge.hand_over(swimmer.body)));
  swimmer.swing_arm();
  ASSERT_FALSE(has_error(s.bridge.follow(swimmer.arm)));
  s.physics.set_velocity(s.bridge.body_of(swimmer.body), {1, 0, 0}, {0, 2, 5});
  for (int k = 0; k < 20; ++k) {
    static_cast<void>(s.bridge.advance(0.07));
    EXPECT_LT(test::relative_difference(test::by_body(s, swimmer.arm), s.scene.world(swimmer.arm)), 1e-12);
  }
}

TEST(AnimatedBelowSimulated, GoesOnWithTheClipsVelocityWhenHandedOver) {
  // The arm is let go in the middle of its clip: momentum and energy do not jump, the joint has the clip's
  // rate, and from then on the three bodies are free.
  Swimmer swimmer;
  Stage& s = swimmer.s;
  ASSERT_FALSE(has_error(s.bridge.hand_over(swimmer.body, Scope::Subtree)));
  ASSERT_TRUE(s.bridge.take_back(swimmer.arm).empty());
  swimmer.swing_arm();
  static_cast<void>(
      s.bridge.advance_until(4.0));  // beyond the way back to the clip, which is at rest after 2 s
  s.bridge.stop_playing(swimmer.arm);
  swimmer.swing_arm();
  static_cast<void>(s.bridge.advance_until(4.4));
  const double energy = s.physics.energy().total();
  ASSERT_FALSE(has_error(s.bridge.hand_over(swimmer.arm)));
  EXPECT_NEAR(s.physics.energy().total(), energy, 1e-12);
  const double rate = sample(swimmer.clip().tracks[0], 0.4).first[0];
  EXPECT_NEAR(s.physics.joint_rate(s.bridge.joint_of(swimmer.arm)), rate, 1e-6);
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_LT(momentum(s.physics).linear.norm(), 1e-8);
  EXPECT_NEAR(s.physics.energy().total(), energy, 1e-7 * energy);
}

TEST(SimulatedBelowAnimated, PendulumOnAnAcceleratedCartHangsAskew) {
  // A cart with constant acceleration a: a pendulum released at rest relative to it at the angle atan(a / g)
  // behind the vertical stays there in the cart's frame (equilibrium of gravity and inertia). Quadratic
  // motion by a cubic key.
  Stage s{1.0 / 240};
  s.physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  const double a = 4, angle = std::atan2(a, 10);
  const NodeId cart = s.scene.create(s.scene.root(), "cart");
  const NodeId arm = box(s, cart, "arm", Affine::Identity(), 1, {0, 0, -0.7});
  s.scene.set_link(arm, test::pivot_link("hinge", Affine::Identity(), {0, 1, 0}, angle));
  Track track{.target = 0,
              .channel = Channel::Translation,
              .interpolation = Interpolation::CubicSpline,
              .times = {0, 2},
              .values = {0, 0, 0, 0, 0, 0, 0, 0, 0, /**/ 2 * a, 0, 0, 2 * a, 0, 0, 0, 0, 0}};
  ASSERT_TRUE(
      s.bridge.play({.name = "go", .duration = 2, .tracks = {track}}, {cart}, {.loop = Loop::Once}).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(arm)));
  for (int k = 0; k < 30; ++k) {
    static_cast<void>(s.bridge.advance(1.0 / 20));
    EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(arm)), angle, 1e-9) << s.bridge.time();
  }
  EXPECT_NEAR(s.scene.world(cart).translation().x(), a / 2 * 1.5 * 1.5, 1e-12);
}

TEST(SimulatedBelowAnimated, PlatformThatTheUserMovesCarriesWhatHangsOnIt) {
  // A slider along x on a followed platform: free along it, held across it. Moved up by 0.6 m in 0.3 s, the
  // body goes up with it at 2 m/s and comes to rest with it, and keeps its place along the rail.
  Stage s{0.01};
  const NodeId platform = box(s, s.scene.root(), "platform", Affine::Identity());
  const NodeId load = box(s, platform, "load", Affine::Identity());
  s.scene.set_link(load, test::slider_link("rail", moved({0, 0, 1}), {1, 0, 0}, 0.5));
  ASSERT_TRUE(s.bridge.follow(platform).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(load)));
  static_cast<void>(s.bridge.advance(0.1));
  s.bridge.set_local(platform, moved({0, 0, 0.6}));
  static_cast<void>(s.bridge.advance(0.3));
  EXPECT_LT((s.physics.body(s.bridge.body_of(load)).v_WB() - Vector3{0, 0, 2}).norm(), 1e-10);
  EXPECT_LT((s.scene.world(load).translation() - Vector3{0.5, 0, 1.6}).norm(), 1e-10);
  static_cast<void>(s.bridge.advance(0.3));
  EXPECT_LT(s.physics.body(s.bridge.body_of(load)).v_WB().norm(), 1e-10);
  EXPECT_LT((s.scene.world(load).translation() - Vector3{0.5, 0, 1.6}).norm(), 1e-10);
}

TEST(SimulatedBelowAnimated, KeepsItsEnergyOnceTheAncestorIsHandedOver) {
  // An animated carrier at rest with a swinging pendulum is handed over: nothing jumps, and from then on the
  // energy of the free pair is conserved (rk4 at 1/480 s over 1 s: below 1e-7 of it).
  Swimmer swimmer;
  Stage& s = swimmer.s;
  ASSERT_TRUE(s.bridge.follow(swimmer.body).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(swimmer.arm, Scope::Subtree)));
  s.physics.set_joint_rate(s.bridge.joint_of(swimmer.arm), 3.0);
  static_cast<void>(s.bridge.advance(0.5));
  const double before = s.physics.energy().total();
  const double rate = s.physics.joint_rate(s.bridge.joint_of(swimmer.arm));
  ASSERT_FALSE(has_error(s.bridge.hand_over(swimmer.body)));
  EXPECT_NEAR(s.physics.joint_rate(s.bridge.joint_of(swimmer.arm)), rate, 1e-12);
  EXPECT_NEAR(s.physics.energy().total(), before, 1e-12);
  static_cast<void>(s.bridge.advance(1.0));
  EXPECT_NEAR(s.physics.energy().total(), before, 1e-7 * before);
}

}  // namespace
}  // namespace pantin
