// Links that mimic others, on the animated side.
#include <gtest/gtest.h>

#include <cmath>

#include <pantin/bridge/mimic.hpp>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::Stage;

/// Three sliders and a bystander: "two" = 2 one + 0.1, "three" = -3 two + 1 = -6 one + 0.7.
Model chain() {
  const auto slider = [](const char* name, std::optional<LinkMimic> mimic) {
    Link link = test::slider_link(name, Affine::Identity(), Vector3::UnitX());
    link.mimic = std::move(mimic);
    return link;
  };
  Model model{.name = "m"};
  model.nodes.push_back({.name = "base"});
  model.nodes.push_back({.name = "c", .parent = 0, .link = slider("three", LinkMimic{"two", -3, 1})});
  model.nodes.push_back({.name = "a", .parent = 0, .link = slider("one", std::nullopt)});
  model.nodes.push_back({.name = "b", .parent = 0, .link = slider("two", LinkMimic{"one", 2, 0.1})});
  model.nodes.push_back({.name = "d", .parent = 0, .link = slider("four", std::nullopt)});
  return model;
}

double value(const Stage& s, NodeId id) { return s.scene.link(id)->value[0]; }

TEST(Mimic, FollowsItsLeaderOverSeveralLinks) {
  // By the rules above, value and matrix; the bystander stays, and so does the same chain of another
  // instance.
  Stage s;
  const Instance one = s.bridge.instantiate(chain(), s.scene.root(), {.prefix = "one"});
  const Instance other = s.bridge.instantiate(chain(), s.scene.root(), {.prefix = "other"});
  s.bridge.set_link_value(one.nodes[2], 0.5);
  EXPECT_DOUBLE_EQ(value(s, one.nodes[3]), 1.1);
  EXPECT_DOUBLE_EQ(value(s, one.nodes[1]), -2.3);
  EXPECT_NEAR(s.scene.world(one.nodes[1]).translation().x(), -2.3, 1e-15);
  EXPECT_EQ(value(s, one.nodes[4]), 0);
  EXPECT_EQ(value(s, other.nodes[3]), 0);
  s.bridge.set_link_value(one.nodes[3], 7);  // set itself: its own follower goes along, its leader does not
  EXPECT_DOUBLE_EQ(value(s, one.nodes[1]), -20);
  EXPECT_DOUBLE_EQ(value(s, one.nodes[2]), 0.5);
}

TEST(Mimic, FollowsAClipExactly) {
  // The rule is linear, so a cubic spline of the leader is one of the follower: its value and rate at any
  // time are the rule's; a track of the follower's own would win.
  Stage s;
  const Instance m = s.bridge.instantiate(chain(), s.scene.root());
  Clip clip{.name = "c", .duration = 2};
  clip.tracks.push_back(
      test::cubic_track(0, Channel::LinkValue, 1, {{0.2}, {0.9}, {-0.4}}, {{1}, {-2}, {0.5}}));
  std::vector<NodeId> targets{m.nodes[2]};
  Followers followers;
  add_followers(s.scene, m.nodes, followers);
  const Clip complete = with_followers(clip, followers, targets);
  ASSERT_EQ(complete.tracks.size(), 3u);
  ASSERT_EQ(targets.size(), 3u);
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const TrackSample leader = sample(complete.tracks[0], t);
    for (const auto& [track, a, b] : {std::tuple{1, 2.0, 0.1}, {2, -6.0, 0.7}}) {
      const TrackSample follower = sample(complete.tracks[static_cast<std::size_t>(track)], t);
      EXPECT_NEAR(follower.value[0], a * leader.value[0] + b, 1e-14);
      EXPECT_NEAR(follower.first[0], a * leader.first[0], 1e-13);
      EXPECT_NEAR(follower.second[0], a * leader.second[0], 1e-12);
    }
  }
  ASSERT_FALSE(has_error(s.bridge.play(clip, {m.nodes[2]})));
  EXPECT_NEAR(value(s, m.nodes[3]), 2 * 0.2 + 0.1, 1e-15);
  s.bridge.advance(1.0);
  EXPECT_NEAR(s.scene.world(m.nodes[3]).translation().x(), 2 * 0.9 + 0.1, 1e-12);
}

TEST(Mimic, LeavesAFollowerWithATrackOfItsOwn) {
  // "two" moves by its own track, and "three" follows that.
  Stage s;
  const Instance m = s.bridge.instantiate(chain(), s.scene.root());
  Clip clip{.name = "c", .duration = 2};
  for (const std::uint32_t target : {0U, 1U}) {
    clip.tracks.push_back({.target = target,
                           .channel = Channel::LinkValue,
                           .width = 1,
                           .times = {0, 2},
                           .values = {target + 1.0, target + 1.0}});
  }
  ASSERT_FALSE(has_error(s.bridge.play(clip, {m.nodes[2], m.nodes[3]})));
  EXPECT_DOUBLE_EQ(value(s, m.nodes[3]), 2);
  EXPECT_DOUBLE_EQ(value(s, m.nodes[1]), -3 * 2 + 1);
}

TEST(Mimic, EndsWhereLinksFollowEachOther) {
  // Two that follow each other: each is set once.
  Stage s;
  Model model = chain();
  model.nodes[2].link->mimic = LinkMimic{"two", 1, 0};
  const Instance m = s.bridge.instantiate(model, s.scene.root());
  s.bridge.set_link_value(m.nodes[2], 1);
  EXPECT_DOUBLE_EQ(value(s, m.nodes[2]), 1);
  EXPECT_DOUBLE_EQ(value(s, m.nodes[3]), 2.1);
}

/// A pendulum "one" of 1 kg that swings; "two" = 0.5 one + 0.1 slides, "three" = -2 two + 1 turns, and "four"
/// = one slides by itself.
struct Led {
  Led() {
    gravity = s.physics.forces().add(Gravity{});
    Model model{.name = "m"};
    const auto follower = [&](Link link, LinkMimic rule) {
      link.mimic = std::move(rule);
      model.nodes.push_back({.name = link.name, .parent = 0, .link = link});
    };
    model.nodes.push_back({.name = "base"});
    model.nodes.push_back({.name = "one",
                           .parent = 0,
                           .link = test::pivot_link("one", Affine::Identity(), Vector3::UnitY(), 0.3),
                           .mass = test::box_mass(1, {0.1, 0.1, 0.4}, {0, 0, -0.5})});
    follower(test::slider_link("two", Affine::Identity(), Vector3::UnitX()), {"one", 0.5, 0.1});
    follower(test::pivot_link("three", Affine::Identity(), Vector3::UnitZ()), {"two", -2, 1});
    follower(test::slider_link("four", Affine::Identity(), Vector3::UnitZ()), {"one", 1, 0});
    nodes = s.bridge.instantiate(model, s.scene.root()).nodes;
  }
  [[nodiscard]] double joint() const { return s.physics.joint_value(s.bridge.joint_of(nodes[1]))[0]; }

  Stage s{1.0 / 240};
  ForceId gravity{};
  std::vector<NodeId> nodes;
};

TEST(Mimic, FollowsASimulatedLeader) {
  // The rule holds between the joint of physics and the animated links, directly and over a link between,
  // value and matrix; before the leader has moved nothing is touched.
  Led led;
  Stage& s = led.s;
  s.bridge.set_link_value(led.nodes[2], 7);
  ASSERT_FALSE(has_error(s.bridge.hand_over(led.nodes[1])));
  s.bridge.sync_out();
  EXPECT_EQ(value(s, led.nodes[2]), 7);
  for (int frame = 0; frame < 30; ++frame) {
    ASSERT_TRUE(s.bridge.advance(1.0 / 60).last.ok());
    const double angle = led.joint();
    ASSERT_NE(angle, 0.3);
    EXPECT_DOUBLE_EQ(value(s, led.nodes[2]), 0.5 * angle + 0.1);
    EXPECT_NEAR(s.scene.world(led.nodes[2]).translation().x(), 0.5 * angle + 0.1, 1e-15);
    EXPECT_NEAR(value(s, led.nodes[3]), -2 * (0.5 * angle + 0.1) + 1, 1e-15);
    EXPECT_DOUBLE_EQ(value(s, led.nodes[4]), angle);
  }
}

TEST(Mimic, LeavesWhatMovesByItselfToItself) {
  // "two" is played and "four" simulated: neither is written; "three" follows the clip of "two", and "four"
  // is geared to "one" (mimic_gears_test.cpp).
  Led led;
  Stage& s = led.s;
  ASSERT_FALSE(has_error(s.bridge.play(test::link_clip(1, 1, 2), {led.nodes[2]})));
  s.bridge.set_node_body(led.nodes[4], {.mass = test::box_mass(1, {0.1, 0.1, 0.1})});
  for (const std::size_t k : {1U, 4U}) ASSERT_FALSE(has_error(s.bridge.hand_over(led.nodes[k])));
  ASSERT_TRUE(s.bridge.advance(0.25).last.ok());
  EXPECT_DOUBLE_EQ(value(s, led.nodes[2]), 1);
  EXPECT_DOUBLE_EQ(value(s, led.nodes[3]), -1);
  EXPECT_NE(led.joint(), 0.3);
  EXPECT_NEAR(value(s, led.nodes[4]), led.joint(), 1e-14);
}

TEST(Mimic, CarriesABodyAlong) {
  // A follower with a body: its node is there at once, its body by the end of the next advance, and moves
  // meanwhile with the difference over the time of that advance.
  Led led;
  Stage& s = led.s;
  s.bridge.set_node_body(led.nodes[2], {.mass = test::box_mass(1, {0.1, 0.1, 0.1})});
  ASSERT_FALSE(has_error(s.bridge.hand_over(led.nodes[1])));
  ASSERT_FALSE(has_error(s.bridge.follow(led.nodes[2])));
  ASSERT_TRUE(s.bridge.advance(0.1).last.ok());
  const double first = value(s, led.nodes[2]);
  ASSERT_TRUE(s.bridge.advance(0.1).last.ok());
  const double second = value(s, led.nodes[2]);
  ASSERT_TRUE(s.bridge.advance(0.1).last.ok());
  const RigidBody body = s.physics.body(s.bridge.body_of(led.nodes[2]));
  EXPECT_NEAR(body.X_WB().p.x(), second, 1e-12);
  EXPECT_NEAR(body.v_WBcm().x(), (second - first) / 0.1, 1e-9);
  EXPECT_NE(value(s, led.nodes[2]), second);
}

TEST(Mimic, StaysWhereItsLeaderRests) {
  // Without gravity and rate the leader does not move: no bit of the scene changes.
  Led led;
  Stage& s = led.s;
  s.physics.forces().remove(led.gravity);
  s.bridge.set_link_value(led.nodes[1], 0.3);
  ASSERT_FALSE(has_error(s.bridge.hand_over(led.nodes[1])));
  const std::vector<Affine> before = test::locals(s.scene);
  for (int frame = 0; frame < 10; ++frame) ASSERT_TRUE(s.bridge.advance(0.1).last.ok());
  EXPECT_TRUE(test::same_bits(before, test::locals(s.scene)));
}

}  // namespace
}  // namespace pantin
