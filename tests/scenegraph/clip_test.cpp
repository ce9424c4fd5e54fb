#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <support/expect_contract.hpp>
#include <support/finite_differences.hpp>
#include <support/random_affine.hpp>

#include <pantin/scenegraph/clip.hpp>

namespace pantin {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A track of one number a key.
Track numbers(Interpolation interpolation, std::vector<double> times, std::vector<double> values) {
  return {.channel = Channel::LinkValue,
          .interpolation = interpolation,
          .width = 1,
          .times = std::move(times),
          .values = std::move(values)};
}

double value_at(const Track& track, double time, KeySide side = KeySide::After) {
  return sample(track, time, side).value[0];
}

TEST(StepTrack, HoldsEachKeyUntilTheNext) {
  // glTF, appendix C.2: the value is that of the last key; from the left a key still shows the one before.
  const Track track = numbers(Interpolation::Step, {1, 2, 4}, {10, 20, 40});
  EXPECT_EQ(value_at(track, 0), 10);
  EXPECT_EQ(value_at(track, 1.5), 10);
  EXPECT_EQ(value_at(track, 2, KeySide::Before), 10);
  EXPECT_EQ(value_at(track, 2), 20);
  EXPECT_EQ(value_at(track, 4, KeySide::Before), 20);
  EXPECT_EQ(value_at(track, 4), 40);
  EXPECT_EQ(value_at(track, kInf), 40);
  EXPECT_EQ(sample(track, 3).first[0], 0);
  EXPECT_EQ(sample(track, 3).second[0], 0);
}

TEST(LinearTrack, RunsStraightBetweenKeys) {
  // Value and slope of a straight line; at a key the slope is that of the side asked for, and outside it is
  // 0.
  const Track track = numbers(Interpolation::Linear, {1, 2, 4}, {10, 20, 0});
  EXPECT_DOUBLE_EQ(value_at(track, 1.25), 12.5);
  EXPECT_DOUBLE_EQ(sample(track, 1.25).first[0], 10);
  EXPECT_DOUBLE_EQ(sample(track, 2, KeySide::Before).first[0], 10);
  EXPECT_DOUBLE_EQ(sample(track, 2).first[0], -10);
  EXPECT_DOUBLE_EQ(value_at(track, 2), 20);
  EXPECT_DOUBLE_EQ(value_at(track, 2, KeySide::Before), 20);
  EXPECT_EQ(sample(track, 1, KeySide::Before).first[0], 0);
  EXPECT_EQ(sample(track, 1).first[0], 10);
  EXPECT_EQ(sample(track, 4, KeySide::Before).first[0], -10);
  EXPECT_EQ(sample(track, 4).first[0], 0);
  EXPECT_EQ(value_at(track, 9), 0);
  EXPECT_EQ(value_at(track, -kInf), 10);
  EXPECT_EQ(sample(track, 3).second[0], 0);
}

TEST(CubicTrack, ReproducesACubicWithItsDerivatives) {
  // A cubic through its own values and slopes is itself (four conditions, four coefficients), on intervals of
  // any length; its derivatives are closed form.
  const auto p = [](double t) { return 1 - 2 * t + 3 * t * t - 0.5 * t * t * t; };
  const auto p1 = [](double t) { return -2 + 6 * t - 1.5 * t * t; };
  const auto p2 = [](double t) { return 6 - 3 * t; };
  Track track = numbers(Interpolation::CubicSpline, {0.5, 1.25, 4}, {});
  for (const double t : track.times) track.values.insert(track.values.end(), {p1(t), p(t), p1(t)});
  for (double t = 0.5; t <= 4; t += 0.125) {
    const KeySide side = t == 4 ? KeySide::Before : KeySide::After;
    EXPECT_NEAR(value_at(track, t, side), p(t), 1e-13) << t;
    EXPECT_NEAR(sample(track, t, side).first[0], p1(t), 1e-13) << t;
    EXPECT_NEAR(sample(track, t, side).second[0], p2(t), 1e-12) << t;
  }
}

TEST(CubicTrack, TakesInAndOutTangentsFromTheirSides) {
  // glTF stores in-tangent, value, out-tangent: at the middle key the slope is 7 from the left and -3 from
  // the right.
  const Track track = numbers(Interpolation::CubicSpline, {0, 1, 2}, {99, 0, 0, 7, 1, -3, 0, 0, 99});
  EXPECT_DOUBLE_EQ(sample(track, 1, KeySide::Before).first[0], 7);
  EXPECT_DOUBLE_EQ(sample(track, 1).first[0], -3);
  EXPECT_DOUBLE_EQ(value_at(track, 1), 1);
  EXPECT_EQ(sample(track, 2).first[0], 0);
  EXPECT_EQ(value_at(track, 3), 0);
}

TEST(Track, VectorsAreInterpolatedNumberByNumber) {
  // Each number of a translation runs by itself.
  const Track track{.interpolation = Interpolation::Linear, .times = {0, 2}, .values = {0, 1, 2, 2, 1, -2}};
  const TrackSample at = sample(track, 0.5);
  EXPECT_DOUBLE_EQ(at.value[0], 0.5);
  EXPECT_DOUBLE_EQ(at.value[1], 1);
  EXPECT_DOUBLE_EQ(at.value[2], 1);
  EXPECT_DOUBLE_EQ(at.first[2], -2);
}

TEST(Track, ASingleKeyIsAConstant) {
  // All interpolations hold it before and after, without a break.
  for (const Interpolation kind : {Interpolation::Step, Interpolation::Linear, Interpolation::CubicSpline}) {
    const bool cubic = kind == Interpolation::CubicSpline;
    const Track track = numbers(kind, {3}, cubic ? std::vector<double>{9, 5, 9} : std::vector<double>{5});
    for (const double t : {0.0, 3.0, 7.0})
      for (const KeySide side : {KeySide::Before, KeySide::After}) {
        EXPECT_EQ(value_at(track, t, side), 5);
        EXPECT_EQ(sample(track, t, side).first[0], 0);
      }
    EXPECT_EQ(next_break(track, 0), kInf);
  }
}

TEST(NextBreak, IsTheNextKeyOfAnyInterpolation) {
  // Strictly after the time given; also the first and the last key, where the curve meets being held.
  for (const Interpolation kind : {Interpolation::Step, Interpolation::Linear, Interpolation::CubicSpline}) {
    const Track track = numbers(kind, {1, 2, 4}, {});
    EXPECT_EQ(next_break(track, 0), 1);
    EXPECT_EQ(next_break(track, 1), 2);
    EXPECT_EQ(next_break(track, 3.5), 4);
    EXPECT_EQ(next_break(track, 4), kInf);
  }
}

TEST(ProblemWithTrack, IsEmptyForGoodTracks) {
  // One of each channel, the link value in all its widths.
  EXPECT_EQ(problem_with(numbers(Interpolation::Step, {0, 1}, {0, 1})), "");
  EXPECT_EQ(problem_with(Track{.times = {0}, .values = {1, 2, 3}}), "");
  EXPECT_EQ(problem_with(Track{.channel = Channel::Scale, .times = {0}, .values = {0, 0, 0}}), "");
  EXPECT_EQ(
      problem_with(Track{.channel = Channel::Rotation, .width = 4, .times = {0}, .values = {0, 0, 0, 2}}),
      "");
  EXPECT_EQ(problem_with(Track{
                .channel = Channel::LinkValue, .width = 7, .times = {0}, .values = {0, 0, 0, 0, 0, 0, 2}}),
            "");
}

TEST(ProblemWithTrack, NamesEachFault) {
  // One fault each, with the key where it is.
  EXPECT_EQ(problem_with(Track{.width = 4, .times = {0}, .values = {1, 2, 3, 4}}),
            "a translation has width 3 and must not be 4");
  EXPECT_EQ(problem_with(Track{.channel = Channel::Rotation, .width = 3}),
            "a rotation has width 4 and must not be 3");
  EXPECT_EQ(problem_with(Track{.channel = Channel::Scale, .width = 1}),
            "a scale has width 3 and must not be 1");
  EXPECT_EQ(problem_with(Track{.channel = Channel::LinkValue, .width = 5}),
            "a link value has width 1, 2, 3, 4 or 7 and must not be 5");
  const Interpolation step = Interpolation::Step;
  EXPECT_EQ(problem_with(numbers(step, {}, {})), "it has no keys");
  EXPECT_EQ(problem_with(numbers(step, {0, kNaN}, {1, 1})), "key 1 at nan s is not finite");
  EXPECT_EQ(problem_with(numbers(step, {-1, 0}, {1, 1})), "key 0 at -1.000000 s is before 0");
  EXPECT_EQ(problem_with(numbers(step, {0, 1, 1}, {1, 1, 1})),
            "key 2 at 1.000000 s is not after the key before it");
  EXPECT_EQ(problem_with(numbers(step, {0, 1}, {1})), "2 keys need 2 numbers, not 1");
  EXPECT_EQ(problem_with(numbers(Interpolation::CubicSpline, {0, 1}, {1, 1})),
            "2 keys need 6 numbers, not 2");
  EXPECT_EQ(problem_with(numbers(step, {0, 1}, {1, kInf})), "a number of key 1 is not finite");
  EXPECT_EQ(
      problem_with(Track{
          .channel = Channel::Rotation, .width = 4, .times = {0, 1}, .values = {1, 0, 0, 0, 0, 0, 0, 0}}),
      "the quaternion of key 1 has length 0; the identity is 1, 0, 0, 0");
}

TEST(Sample, RefusesWhatCannotBeSampled) {
  // No keys, or a time that is no number: there is no answer.
  test::expect_contract([] { static_cast<void>(sample(Track{}, 0)); }, "cannot be sampled");
  test::expect_contract([] { static_cast<void>(sample(numbers(Interpolation::Step, {0}, {1}), kNaN)); },
                        "time to sample at is not a number");
}

}  // namespace
}  // namespace pantin
