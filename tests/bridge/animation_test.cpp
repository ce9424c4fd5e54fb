// Several clips at once on nodes of a bridge: blends, hand-over out of a fade, root motion, events.
#include <gtest/gtest.h>

#include "support/finite_differences.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::cubic_track;
using test::Stage;

/// Another smooth clip of two seconds.
Clip nodding_clip() {
  Clip clip = test::swinging_clip();
  clip.name = "nod";
  clip.tracks[0] = cubic_track(0, Channel::Rotation, 4, {{1, 0, 0, 0}, {0.9, 0, 0, 0.3}, {1, 0.2, 0, 0}},
                               {{0, 0.1, 0.4, -0.2}, {0, 0.3, 0, 0.2}, {0, 0, 0.2, 0}});
  clip.tracks[1] = cubic_track(0, Channel::Translation, 3, {{0, 1, 0}, {-1, 0.5, 0}, {0, 0.3, 1}},
                               {{-1, 0, 0.3}, {0.2, 0.1, 1}, {0, -1, 0}});
  return clip;
}

bool says(const std::vector<Diagnostic>& notes, const std::string& text) {
  for (const Diagnostic& note : notes)
    if (to_string(note).find(text) != std::string::npos) return true;
  return false;
}

/// A box that fades from swinging to nodding between 0.5 and 1 s.
struct Fading {
  Fading() {
    EXPECT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
    EXPECT_TRUE(s.bridge.play(nodding_clip(), {id}, {.weight = 0}).empty());
    const std::vector<PlayId> plays = s.bridge.player().plays_of(id);
    from = plays.at(0);
    to = plays.at(1);
    s.bridge.cross_fade(from, to, {.begin = 0.5, .duration = 0.5});
  }
  /// Velocity and angular velocity from differences of the player's own poses; it is asked for the pose
  /// alone.
  [[nodiscard]] std::pair<Vector3, Vector3> differenced(double t) const {
    const auto pose = [&](double at) { return s.bridge.player().motion(id, at).value; };
    const Eigen::Matrix<double, 3, 4> rate = test::first_difference(pose, t, 0.004);
    const Matrix3 W = rate.leftCols<3>() * pose(t).leftCols<3>().transpose();
    return {rate.col(3), {W(2, 1), W(0, 2), W(1, 0)}};
  }

  Stage s{};
  NodeId id = box(s, s.scene.root(), "a", Affine::Identity(), 2, {0.1, 0.2, -0.3});
  PlayId from{}, to{};
};

TEST(Blending, HandsOverTheVelocityOfTheBlend) {
  // In the middle of a cross-fade the velocity has a part from the weight's own rate. Oracle: sixth-order
  // differences of poses.
  for (const bool followed : {false, true}) {
    Fading it;
    if (followed) {
      ASSERT_TRUE(it.s.bridge.follow(it.id).empty());
    }
    static_cast<void>(it.s.bridge.advance_until(0.7));
    ASSERT_FALSE(has_error(it.s.bridge.hand_over(it.id)));
    const RigidBody body = it.s.physics.body(it.s.bridge.body_of(it.id));
    const auto [v, w] = it.differenced(0.7);
    EXPECT_LT((body.v_WB() - v).norm(), 1e-8);
    EXPECT_LT((body.w_WB() - w).norm(), 1e-8);
    EXPECT_GT(v.norm(), 0.5);
  }
}

TEST(Blending, IsFollowedThroughItsBreaks) {
  // A followed body is where the blend is after every step, before, in and after the fade.
  Fading it;
  ASSERT_TRUE(it.s.bridge.follow(it.id).empty());
  for (const double t : {0.3, 0.5, 0.61, 0.9, 1.0, 1.7}) {
    static_cast<void>(it.s.bridge.advance_until(t));
    const Pose X = it.s.physics.body(it.s.bridge.body_of(it.id)).X_WB();
    const Eigen::Matrix<double, 3, 4> M = it.s.bridge.player().motion(it.id, t).value;
    EXPECT_LT((X.p - M.col(3)).norm(), 1e-13) << t;
    EXPECT_LT((X.rotation() - M.leftCols<3>()).norm(), 1e-13) << t;
    EXPECT_LT((it.s.scene.local(it.id).affine() - M).norm(), 1e-13) << t;
  }
}

TEST(Blending, TimesAreRelativeToTheirPlay) {
  // Begun at 3 s with a fade over its first second: half the weight half a second later.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "a");
  static_cast<void>(s.bridge.advance_until(3));
  Track track{.channel = Channel::Translation, .width = 3, .times = {0}, .values = {4, 0, 0}};
  ASSERT_TRUE(s.bridge
                  .play({.name = "far", .duration = 1, .tracks = {track}}, {id},
                        {.warp = Curve{Interpolation::Linear, {0, 1}, {0, 1}},
                         .weight = fade({.begin = 0, .duration = 1})})
                  .empty());
  static_cast<void>(s.bridge.advance_until(3.5));
  EXPECT_NEAR(s.scene.local(id).translation().x(), 2, 1e-12);
  s.bridge.set_weight(s.bridge.player().plays()[0], Curve{Interpolation::Linear, {0, 1}, {0.5, 0}});
  static_cast<void>(s.bridge.advance_until(4));
  EXPECT_NEAR(s.scene.local(id).translation().x(), 1, 1e-12);
}

TEST(Blending, StopsOnePlayOfSeveral) {
  // What still plays has the node again; what nothing plays on stays where it was, followed or not.
  Fading it;
  ASSERT_TRUE(it.s.bridge.follow(it.id).empty());
  static_cast<void>(it.s.bridge.advance_until(0.75));
  it.s.bridge.stop_playing(it.from);
  EXPECT_TRUE(it.s.bridge.is_played(it.id));
  static_cast<void>(it.s.bridge.advance_until(0.8));
  EXPECT_LT((it.s.physics.body(it.s.bridge.body_of(it.id)).X_WB().p -
             it.s.bridge.player().motion(it.id, 0.8).value.col(3))
                .norm(),
            1e-13);
  const Affine there = it.s.scene.local(it.id);
  it.s.bridge.stop_playing(it.to);
  EXPECT_FALSE(it.s.bridge.is_played(it.id));
  static_cast<void>(it.s.bridge.advance_until(1.2));
  EXPECT_LT((it.s.scene.local(it.id).affine() - there.affine()).norm(), 1e-14);
}

TEST(Blending, AnotherLayerOrWeightIsNoRival) {
  // Two clips that both want all of a node are refused; on another layer, added, or with a weight they are
  // not.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "a");
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  EXPECT_TRUE(says(s.bridge.play(nodding_clip(), {id}), "give one of them another layer or a weight"));
  EXPECT_TRUE(s.bridge.play(nodding_clip(), {id}, {.layer = 1}).empty());
  EXPECT_TRUE(s.bridge.play(nodding_clip(), {id}, {.weight = 0.5}).empty());
  EXPECT_TRUE(s.bridge.play(nodding_clip(), {id}, {.blend = Blend::Additive}).empty());
  EXPECT_EQ(s.bridge.player().plays_of(id).size(), 4U);
}

/// character / hips, a clip that walks 2 m/s along x and steps at 0.25 and 0.75 s of each second.
struct Walking {
  Walking() {
    Track track{.channel = Channel::Translation, .width = 3, .times = {0, 1}, .values = {0, 0, 1, 2, 0, 1}};
    Clip walk{.name = "walk", .duration = 1, .tracks = {track}};
    walk.events = {{0.25, "left"}, {0.75, "right"}};
    EXPECT_TRUE(
        s.bridge.play(walk, {hips}, {.root = RootMotion{.source = hips, .carrier = character}}).empty());
  }
  Stage s{};
  NodeId character = box(s, s.scene.root(), "character", Affine::Identity());
  NodeId hips = box(s, character, "hips", Affine::Identity());
};

TEST(RootMotionInABridge, GivesItsVelocityOnHandOver) {
  // The character, not the hips, moves at 2 m/s, through the loops; handed over it goes on so; the hips' body
  // above it moves with it.
  Walking it;
  ASSERT_TRUE(it.s.bridge.follow(it.hips).empty());
  static_cast<void>(it.s.bridge.advance_until(3.4));
  EXPECT_NEAR(it.s.scene.local(it.character).translation().x(), 6.8, 1e-12);
  EXPECT_LT((it.s.scene.local(it.hips).translation() - Vector3{0, 0, 1}).norm(), 1e-12);
  const auto v = [&](NodeId id) { return it.s.physics.body(it.s.bridge.body_of(id)).v_WB(); };
  EXPECT_LT((v(it.hips) - Vector3{2, 0, 0}).norm(), 1e-12);
  ASSERT_FALSE(has_error(it.s.bridge.hand_over(it.character)));
  EXPECT_LT((v(it.character) - Vector3{2, 0, 0}).norm(), 1e-12);
}

TEST(RootMotionInABridge, GoesOnFromWherePhysicsLeftIt) {
  // Taken back, the character is led on from there and walks as before; moved by hand it goes on from its new
  // place.
  Walking it;
  static_cast<void>(it.s.bridge.advance_until(1));
  ASSERT_FALSE(has_error(it.s.bridge.hand_over(it.character)));
  ASSERT_FALSE(has_error(it.s.bridge.teleport(it.character, test::moved({0, 7, 0}))));
  static_cast<void>(it.s.bridge.advance_until(2));
  ASSERT_FALSE(has_error(it.s.bridge.take_back(it.character, Scope::Node, {.blend_time = 0.05})));
  const double start = it.s.scene.local(it.character).translation().x();
  static_cast<void>(it.s.bridge.advance_until(6));
  const Vector3 p = it.s.scene.local(it.character).translation();
  EXPECT_NEAR(p.y(), 7, 1e-9);
  EXPECT_NEAR(p.x() - start, 8,
              0.2);  // less what the re-entry, with its time constant of 0.05 s, costs at 2 m/s
  it.s.bridge.set_local(it.character, test::moved({-1, 0, 0}));
  static_cast<void>(it.s.bridge.advance_until(6.5));
  EXPECT_NEAR(it.s.scene.local(it.character).translation().x(), 0, 1e-9);
}

TEST(RootMotionInABridge, StandsStoppingOnesNode) {
  // The source, then the carrier, are taken out of the play while bodies follow them: what is left stays
  // where it is, and nothing asks the player for what it does not animate.
  Walking it;
  ASSERT_TRUE(it.s.bridge.follow(it.hips).empty());
  static_cast<void>(it.s.bridge.advance_until(0.5));
  it.s.bridge.stop_playing(it.hips);
  static_cast<void>(it.s.bridge.advance_until(1));
  EXPECT_NEAR(it.s.scene.local(it.character).translation().x(), 2, 1e-12);
  it.s.bridge.stop_playing(it.character);
  static_cast<void>(it.s.bridge.advance_until(1.5));
  EXPECT_NEAR(it.s.scene.local(it.character).translation().x(), 2, 1e-12);
  EXPECT_TRUE(it.s.bridge.player().plays().empty());
}

TEST(EventsInABridge, AreInTheReport) {
  // Passed at physics time, each once, whatever the updates; those that an advance has not reached are not.
  Walking it;
  const auto names = [&](const AdvanceReport& report) {
    std::string all;
    for (const PlayedEvent& event : report.events)
      all += it.s.bridge.player().clip(event.play).events[event.index].name + " ";
    return all;
  };
  EXPECT_EQ(names(it.s.bridge.advance_until(0.5)), "left ");
  EXPECT_EQ(names(it.s.bridge.advance_until(2)), "right left right ");
  EXPECT_EQ(names(it.s.bridge.advance_until(2.2)), "");
  it.s.bridge.schedule({.time = 2.5, .node = it.character, .scope = Scope::Node});
  EXPECT_EQ(names(it.s.bridge.advance_until(2.8)), "left right ");  // also around a toggle within the advance
}

}  // namespace
}  // namespace pantin
