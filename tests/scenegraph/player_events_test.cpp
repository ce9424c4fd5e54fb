// Events of clips, passed by advancing.
#include <gtest/gtest.h>

#include <cmath>
#include <support/animated_scene.hpp>
#include <support/random_affine.hpp>

namespace pantin {
namespace {

using test::AnimatedScene;

/// A clip of one second with events at these times, named a, b, c, ...
Clip with_events(const std::vector<double>& times) {
  Clip clip = test::clip({test::track(Channel::Translation, Interpolation::Step, {0}, {0, 0, 0})}, 1);
  for (const double time : times)
    clip.events.push_back({time, std::string(1, static_cast<char>('a' + clip.events.size()))});
  return clip;
}

/// Names of what the last advance passed, in order.
std::string passed(const Player& player) {
  std::string names;
  for (const PlayedEvent& event : player.events()) names += player.clip(event.play).events[event.index].name;
  return names;
}
std::string advance(Player& player, double elapsed) {
  player.advance(elapsed);
  return passed(player);
}

TEST(Events, ArePassedOnceEach) {
  // (before, after], the beginning once; times and names as in the clip.
  AnimatedScene it{with_events({0, 0.25, 0.5}), {.loop = Loop::Once}};
  EXPECT_EQ(advance(it.player, 0.25), "ab");
  EXPECT_EQ(it.player.events()[0].time, 0);
  EXPECT_EQ(it.player.events()[1].time, 0.25);
  EXPECT_EQ(advance(it.player, 0.125), "");
  EXPECT_EQ(advance(it.player, 0.125), "c");
  EXPECT_EQ(advance(it.player, 5), "");
}

TEST(Events, CountEveryLap) {
  // Three and a half laps in one advance: at a seam the end of the lap comes before the start of the next;
  // the end of the lap before the first is not passed by beginning there.
  AnimatedScene it{with_events({0, 0.5, 1})};
  EXPECT_EQ(advance(it.player, 3.25), "abcabcabca");
  EXPECT_EQ(it.player.events()[3].lap, 1);
  EXPECT_EQ(it.player.events()[3].time, 1);
  EXPECT_EQ(it.player.events()[2].lap, 0);
  EXPECT_EQ(advance(it.player, 0.25), "b");
}

TEST(Events, RunBackwards) {
  // At speed -1 from the end the order turns round, at the seam too.
  AnimatedScene it{with_events({0, 0.25, 1}), {.offset = 1, .speed = -1}};
  EXPECT_EQ(advance(it.player, 1.75), "cbacb");
  EXPECT_TRUE(it.player.events()[0].is_backwards);
  EXPECT_EQ(it.player.events()[1].time, 0.75);
  AnimatedScene once{with_events({0, 0.25, 1}), {.offset = 0.25, .speed = -1, .loop = Loop::Once}};
  EXPECT_EQ(advance(once.player, 10), "ba");
}

TEST(Events, AreNotPassedBySeeksNorStandingStill) {
  // What a seek leaps over is not told; what it lands on is told by the next advance.
  AnimatedScene it{with_events({0.25, 0.5, 0.75})};
  it.player.set_time(0.5);
  EXPECT_EQ(passed(it.player), "");
  EXPECT_EQ(advance(it.player, 0.125), "b");
  it.player.set_time(0.1);
  EXPECT_EQ(advance(it.player, 0.2), "a");
  AnimatedScene stands{with_events({0, 0.25}), {.offset = 0.25, .speed = 0}};
  EXPECT_EQ(advance(stands.player, 3), "");
}

TEST(Events, AreNeitherLostNorToldTwice) {
  // Any clip, speed and steps, also steps that land on events to round-off: what all advances together tell
  // is what one advance over the whole time tells.
  std::mt19937_64 random{90};
  for (int k = 0; k < 200; ++k) {
    const double speed = test::uniform(random, 0.05, 4) * (k % 2 == 0 ? 1 : -1);
    const PlayerSettings settings{.begin = test::uniform(random, -3, 3),
                                  .offset = test::uniform(random, 0, 1),
                                  .speed = speed,
                                  .loop = k % 5 == 0 ? Loop::Once : Loop::Repeat};
    const Clip clip = with_events({0, 0.1, 0.1, 1.0 / 3, 0.7, 1});
    AnimatedScene whole{clip, settings}, parts{clip, settings};
    const double start = test::uniform(random, -10, 10);
    whole.player.set_time(start);
    parts.player.set_time(start);
    std::string together;
    for (int n = 0; n < 60; ++n)
      together += advance(parts.player, std::abs(1 / (speed * (n % 7 == 0 ? 3 : 10))));
    whole.player.advance_to(parts.player.time());
    ASSERT_EQ(together, passed(whole.player)) << k;
  }
}

TEST(Events, CarryTheWeightAndTheirPlay) {
  // Two plays at once, in order of time, then of age; a fade's value at the event's time.
  Scene scene;
  const NodeId node = scene.create(scene.root(), "node");
  Player player;
  const PlayId a = player.play(scene, with_events({0.5}), {node});
  const PlayId b =
      player.play(scene, with_events({0.25, 0.5}), {node}, {.weight = fade({.begin = 0, .duration = 1})});
  player.advance(0.75);
  ASSERT_EQ(player.events().size(), 3U);
  EXPECT_EQ(player.events()[0].play, b);
  EXPECT_EQ(player.events()[1].play, a);
  EXPECT_EQ(player.events()[2].play, b);
  EXPECT_DOUBLE_EQ(player.events()[2].weight, 0.5);
}

TEST(Events, FollowAWarp) {
  // At half the pace the event at 0.5 comes at 1 s.
  AnimatedScene it{with_events({0.5}), {.warp = Curve{Interpolation::Linear, {0, 4}, {0, 2}}}};
  EXPECT_EQ(advance(it.player, 0.9), "");
  EXPECT_EQ(advance(it.player, 0.2), "a");
  EXPECT_DOUBLE_EQ(it.player.events()[0].time, 1);
}

}  // namespace
}  // namespace pantin
