#include <Eigen/SVD>

#include <pantin/scenegraph/rotation.hpp>

namespace pantin {

Matrix3 rotation_matrix(const Quaternion& q) {
  Quaternion unit;
  unit.coeffs() = q.coeffs().stableNormalized();
  return unit.toRotationMatrix();
}

Quaternion nearest_rotation(const Matrix3& A) {
  const Eigen::JacobiSVD<Matrix3> svd{A, Eigen::ComputeFullU | Eigen::ComputeFullV};
  Matrix3 U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) = -U.col(2);
  const Matrix3 R = U * svd.matrixV().transpose();
  return Quaternion{R}.normalized();
}

Quaternion with_sign_of(const Quaternion& q, const Quaternion& near) {
  if (q.coeffs().dot(near.coeffs()) >= 0) return q;
  return Quaternion{-q.w(), -q.x(), -q.y(), -q.z()};
}

}  // namespace pantin
