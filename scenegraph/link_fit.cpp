// Measuring a link. With T = inverse(M_PJ) M_PN inverse(M_JN), A its linear part and t its translation:
//   pivot   the angle a that maximises trace(R(k, a)^T A) = (tr A - k^T A k) cos a + (k . w) sin a + k^T A k
//   with
//           w = (A32 - A23, A13 - A31, A21 - A12), by Rodrigues' formula: a = atan2(k . w, tr A - k^T A k)
//   slider  the distance k . t
//   ball    the rotation nearest to A; free: that and t
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/link.hpp>
#include <pantin/scenegraph/rotation.hpp>

namespace pantin {
namespace {

double fit_angle(const Matrix3& A, const Vector3& axis, double near) {
  const Vector3 w{A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)};
  const double along_sine = axis.dot(w);
  const double along_cosine = A.trace() - axis.dot(A * axis);
  // Below round-off of the entries the angle would be noise.
  if (std::hypot(along_sine, along_cosine) <= 1e-14 * A.cwiseAbs().maxCoeff()) return near;
  const double angle = std::atan2(along_sine, along_cosine);
  const double turn = 2 * std::numbers::pi;
  return angle + turn * std::round((near - angle) / turn);
}

Quaternion fit_rotation(const Matrix3& A, const LinkValue& near, int first) {
  const Quaternion q_near{near[first], near[first + 1], near[first + 2], near[first + 3]};
  return with_sign_of(nearest_rotation(A), q_near);
}

}  // namespace

LinkFit fit_link(const Link& link, const Affine& M_PN, const LinkValue& near) {
  const std::string problem = problem_with(link.kind, near);
  PANTIN_EXPECTS(problem.empty(), "the value to be near to: " + problem);
  const Affine T = link.M_PJ.inverse() * M_PN * link.M_JN.inverse();
  LinkFit fit;
  switch (link.kind) {
    case LinkKind::Fixed:
      break;
    case LinkKind::Pivot:
      fit.value = fit_angle(T.linear(), link.axis, near[0]);
      break;
    case LinkKind::Slider:
      fit.value = link.axis.dot(T.translation());
      break;
    case LinkKind::Ball: {
      const Quaternion q = fit_rotation(T.linear(), near, 0);
      fit.value = {q.w(), q.x(), q.y(), q.z()};
      break;
    }
    case LinkKind::Free: {
      const Quaternion q = fit_rotation(T.linear(), near, 3);
      fit.value = {T.translation().x(), T.translation().y(), T.translation().z(), q.w(), q.x(), q.y(), q.z()};
      break;
    }
  }
  fit.residual = (M_PN.affine() - local_matrix(link, fit.value).affine()).cwiseAbs().maxCoeff();
  return fit;
}

}  // namespace pantin
