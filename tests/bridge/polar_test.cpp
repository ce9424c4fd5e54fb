#include <pantin/bridge/polar.hpp>

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <random>

namespace pantin {
namespace {

Matrix3 random_rotation(std::mt19937_64& rng) {
  std::normal_distribution<double> n;
  return Quaternion{n(rng), n(rng), n(rng), n(rng)}.normalized().toRotationMatrix();
}

TEST(Polar, GivesBackTheMatrixWithASymmetricResidual) {
  // R S = M with S symmetric of one sign defines the polar decomposition (Higham 1986, theorem 1.1); the
  // factor built into M by construction is the oracle. Conditions go to 1e4, S to round-off times that.
  std::mt19937_64 rng{1};
  std::uniform_real_distribution<double> scale{-4, 0};
  for (int i = 0; i < 2000; ++i) {
    const Matrix3 R = random_rotation(rng), V = random_rotation(rng);
    const double sign = i % 2 == 0 ? 1 : -1;
    const Vector3 s{1, std::pow(10, scale(rng)), std::pow(10, scale(rng))};
    const Matrix3 S = sign * (V * s.asDiagonal() * V.transpose());
    const Polar got = polar(R * S);
    ASSERT_FALSE(got.singular);
    EXPECT_LT((got.q.toRotationMatrix() * got.S - R * S).norm(), 1e-15 * 4);
    EXPECT_LT((got.q.toRotationMatrix() - R).norm(), 1e-11) << s.transpose();
    EXPECT_LT((got.S - got.S.transpose()).norm(), 1e-11);
    EXPECT_GT(sign * got.S.trace(), 0);
  }
}

TEST(Polar, LeavesARotationAsItIs) {
  // A rotation is its own polar factor, so the residual is the identity.
  std::mt19937_64 rng{2};
  for (int i = 0; i < 100; ++i) {
    const Polar got = polar(random_rotation(rng));
    EXPECT_LT((got.S - Matrix3::Identity()).norm(), 2e-15);
  }
}

TEST(Polar, TellsSingularMatricesFromFlatOnes) {
  // A scale of 1e-9 along one axis still has one nearest rotation; a scale of 0, two of them, NaN or infinity
  // do not.
  EXPECT_FALSE(polar(Vector3(1, 1, 1e-9).asDiagonal()).singular);
  EXPECT_TRUE(polar(Vector3(1, 1, 0).asDiagonal()).singular);
  EXPECT_TRUE(polar(Matrix3::Zero()).singular);
  EXPECT_TRUE(polar(Matrix3::Constant(std::nan(""))).singular);
  EXPECT_TRUE(polar(Vector3(1, 1, INFINITY).asDiagonal()).singular);
  EXPECT_TRUE(polar(Matrix3::Ones()).singular);
}

TEST(Polar, DoesNotDependOnSize) {
  // polar(c M) has the rotation of polar(M) for every c > 0: no threshold may be absolute.
  std::mt19937_64 rng{3};
  const Matrix3 M = random_rotation(rng) * Matrix3{{2, 0.3, 0}, {0.3, 1, 0.1}, {0, 0.1, 0.5}};
  for (const double size : {1e-30, 1e-6, 1e6, 1e30}) {
    const Polar got = polar(size * M);
    EXPECT_FALSE(got.singular);
    EXPECT_LT((got.q.toRotationMatrix() - polar(M).q.toRotationMatrix()).norm(), 1e-14);
  }
}

TEST(SolveLocal, InvertsTheProductUnderVeryDifferentScales) {
  // M_WP * M_PN is built from a known M_PN, which must come back; columns scaled by 1e-6 and 1e6 lose
  // nothing.
  Affine M_WP = Affine::Identity(), M_PN = Affine::Identity();
  std::mt19937_64 rng{4};
  M_WP.linear() = random_rotation(rng) * Vector3(1e-6, 1, 1e6).asDiagonal();
  M_WP.translation() = Vector3{1, 2, 3};
  M_PN.linear() = random_rotation(rng);
  M_PN.translation() = Vector3{0.1, 0.2, 0.3};
  const std::optional<Affine> got = solve_local(M_WP, M_WP * M_PN);
  ASSERT_TRUE(got.has_value());
  // Entries of M_WP * M_PN round relative to 1e6, so the smallest axis comes back to 1e6 / 1e-6 times
  // round-off only if the solve were not by columns; by columns each row keeps its own accuracy within the
  // cancellation in the sum.
  EXPECT_LT((got->linear().row(2) - M_PN.linear().row(2)).norm(), 1e-14);
  EXPECT_LT((got->linear().row(1) - M_PN.linear().row(1)).norm(), 1e-9);
}

TEST(SolveLocal, GivesNothingUnderASingularParent) {
  // No local matrix leads from a flat parent to a solid child.
  Affine flat = Affine::Identity();
  flat.linear() = Vector3(1, 0, 1).asDiagonal();
  EXPECT_FALSE(solve_local(flat, Affine::Identity()).has_value());
  flat.linear().setConstant(std::nan(""));
  EXPECT_FALSE(solve_local(flat, Affine::Identity()).has_value());
}

}  // namespace
}  // namespace pantin
