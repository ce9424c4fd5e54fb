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

}  // namespace
}  // namespace pantin
