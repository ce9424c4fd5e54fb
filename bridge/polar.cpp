#include <pantin/bridge/polar.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

namespace pantin {
namespace {

constexpr double kSingular = 1e-12;      // smallest singular value over the largest
constexpr double kSafeForNewton = 1e-5;  // the same; below it, round-off of the inverse shows
constexpr int kMostIterations = 20;      // five to eight are usual

/// The orthogonal polar factor, determinant of either sign; false if the iteration does not settle.
bool newton(const Matrix3& M, Matrix3& U) {
  U = M;
  bool near = false;
  for (int i = 0; i < kMostIterations; ++i) {
    const Matrix3 inverse = U.inverse();
    if (!inverse.allFinite()) return false;
    const double g = near ? 1.0 : std::sqrt(inverse.norm() / U.norm());
    const Matrix3 next = 0.5 * (g * U + inverse.transpose() / g);
    const double change = (next - U).norm();
    U = next;
    if (near && change < 1e-7) return true;  // quadratic: what is left is below round-off
    near = near || change < 1e-2;
  }
  return false;
}

/// Smallest over largest singular value, estimated from norms (within a factor of 3).
double conditioning(const Matrix3& M) {
  const Matrix3 inverse = M.inverse();
  const double product = M.norm() * inverse.norm();
  return std::isfinite(product) && product > 0 ? 1 / product : 0;
}

Polar with_rotation(const Matrix3& M, const Matrix3& R) {
  Polar polar;
  polar.q = Quaternion{R}.normalized();
  polar.S = polar.q.toRotationMatrix().transpose() * M;
  return polar;
}

}  // namespace

Polar polar(const Matrix3& M) {
  if (!M.allFinite()) return {.singular = true};
  const double size = M.cwiseAbs().maxCoeff();
  if (size == 0) return {.S = M, .singular = true};
  const Matrix3 unit = M / size;
  Matrix3 U;
  if (conditioning(unit) > kSafeForNewton && newton(unit, U)) {
    return with_rotation(M, U.determinant() < 0 ? Matrix3{-U} : U);
  }
  const Eigen::JacobiSVD<Matrix3> svd{unit, Eigen::ComputeFullU | Eigen::ComputeFullV};
  U = svd.matrixU() * svd.matrixV().transpose();
  if (U.determinant() < 0) U = -U;
  Polar result = with_rotation(M, U);
  result.singular = !(svd.singularValues()[2] > kSingular * svd.singularValues()[0]);
  return result;
}

Affine residual_of(const Polar& polar) {
  Affine M_BN = Affine::Identity();
  M_BN.linear() = polar.S;
  return M_BN;
}

std::optional<Affine> solve_local(const Affine& M_WP, const Affine& M_WN) {
  const Vector3 lengths = M_WP.linear().colwise().stableNorm();
  if (!M_WP.matrix().allFinite() || !(lengths.minCoeff() > 0)) return std::nullopt;
  const Matrix3 directions = M_WP.linear() * lengths.cwiseInverse().asDiagonal();
  if (!(std::abs(directions.determinant()) > kSingular)) return std::nullopt;
  const Matrix3 inverse = lengths.cwiseInverse().asDiagonal() * directions.inverse();
  Affine M_PN = Affine::Identity();
  M_PN.linear() = inverse * M_WN.linear();
  M_PN.translation() = inverse * (M_WN.translation() - M_WP.translation());
  if (!M_PN.affine().allFinite()) return std::nullopt;
  return M_PN;
}

}  // namespace pantin
