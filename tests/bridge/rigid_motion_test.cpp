#include <pantin/bridge/rigid_motion.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "support/slope.hpp"

namespace pantin {
namespace {

using test::slope;

/// A smooth affine curve: a sum of sines per entry around a well-conditioned matrix, with exact derivatives.
class Curve {
 public:
  explicit Curve(std::uint64_t seed, double sign = 1) {
    std::mt19937_64 rng{seed};
    std::uniform_real_distribution<double> u{-1, 1};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 4; ++c) {
        amplitude_(r, c) = 0.25 * u(rng);
        phase_(r, c) = 3 * u(rng);
        speed_(r, c) = 1 + u(rng);
        base_(r, c) = (r == c ? 1.5 * sign : 0) + 0.1 * u(rng);
      }
    }
  }
  [[nodiscard]] LocalMotion at(double t) const {
    LocalMotion M;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 4; ++c) {
        const double a = amplitude_(r, c), w = speed_(r, c), x = w * t + phase_(r, c);
        M.value(r, c) = base_(r, c) + a * std::sin(x);
        M.first(r, c) = a * w * std::cos(x);
        M.second(r, c) = -a * w * w * std::sin(x);
      }
    }
    return M;
  }

 private:
  Eigen::Matrix<double, 3, 4> base_, amplitude_, phase_, speed_;
};

Matrix3 rotation(const SplitMotion& m) { return m.X.X_AB.rotation(); }

class SplitOfCurve : public ::testing::TestWithParam<double> {};

TEST_P(SplitOfCurve, HasTheDerivativesOfThePolarFactors) {
  // Oracle: fourth-order differences of the polar factors at nearby times, h = 1e-3: truncation ~1e-12 and
  // rounding ~1e-13 for first, the same for second derivatives as differences of the exact first ones.
  const double h = 1e-3;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Curve curve{seed, GetParam()};
    const auto at = [&](double t) { return split(curve.at(t)); };
    const double t = 0.3 * static_cast<double>(seed);
    const SplitMotion m = at(t);
    const Matrix3 R1 = slope([&](double x) { return Matrix3{rotation(at(x))}; }, t, h);
    EXPECT_LT((R1 - cross_matrix(m.X.w_AB) * rotation(m)).norm(), 1e-9);
    const Vector3 alpha = slope([&](double x) { return Vector3{at(x).X.w_AB}; }, t, h);
    EXPECT_LT((alpha - m.X.alpha_AB).norm(), 1e-8);
    const Matrix3 S1 = slope([&](double x) { return Matrix3{at(x).S}; }, t, h);
    EXPECT_LT((S1 - m.S1).norm(), 1e-9);
    const Matrix3 S2 = slope([&](double x) { return Matrix3{at(x).S1}; }, t, h);
    EXPECT_LT((S2 - m.S2).norm(), 1e-8);
    EXPECT_EQ(m.X.v_AB, Vector3{curve.at(t).first.col(3)});
    EXPECT_EQ(m.X.a_AB, Vector3{curve.at(t).second.col(3)});
  }
}
INSTANTIATE_TEST_SUITE_P(PlainAndMirrored, SplitOfCurve, ::testing::Values(1.0, -1.0));

TEST(Split, OfARigidMotionHasAConstantResidual) {
  // M = X(t) S0 with S0 constant moves as X does, whatever S0 is, and its residual rate is zero.
  SplitMotion rigid;
  rigid.X = {{{1, 2, 3}, Quaternion{0.5, 0.5, -0.5, 0.5}}, {1, 0, 2}, {0.3, -2, 1}, {4, 5, 6}, {-1, 0.5, 2}};
  rigid.S << 2, 0.5, 0.1, 0.5, 1, -0.2, 0.1, -0.2, 0.7;
  for (const double sign : {1.0, -1.0}) {
    SplitMotion in = rigid;
    in.S *= sign;
    const SplitMotion out = split(joined(in));
    EXPECT_LT((out.X.w_AB - in.X.w_AB).norm(), 1e-13);
    EXPECT_LT((out.X.alpha_AB - in.X.alpha_AB).norm(), 1e-12);
    EXPECT_LT(out.S1.norm() + out.S2.norm(), 1e-12);
    EXPECT_LT((out.S - in.S).norm(), 1e-14);
  }
}

TEST(Split, OfASingularMatrixIsFinite) {
  // Nothing that physics is given may be NaN, also where a clip scales a node to nothing.
  LocalMotion M;
  M.value.setZero();
  M.first.setOnes();
  const SplitMotion out = split(M);
  EXPECT_TRUE(out.singular);
  EXPECT_TRUE(out.X.w_AB.allFinite() && out.X.alpha_AB.allFinite() && out.X.X_AB.q.coeffs().allFinite());
}

TEST(LocalMotionProduct, FollowsTheProductRule) {
  // Oracle: differences of the product of values, as above.
  const Curve a{1}, b{2};
  const double h = 1e-3, t = 0.7;
  const LocalMotion m = a.at(t) * b.at(t);
  using M34 = Eigen::Matrix<double, 3, 4>;
  const M34 first = slope([&](double x) { return M34{(a.at(x) * b.at(x)).value}; }, t, h);
  const M34 second = slope([&](double x) { return M34{(a.at(x) * b.at(x)).first}; }, t, h);
  EXPECT_LT((first - m.first).norm(), 1e-10);
  EXPECT_LT((second - m.second).norm(), 1e-10);
}

TEST(RelativeMotion, IsUndoneByComposition) {
  // X_WA composed with the motion of B in A is the motion of B again, in every derivative.
  const Curve a{5}, b{6};
  for (double t = 0; t < 3; t += 0.1) {
    const RigidMotion A = split(a.at(t)).X, B = split(b.at(t)).X;
    const RigidMotion back = composed(A, relative_motion(A, B));
    EXPECT_LT((back.X_AB.p - B.X_AB.p).norm(), 1e-14);
    EXPECT_LT(back.X_AB.q.angularDistance(B.X_AB.q), 1e-14);
    EXPECT_LT((back.v_AB - B.v_AB).norm() + (back.w_AB - B.w_AB).norm(), 1e-13);
    EXPECT_LT((back.a_AB - B.a_AB).norm() + (back.alpha_AB - B.alpha_AB).norm(), 1e-12);
  }
}

TEST(RelativeMotion, IsTheDerivativeOfTheRelativePose) {
  // Oracle: differences of inverse(X_WA) X_WB over time; composition alone could hide two errors that cancel.
  const Curve a{7}, b{8};
  const double t = 0.4, h = 1e-3;
  const auto at = [&](double x) { return relative_motion(split(a.at(x)).X, split(b.at(x)).X); };
  const RigidMotion m = at(t);
  const Vector3 v = slope([&](double x) { return Vector3{at(x).X_AB.p}; }, t, h);
  const Vector3 acceleration = slope([&](double x) { return Vector3{at(x).v_AB}; }, t, h);
  const Matrix3 R1 = slope([&](double x) { return Matrix3{at(x).X_AB.rotation()}; }, t, h);
  const Vector3 alpha = slope([&](double x) { return Vector3{at(x).w_AB}; }, t, h);
  EXPECT_LT((v - m.v_AB).norm(), 1e-9);
  EXPECT_LT((acceleration - m.a_AB).norm(), 1e-8);
  EXPECT_LT((R1 - cross_matrix(m.w_AB) * m.X_AB.rotation()).norm(), 1e-9);
  EXPECT_LT((alpha - m.alpha_AB).norm(), 1e-8);
}

}  // namespace
}  // namespace pantin
