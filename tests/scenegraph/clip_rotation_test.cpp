// Tracks of rotations: value and derivatives of slerp and of normalised cubics.
#include <gtest/gtest.h>

#include <cmath>
#include <support/finite_differences.hpp>
#include <support/random_affine.hpp>

#include <pantin/scenegraph/clip.hpp>

namespace pantin {
namespace {

using Vector4 = Eigen::Vector4d;

Vector4 wxyz(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }
Vector4 first_four(const std::array<double, 7>& numbers) { return Vector4{numbers.data()}; }

Track rotations(Interpolation interpolation, const std::vector<double>& times,
                const std::vector<Vector4>& values) {
  Track track{.channel = Channel::Rotation, .interpolation = interpolation, .width = 4, .times = times};
  for (const Vector4& q : values) track.values.insert(track.values.end(), q.data(), q.data() + 4);
  return track;
}

Vector4 value_at(const Track& track, double t) { return first_four(sample(track, t).value); }

/// Derivatives against differences of the values around t. Curves vary over about a second, so with h = 0.01
/// truncation is near 1e-12 of their seventh and eighth derivatives, round-off near 1e-14 and 1e-12.
void expect_derivatives(const Track& track, double t, double tolerance) {
  const auto curve = [&](double time) { return value_at(track, time); };
  const TrackSample at = sample(track, t);
  EXPECT_LT((first_four(at.first) - test::first_difference(curve, t, 0.01)).norm(), tolerance) << t;
  EXPECT_LT((first_four(at.second) - test::second_difference(curve, t, 0.01)).norm(), 10 * tolerance) << t;
}

TEST(Slerp, TurnsAtConstantSpeed) {
  // About z from 0 to 2 rad in 4 s: the quaternion is (cos a/2, 0, 0, sin a/2) with a = t / 2, in closed form
  // with both derivatives.
  const Track track =
      rotations(Interpolation::Linear, {0, 4}, {{1, 0, 0, 0}, {std::cos(1), 0, 0, std::sin(1)}});
  for (const double t : {0.0, 0.3, 2.0, 3.9}) {
    const TrackSample at = sample(track, t);
    const double c = std::cos(t / 4);
    const double s = std::sin(t / 4);
    EXPECT_LT((first_four(at.value) - Vector4{c, 0, 0, s}).norm(), 1e-15);
    EXPECT_LT((first_four(at.first) - Vector4{-s, 0, 0, c} / 4).norm(), 1e-15);
    EXPECT_LT((first_four(at.second) - Vector4{-c, 0, 0, -s} / 16).norm(), 1e-15);
  }
}

TEST(Slerp, AgreesWithEigenOnAnyKeys) {
  // Eigen's slerp is another implementation of the same curve; it takes the shorter arc too. Keys need not be
  // unit.
  std::mt19937_64 random{30};
  for (int k = 0; k < 500; ++k) {
    const Quaternion a = test::random_rotation(random);
    const Quaternion b = test::random_rotation(random);
    const Track track = rotations(Interpolation::Linear, {1, 3}, {2 * wxyz(a), 0.5 * wxyz(b)});
    const double t = test::uniform(random, 1.1, 2.9);
    const Vector4 expected = wxyz(a.slerp((t - 1) / 2, b));
    const Vector4 q = value_at(track, t);
    ASSERT_LT(std::min((q - expected).norm(), (q + expected).norm()), 1e-14);
    expect_derivatives(track, t, 1e-11);
  }
}

TEST(Slerp, TakesTheShorterArcBetweenOppositeSigns) {
  // -q is the rotation q: between q and -q nothing moves, and between q and -p the way is that to p.
  std::mt19937_64 random{31};
  const Vector4 q = wxyz(test::random_rotation(random));
  const TrackSample still = sample(rotations(Interpolation::Linear, {0, 1}, {q, -q}), 0.5);
  EXPECT_LT((first_four(still.value) - q).norm(), 1e-15);
  EXPECT_LT(first_four(still.first).norm(), 1e-15);
  const Vector4 p{0.8, 0.6, 0, 0};
  const Vector4 identity{1, 0, 0, 0};
  const Vector4 there = value_at(rotations(Interpolation::Linear, {0, 1}, {identity, p}), 0.4);
  const Vector4 also = value_at(rotations(Interpolation::Linear, {0, 1}, {identity, -p}), 0.4);
  EXPECT_LT((there - also).norm(), 1e-15);
}

TEST(Slerp, IsAccurateForNearlyEqualKeys) {
  // Turns of 1e-3 down to 1e-15 rad in 1 s: the rate must have their relative accuracy, which quotients of
  // sines of the angle from an arc cosine would lose; half way the z part is sin(angle / 4), nearly angle
  // / 4.
  for (double angle = 1e-3; angle > 1e-15; angle *= 0.1) {
    const Vector4 end{std::cos(angle / 2), 0, 0, std::sin(angle / 2)};
    const TrackSample at = sample(rotations(Interpolation::Linear, {0, 1}, {{1, 0, 0, 0}, end}), 0.5);
    EXPECT_NEAR(at.value[3], std::sin(angle / 4), 1e-15 * angle);
    EXPECT_NEAR(at.first[3], angle / 2 * std::cos(angle / 4), 1e-14 * angle);
    EXPECT_NEAR(first_four(at.value).norm(), 1, 1e-15);
  }
}

TEST(Slerp, DoesHalfATurn) {
  // The longest arc there is: orthogonal quaternions, half a turn about x in 1 s. Speed pi rad/s, so |q'| =
  // pi / 2.
  const Track track = rotations(Interpolation::Linear, {0, 1}, {{1, 0, 0, 0}, {0, 1, 0, 0}});
  const TrackSample at = sample(track, 0.5);
  EXPECT_LT((first_four(at.value) - Vector4{std::sqrt(0.5), std::sqrt(0.5), 0, 0}).norm(), 1e-15);
  EXPECT_NEAR(first_four(at.first).norm(), std::acos(-1.0) / 2, 1e-15);
}

TEST(Slerp, MeetsItsKeysFromBothSides) {
  // At a key both limits are the key's rotation, with the speeds of the two arcs.
  const double half = std::sqrt(0.5);
  const Track track =
      rotations(Interpolation::Linear, {0, 1, 3}, {{1, 0, 0, 0}, {half, half, 0, 0}, {1, 0, 0, 0}});
  const TrackSample before = sample(track, 1, KeySide::Before);
  const TrackSample after = sample(track, 1, KeySide::After);
  EXPECT_LT((first_four(before.value) - first_four(after.value)).norm(), 1e-15);
  EXPECT_LT((first_four(before.first) + 2 * first_four(after.first)).norm(), 1e-15);
}

/// Three keys with tangents. Keys are of length 1.5 about, all in one half space, so that the curve stays
/// away from 0.
Track random_cubic(std::mt19937_64& random) {
  const auto tangent = [&] {
    const Vector3 v = test::random_vector(random);
    return Vector4{test::uniform(random, -1, 1), v.x(), v.y(), v.z()};
  };
  std::vector<Vector4> values;
  for (int k = 0; k < 3; ++k) {
    const Vector4 turn = wxyz(test::random_rotation(random));
    values.push_back(tangent());
    values.push_back(Vector4{1.5, 0, 0, 0} + turn);
    values.push_back(tangent());
  }
  return rotations(Interpolation::CubicSpline, {0, 1, 3}, values);
}

TEST(CubicRotation, IsTheNormalisedHermiteCurve) {
  // The same keys as four plain numbers give the curve before it is normalised, whose formula is tested by
  // itself.
  std::mt19937_64 random{32};
  for (int k = 0; k < 200; ++k) {
    const Track track = random_cubic(random);
    const double t = test::uniform(random, 0, 3);
    Vector4 plain;
    for (std::size_t j = 0; j < 4; ++j) {
      Track number{.channel = Channel::LinkValue,
                   .interpolation = track.interpolation,
                   .width = 1,
                   .times = track.times};
      for (std::size_t i = j; i < track.values.size(); i += 4) number.values.push_back(track.values[i]);
      plain[Eigen::Index(j)] = sample(number, t).value[0];
    }
    ASSERT_LT((value_at(track, t) - plain.normalized()).norm(), 1e-15);
  }
}

TEST(CubicRotation, HasExactDerivatives) {
  // Differences of the values; keys are kept away from, where the third derivative jumps.
  std::mt19937_64 random{33};
  for (int k = 0; k < 200; ++k) {
    const Track track = random_cubic(random);
    expect_derivatives(track, test::uniform(random, 0.05, 0.95), 1e-7);
    expect_derivatives(track, test::uniform(random, 1.05, 2.95), 1e-7);
  }
}

TEST(CubicRotation, DerivativesAreOrthogonalAsOnTheSphere) {
  // |q| = 1 at all times, so q.q' = 0 and q.q'' + q'.q' = 0: exact identities, to round-off.
  std::mt19937_64 random{34};
  for (int k = 0; k < 200; ++k) {
    const TrackSample at = sample(random_cubic(random), test::uniform(random, 0, 3));
    const Vector4 q = first_four(at.value);
    const Vector4 q1 = first_four(at.first);
    const Vector4 q2 = first_four(at.second);
    ASSERT_NEAR(q.dot(q1), 0, 1e-14 * (1 + q1.norm()));
    ASSERT_NEAR(q.dot(q2) + q1.squaredNorm(), 0, 1e-13 * (1 + q2.norm()));
  }
}

TEST(CubicRotation, StaysFiniteWhereTheCurvePassesThroughZero) {
  // From q to -q with no tangents the Hermite curve is 0 half way, which is no rotation: the nearer key is
  // given.
  const Vector4 q{0.5, 0.5, 0.5, 0.5};
  const Vector4 none = Vector4::Zero();
  const Track track = rotations(Interpolation::CubicSpline, {0, 1}, {none, q, none, none, -q, none});
  const TrackSample at = sample(track, 0.5);
  EXPECT_LT((first_four(at.value) + q).norm(), 1e-15);
  EXPECT_EQ(first_four(at.first).norm(), 0);
}

TEST(PoseTrack, InterpolatesPlaceAndRotationEachItsWay) {
  // A free link's value: the first three numbers straight, the last four by slerp, the same as in tracks of
  // their own.
  const double half = std::sqrt(0.5);
  const Track pose{.channel = Channel::LinkValue,
                   .width = 7,
                   .times = {0, 2},
                   .values = {0, 0, 0, 1, 0, 0, 0, 4, 2, 0, half, 0, half, 0}};
  const TrackSample at = sample(pose, 0.5);
  const TrackSample turn =
      sample(rotations(Interpolation::Linear, {0, 2}, {{1, 0, 0, 0}, {half, 0, half, 0}}), 0.5);
  EXPECT_DOUBLE_EQ(at.value[0], 1);
  EXPECT_DOUBLE_EQ(at.first[1], 1);
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_EQ(at.value[3 + j], turn.value[j]);
    EXPECT_EQ(at.first[3 + j], turn.first[j]);
    EXPECT_EQ(at.second[3 + j], turn.second[j]);
  }
}

TEST(StepRotation, IsNormalisedToo) {
  // Values of rotation tracks are unit quaternions under every interpolation.
  const Track track = rotations(Interpolation::Step, {0, 1}, {{2, 0, 0, 0}, {0, 3, 0, 4}});
  EXPECT_EQ(value_at(track, 0.5), (Vector4{1, 0, 0, 0}));
  EXPECT_LT((value_at(track, 1) - Vector4{0, 0.6, 0, 0.8}).norm(), 1e-15);
}

}  // namespace
}  // namespace pantin
