// Play time against clip time: speed, offset, loops, breaks.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <support/blends.hpp>

namespace pantin {
namespace {

using test::AnimatedScene;
using test::clip;
using test::track;

constexpr double kInf = std::numeric_limits<double>::infinity();

/// x is the clip time: 0 at 0 to 2 at 2, so that x tells where the clip stands.
Clip ruler() {
  return clip({track(Channel::Translation, Interpolation::Linear, {0, 2}, {0, 0, 0, 2, 0, 0})}, 2);
}

/// x counts the keys passed.
Clip steps() {
  return clip({track(Channel::Translation, Interpolation::Step, {0, 0.3, 0.7, 1},
                     {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0})},
              1);
}

TEST(PlayTime, RunsFromBeginAndOffsetAtItsSpeed) {
  // clip time = offset + speed (t - begin); the rate of x is the speed.
  AnimatedScene it{ruler(), {.begin = 10, .offset = 0.5, .speed = 2, .loop = Loop::Once}};
  EXPECT_DOUBLE_EQ(it.x(10), 0.5);
  EXPECT_DOUBLE_EQ(it.x(10.5), 1.5);
  EXPECT_DOUBLE_EQ(it.x_rate(10.5), 2);
}

TEST(PlayTime, OnceHoldsTheEnds) {
  // Before the clip's start its first value, after its end its last, both at rest; at the ends the side
  // decides.
  AnimatedScene it{ruler(), {.loop = Loop::Once}};
  EXPECT_EQ(it.x(-1), 0);
  EXPECT_EQ(it.x(7), 2);
  EXPECT_EQ(it.x_rate(7), 0);
  EXPECT_EQ(it.x_rate(-1), 0);
  EXPECT_EQ(it.x_rate(0, KeySide::Before), 0);
  EXPECT_EQ(it.x_rate(0, KeySide::After), 1);
  EXPECT_EQ(it.x_rate(2, KeySide::Before), 1);
  EXPECT_EQ(it.x_rate(2, KeySide::After), 0);
}

TEST(PlayTime, OnceEndsOnTheLastStep) {
  // A step at the very end is seen for ever after, though it takes up no time of the clip.
  AnimatedScene it{steps(), {.loop = Loop::Once}};
  EXPECT_EQ(it.x(1, KeySide::Before), 2);
  EXPECT_EQ(it.x(1), 3);
  EXPECT_EQ(it.x(5), 3);
}

TEST(PlayTime, RepeatStartsOverAtTheSeam) {
  // Modulo the duration, in both directions of time; at the seam the end from before, the start after.
  AnimatedScene it{ruler()};
  EXPECT_DOUBLE_EQ(it.x(5), 1);
  EXPECT_DOUBLE_EQ(it.x(-0.5), 1.5);
  EXPECT_EQ(it.x(4, KeySide::Before), 2);
  EXPECT_EQ(it.x(4, KeySide::After), 0);
  EXPECT_EQ(it.x_rate(4, KeySide::Before), 1);
  EXPECT_EQ(it.x_rate(4, KeySide::After), 1);
}

TEST(PlayTime, BackwardsSwapsTheSides) {
  // At speed -1 from the end: x falls, its rate is -1; at a step the earlier play time sees the later key.
  AnimatedScene it{ruler(), {.offset = 2, .speed = -1, .loop = Loop::Once}};
  EXPECT_DOUBLE_EQ(it.x(0.5), 1.5);
  EXPECT_DOUBLE_EQ(it.x_rate(0.5), -1);
  EXPECT_EQ(it.x_rate(2, KeySide::After), 0);
  EXPECT_EQ(it.x_rate(0, KeySide::Before), 0);
  AnimatedScene step{steps(), {.offset = 1, .speed = -1}};
  EXPECT_EQ(step.x(0.3, KeySide::Before), 2);
  EXPECT_EQ(step.x(0.3, KeySide::After), 1);
  EXPECT_EQ(step.x(1, KeySide::Before), 0);
  EXPECT_EQ(step.x(1, KeySide::After), 2);
}

TEST(PlayTime, StandsStillAtSpeedZero) {
  // One value for all times and both sides, no rate, no break, also on a key.
  AnimatedScene it{steps(), {.offset = 0.3, .speed = 0}};
  for (const KeySide side : {KeySide::Before, KeySide::After}) {
    EXPECT_EQ(it.x(0, side), 1);
    EXPECT_EQ(it.x(100, side), 1);
    EXPECT_EQ(it.x_rate(50, side), 0);
  }
  EXPECT_EQ(it.player.next_break(it.node, 0), kInf);
}

TEST(PlayTime, AClipOfNoDurationIsAConstant) {
  // One key at 0: nothing repeats, nothing breaks.
  AnimatedScene it{clip({track(Channel::Translation, Interpolation::Linear, {0}, {7, 0, 0})}, 0)};
  EXPECT_EQ(it.x(-3), 7);
  EXPECT_EQ(it.x(3), 7);
  EXPECT_EQ(it.player.next_break(it.node, 0), kInf);
}

TEST(PlayTime, SecondDerivativeGoesWithTheSquareOfTheSpeed) {
  // x = s^2 as a cubic spline, so x'' = 2 in clip time: times speed^2 in play time.
  const Track square = track(Channel::Translation, Interpolation::CubicSpline, {0, 1},
                             {0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 1, 0, 0, 2, 0, 0});
  AnimatedScene it{clip({square}, 1), {.speed = -3}};
  EXPECT_NEAR(it.player.motion(it.node, 0.1).second(0, 3), 18, 1e-13);
}

std::vector<double> breaks(const AnimatedScene& it, double from, double until) {
  std::vector<double> found;
  for (double t = it.player.next_break(it.node, from); t < until && found.size() < 1000;
       t = it.player.next_break(it.node, t))
    found.push_back(t);
  return found;
}

TEST(NextBreakOfPlayer, VisitsKeysAndSeams) {
  // Clip keys 0, 0.3, 0.7, 1 with seams at whole seconds, at double speed from play time 10.
  AnimatedScene it{steps(), {.begin = 10, .speed = 2}};
  const std::vector<double> expected{10.15, 10.35, 10.5, 10.65, 10.85, 11};
  const std::vector<double> found = breaks(it, 10, 11.1);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-14 * 11);
}

TEST(NextBreakOfPlayer, RunsBackwardsToo) {
  // From clip time 1 down at speed -1: breaks at 0.3 (key 0.7), 0.7 (key 0.3), 1 (seam), then the same again.
  AnimatedScene it{steps(), {.offset = 1, .speed = -1}};
  const std::vector<double> expected{0.3, 0.7, 1, 1.3, 1.7, 2};
  const std::vector<double> found = breaks(it, 0, 2.1);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-14);
}

TEST(NextBreakOfPlayer, EndsWithTheClipIfPlayedOnce) {
  // The last key is the last break; before the clip, its first key is the first.
  AnimatedScene it{steps(), {.begin = 5, .loop = Loop::Once}};
  const std::vector<double> found = breaks(it, 0, kInf);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found.front(), 5);
  EXPECT_EQ(found.back(), 6);
}

TEST(NextBreakOfPlayer, LandsExactlyOnKeys) {
  // Whoever steps onto a break must see the new value after it and the old one before it, however begin,
  // offset and speed round, also in late laps; just off it both are the same. The oracle is the order of the
  // keys: x must go up by one at each break (to 0 after 2 at the seam, where the last key takes no time), or
  // down at negative speeds.
  std::mt19937_64 random{51};
  for (int k = 0; k < 300; ++k) {
    const double speed = test::uniform(random, 0.01, 3) * (k % 2 == 0 ? 1 : -1);
    AnimatedScene it{
        steps(),
        {.begin = test::uniform(random, -10, 10), .offset = test::uniform(random, 0, 1), .speed = speed}};
    double t = test::uniform(random, -5, 5) + (k % 3 == 0 ? 1e4 : 0);
    for (int n = 0; n < 12; ++n) {
      const double next = it.player.next_break(it.node, t);
      ASSERT_GT(next, t);
      const double before = it.x(next, KeySide::Before);
      const double after = it.x(next, KeySide::After);
      ASSERT_EQ(after, std::fmod(before + (speed > 0 ? 1 : 2), 3)) << "at " << next;
      ASSERT_EQ(it.x((t + next) / 2), before);
      if (n > 0) {
        ASSERT_EQ(it.x(t, KeySide::After), before);
      }
      t = next;
    }
  }
}

TEST(NextBreakOfPlayer, IgnoresConstantTracks) {
  // A node whose tracks have one key each never breaks, though the clip repeats.
  AnimatedScene it{clip({track(Channel::Translation, Interpolation::Linear, {0.5}, {7, 0, 0})}, 2)};
  EXPECT_EQ(it.player.next_break(it.node, 0), kInf);
}

TEST(TimeWarp, MapsPlayTimeToClipTime) {
  // x is the clip time, so it shows the warp: half pace up to 2 s, then three times as fast, for ever.
  const Curve warp{Interpolation::Linear, {0, 2, 3}, {0, 1, 4}};
  AnimatedScene it{ruler(), {.warp = warp}};
  EXPECT_DOUBLE_EQ(it.x(1), 0.5);
  EXPECT_DOUBLE_EQ(it.x_rate(1), 0.5);
  EXPECT_DOUBLE_EQ(it.x_rate(2.1), 3);
  EXPECT_DOUBLE_EQ(it.x(2 + 0.2), 1.6);
  AnimatedScene late{ruler(), {.begin = 4, .offset = 0.5, .speed = -2, .warp = warp}};
  EXPECT_DOUBLE_EQ(late.x(3), 0.5);  // warped time 4
  EXPECT_DOUBLE_EQ(late.x_rate(2.9), -6);
}

TEST(TimeWarp, HasExactDerivatives) {
  // The chain rule's second term, x_s s'', counts under a warp that speeds up; fast and slow, both ways.
  std::mt19937_64 random{52};
  const Curve warp{Interpolation::CubicSpline, {0, 1, 2}, {1, 0, 0.2, 2, 1.5, 2, 0.1, 2.6, 1}};
  for (int k = 0; k < 50; ++k) {
    const double speed = test::uniform(random, 0.1, 0.4) * (k % 2 == 0 ? 1 : -1);
    AnimatedScene it{test::random_clip(random), {.begin = 1, .offset = 0.5, .speed = speed, .warp = warp}};
    test::expect_derivatives(it.player, it.node, test::uniform(random, 0.05, 0.95));
  }
}

TEST(TimeWarp, BreaksWhereItBendsAndWhereKeysAreReached) {
  // As the unwarped breaks do, each must be landed on exactly: x goes up by one at each key, whatever the
  // warp rounds; the warp's own keys are breaks besides.
  std::mt19937_64 random{53};
  for (int k = 0; k < 100; ++k) {
    const double v1 = test::uniform(random, 0.1, 2), v2 = v1 + test::uniform(random, 0.1, 2);
    const Curve warp = k % 2 == 0
                           ? Curve{Interpolation::Linear, {-1, 0, 1}, {0, v1, v2}}
                           : Curve{Interpolation::CubicSpline, {-1, 0, 1}, {1, 0, 0, 0, v1, 0, 0, v2, 1}};
    AnimatedScene it{steps(), {.speed = k % 3 == 0 ? -1.3 : 1.3, .warp = warp}};
    double t = -3;
    for (int n = 0; n < 15; ++n) {
      const double next = it.player.next_break(it.node, t);
      ASSERT_GT(next, t);
      const double before = it.x(next, KeySide::Before), after = it.x(next, KeySide::After);
      const bool is_bend = next == -1 || next == 0 || next == 1;
      const double step = k % 3 == 0 ? 2 : 1;
      if (after == before) {
        ASSERT_TRUE(is_bend) << next;
      } else {
        ASSERT_EQ(after, std::fmod(before + step, 3)) << "at " << next;
      }
      ASSERT_EQ(it.x((t + next) / 2), before);
      t = next;
    }
  }
}

}  // namespace
}  // namespace pantin
