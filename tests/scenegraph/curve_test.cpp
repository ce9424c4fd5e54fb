#include <pantin/scenegraph/curve.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <support/expect_contract.hpp>
#include <support/finite_differences.hpp>
#include <support/random_affine.hpp>

namespace pantin {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Curve, OfANumberIsConstant) {
  // The same at all times, at rest, without breaks.
  const Curve half = 0.5;
  EXPECT_TRUE(half.is_constant());
  for (const double t : {-1e9, 0.0, 3.0}) EXPECT_EQ(sample(half, t).value, 0.5);
  EXPECT_EQ(sample(half, 1).first, 0);
  EXPECT_EQ(next_break(half, -5), kInf);
}

TEST(Curve, IsHeldOutsideItsKeys) {
  // Keys may be before 0; between them it is linear.
  const Curve ramp{Interpolation::Linear, {-2, 2}, {1, 5}};
  EXPECT_EQ(problem_with(ramp), "");
  EXPECT_EQ(sample(ramp, -3).value, 1);
  EXPECT_EQ(sample(ramp, 0).value, 3);
  EXPECT_EQ(sample(ramp, 0).first, 1);
  EXPECT_EQ(sample(ramp, 7).value, 5);
  EXPECT_EQ(next_break(ramp, -2), 2);
  const Curve later = ramp.shifted(10, 100);
  EXPECT_EQ(sample(later, 10).value, 103);
}

TEST(Fade, IsTheSmoothStep) {
  // 3 u^2 - 2 u^3: value, slope and curvature in closed form at u = 1/4.
  const Curve up = fade({.begin = 1, .duration = 2, .from = 2, .to = 6});
  const CurveSample at = sample(up, 1.5);
  EXPECT_NEAR(at.value, 2 + 4 * (3.0 / 16 - 2.0 / 64), 1e-15);
  EXPECT_NEAR(at.first, 4 * (6 * 0.25 - 6.0 / 16) / 2, 1e-14);
  EXPECT_NEAR(at.second, 4 * (6 - 12 * 0.25) / 4, 1e-14);
  test::expect_contract([] { static_cast<void>(fade({.duration = 0})); }, "duration 0.000000 s of a fade");
  EXPECT_EQ(problem_with(FadeSettings{.to = kInf}), "begin, from and to of a fade must be finite");
}

TEST(Warp, GoesOnStraight) {
  // Linear with the slope of its end intervals, one key at rate 1, cubic with the outer tangents.
  const Curve linear{Interpolation::Linear, {0, 1, 3}, {0, 2, 3}};
  EXPECT_DOUBLE_EQ(sample_warp(linear, -1).value, -2);
  EXPECT_DOUBLE_EQ(sample_warp(linear, 5).value, 4);
  EXPECT_DOUBLE_EQ(sample_warp(Curve{7.0}, 3).value, 10);
  const Curve cubic{Interpolation::CubicSpline, {0, 1}, {0.5, 0, 1, 1, 1, 2}};
  EXPECT_DOUBLE_EQ(sample_warp(cubic, -2).value, -1);
  EXPECT_DOUBLE_EQ(sample_warp(cubic, 3).value, 5);
  EXPECT_EQ(sample_warp(cubic, 0, KeySide::Before).first, 0.5);
  EXPECT_EQ(sample_warp(cubic, 0, KeySide::After).first, 1);
}

TEST(Warp, TimeOfIsItsInverse) {
  // For monotone warps, to round-off of the slope; on a level the first time.
  const Curve warps[] = {Curve{Interpolation::Linear, {-1, 1, 3}, {0, 3, 3.5}},
                         Curve{Interpolation::CubicSpline, {0, 2}, {1, 0, 0.25, 2, 3, 0.5}}};
  std::mt19937_64 random{95};
  for (const Curve& warp : warps)
    for (int k = 0; k < 200; ++k) {
      const double t = test::uniform(random, -5, 8);
      EXPECT_NEAR(time_of(warp, sample_warp(warp, t).value), t, 1e-13);
    }
  const Curve level{Interpolation::Linear, {0, 1, 2, 3}, {0, 1, 1, 2}};
  EXPECT_EQ(time_of(level, 1), 1);
  EXPECT_EQ(time_of(Curve{Interpolation::CubicSpline, {0, 1}, {0, 0, 1, 1, 1, 0}}, 2), kInf);
}

TEST(ProblemWithWarp, NamesEachFault) {
  // Steps, and any place at which time would run back, outside the keys too.
  EXPECT_EQ(problem_with_warp(Curve{Interpolation::Linear, {0, 1}, {0, 0}}), "");
  EXPECT_EQ(problem_with_warp(fade({})), "");
  EXPECT_EQ(problem_with_warp(Curve{Interpolation::Step, {0, 1}, {0, 1}}),
            "time cannot go on in steps; use Linear keys");
  const std::string back =
      "it runs back between keys 0 and 1; for playing backwards there is a negative speed";
  EXPECT_EQ(problem_with_warp(Curve{Interpolation::Linear, {0, 1, 2}, {1, 0.5, 3}}),
            "it runs back before its first key");
  EXPECT_EQ(problem_with_warp(Curve{Interpolation::CubicSpline, {0, 1}, {1, 0, 8, 8, 1, 1}}), back);
  EXPECT_EQ(problem_with_warp(Curve{Interpolation::CubicSpline, {0, 1}, {-1, 0, 1, 1, 1, 1}}),
            "it runs back before its first key");
  EXPECT_EQ(problem_with_warp(Curve{Interpolation::CubicSpline, {0, 1}, {1, 0, 1, 1, 1, -1}}),
            "it runs back after its last key");
  EXPECT_EQ(problem_with_warp(Curve{Interpolation::Linear, {0, 0}, {0, 1}}),
            "key 1 at 0.000000 s is not after the key before it");
}

TEST(ProblemWithCurve, NamesFaultsOfKeys) {
  // Those of tracks, but times may be negative.
  EXPECT_EQ(problem_with(Curve{Interpolation::Linear, {}, {}}), "it has no keys");
  EXPECT_EQ(problem_with(Curve{Interpolation::Linear, {-1, 1}, {0}}), "2 keys need 2 numbers, not 1");
  EXPECT_EQ(problem_with(Curve{kInf}), "a number of key 0 is not finite");
}

}  // namespace
}  // namespace pantin
