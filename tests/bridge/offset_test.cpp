#include <pantin/bridge/offset.hpp>

#include <gtest/gtest.h>

#include <numbers>

#include "support/slope.hpp"

namespace pantin {
namespace {

using test::slope;

/// A base motion with exact derivatives: turning and flying along curves.
RigidMotion base_at(double t) {
  RigidMotion m;
  const Vector3 axis = Vector3{1, 2, -1}.normalized();
  m.X_AB.q = Quaternion{Eigen::AngleAxisd{std::sin(t), axis}};
  m.w_AB = std::cos(t) * axis;
  m.alpha_AB = -std::sin(t) * axis;
  m.X_AB.p = {std::sin(2 * t), t, 0};
  m.v_AB = {2 * std::cos(2 * t), 1, 0};
  m.a_AB = {-4 * std::sin(2 * t), 0, 0};
  return m;
}

RigidMotion elsewhere() {
  RigidMotion m;
  m.X_AB = {{0.5, -1, 2}, Quaternion{Eigen::AngleAxisd{2.5, Vector3{0, 1, 1}.normalized()}}};
  m.v_AB = {1, 2, -3};
  m.w_AB = {4, -1, 0.5};
  return m;
}

TEST(Offset, CriticalBeginsWithThePoseAndVelocityItIsGiven) {
  // At the start the blended motion is the one it leads from, in pose and both velocities: no jump is felt.
  const Offset offset{Fade::Critical, 3.0, 0.25, elsewhere(), base_at(3.0)};
  const RigidMotion m = offset.applied(base_at(3.0), 3.0, Side::After);
  const RigidMotion from = elsewhere();
  EXPECT_LT((m.X_AB.p - from.X_AB.p).norm(), 1e-14);
  EXPECT_LT(m.X_AB.q.angularDistance(from.X_AB.q), 1e-13);
  EXPECT_LT((m.v_AB - from.v_AB).norm(), 1e-13);
  EXPECT_LT((m.w_AB - from.w_AB).norm(), 1e-12);
}

TEST(Offset, DerivativesAreThoseOfThePose) {
  // Oracle: fourth-order differences of pose and velocity, h = 1e-4 of curves whose fifth derivatives are
  // below 1e5.
  for (const Fade fade : {Fade::Critical, Fade::Linear}) {
    const Offset offset{fade, 0, 0.5, elsewhere(), base_at(0)};
    const auto at = [&](double t) { return offset.applied(base_at(t), t, Side::After); };
    for (double t = 0.05; t < 0.45; t += 0.05) {
      const double h = 1e-4;
      const RigidMotion m = at(t);
      const Vector3 v = slope([&](double x) { return Vector3{at(x).X_AB.p}; }, t, h);
      const Vector3 a = slope([&](double x) { return Vector3{at(x).v_AB}; }, t, h);
      const Matrix3 R1 = slope([&](double x) { return Matrix3{at(x).X_AB.rotation()}; }, t, h);
      const Vector3 alpha = slope([&](double x) { return Vector3{at(x).w_AB}; }, t, h);
      EXPECT_LT((v - m.v_AB).norm(), 1e-8) << t;
      EXPECT_LT((a - m.a_AB).norm(), 1e-7) << t;
      EXPECT_LT((R1 - cross_matrix(m.w_AB) * m.X_AB.rotation()).norm(), 1e-8) << t;
      EXPECT_LT((alpha - m.alpha_AB).norm(), 1e-6) << t;
    }
  }
}

TEST(Offset, LinearGoesStraightAndBySlerp) {
  // Half way in time, a node that leads to a standing base is half way in position and in angle about the
  // same axis.
  RigidMotion base, from;
  from.X_AB = {{1, 0, 0}, Quaternion{Eigen::AngleAxisd{1.2, Vector3::UnitY()}}};
  const Offset offset{Fade::Linear, 10, 2, from, base};
  const RigidMotion m = offset.applied(base, 11, Side::After);
  EXPECT_LT((m.X_AB.p - Vector3{0.5, 0, 0}).norm(), 1e-15);
  EXPECT_LT(m.X_AB.q.angularDistance(Quaternion{Eigen::AngleAxisd{0.6, Vector3::UnitY()}}), 1e-15);
  EXPECT_LT((m.v_AB - Vector3{-0.5, 0, 0}).norm(), 1e-15);
  EXPECT_LT((m.w_AB - Vector3{0, -0.6, 0}).norm(), 1e-15);
}

TEST(Offset, LinearStopsAtItsEndAndHasItsVelocityBefore) {
  // The end is a break: seen from before the body moves, seen from after it stands.
  RigidMotion base, from;
  from.X_AB.p = {1, 0, 0};
  const Offset offset{Fade::Linear, 0, 2, from, base};
  EXPECT_EQ(offset.applied(base, 2, Side::After).v_AB, Vector3::Zero());
  EXPECT_EQ(offset.applied(base, 2, Side::Before).v_AB, (Vector3{-0.5, 0, 0}));
  EXPECT_EQ(offset.applied(base, 2, Side::Before).X_AB.p, Vector3::Zero());
}

TEST(Offset, CriticalLeavesNothingAtItsEnd) {
  // (1 + 40) exp(-40) is below 2e-16: the base takes over without a jump that a double could show.
  const Offset offset{Fade::Critical, 0, 0.25, elsewhere(), base_at(0)};
  const double end = offset.end();
  const RigidMotion last = offset.applied(base_at(end - 1e-9), end - 1e-9, Side::After);
  EXPECT_LT((last.X_AB.p - base_at(end - 1e-9).X_AB.p).norm(), 1e-14);
  EXPECT_EQ(offset.applied(base_at(end), end, Side::After).X_AB.p, base_at(end).X_AB.p);
}

TEST(Offset, CriticalBlendsTheResidualFromRest) {
  // The residual begins at the given one with zero rate and its rates are those of its values.
  SplitMotion base;
  base.S = Vector3(1, 2, 3).asDiagonal();
  Offset offset{Fade::Critical, 0, 0.5, base.X, base.X};
  offset.set_residual(Matrix3::Identity(), base.S);
  const auto at = [&](double t) { return offset.applied(base, t, Side::After); };
  EXPECT_LT((at(0).S - Matrix3::Identity()).norm(), 1e-15);
  EXPECT_LT(at(0).S1.norm(), 1e-15);
  const Matrix3 S1 = slope([&](double x) { return Matrix3{at(x).S}; }, 0.3, 1e-3);
  const Matrix3 S2 = slope([&](double x) { return Matrix3{at(x).S1}; }, 0.3, 1e-3);
  EXPECT_LT((S1 - at(0.3).S1).norm(), 1e-9);
  EXPECT_LT((S2 - at(0.3).S2).norm(), 1e-8);
}

TEST(RotationVector, IsTheShortestAndSurvivesHalfTurns) {
  // q and -q are the same rotation; angles go to pi.
  const Vector3 axis = Vector3{1, -2, 0.5}.normalized();
  for (const double angle : {0.0, 1e-9, 0.1, 1.0, 3.0, std::numbers::pi - 1e-9}) {
    const Quaternion q{Eigen::AngleAxisd{angle, axis}};
    EXPECT_LT((rotation_vector(q) - angle * axis).norm(), 1e-14);
    EXPECT_LT((rotation_vector(Quaternion{-q.coeffs()}) - angle * axis).norm(), 1e-14);
  }
  EXPECT_NEAR(rotation_vector(Quaternion{Eigen::AngleAxisd{2 * std::numbers::pi - 0.5, axis}}).norm(), 0.5,
              1e-14);
}

TEST(RotationMotion, InvertsItsRate) {
  // rotation_vector_rate gives the theta' that makes exp(theta) turn at w; both sides of the series' limits.
  for (const double size : {0.0, 1e-8, 1e-3, 0.099, 0.101, 0.99, 1.01, 2.0, 3.1}) {
    const Vector3 theta = size * Vector3{2, -1, 2}.normalized(), w{0.3, 1, -2};
    const RotationMotion m = rotation_motion(theta, rotation_vector_rate(theta, w), Vector3::Zero());
    EXPECT_LT((m.w - w).norm(), 1e-13) << size;
  }
}

}  // namespace
}  // namespace pantin
