// Measuring a link. With T = inverse(M_PJ) M_PN inverse(M_JN), A its linear part and t its translation:
//   pivot   the angle a that maximises trace(R(k, a)^T A) = (tr A - k^T A k) cos a + (k . w) sin a + k^T A k
//   with
//           w = (A32 - A23, A13 - A31, A21 - A12), by Rodrigues' formula: a = atan2(k . w, tr A - k^T A k)
//   slider  the distance k . t
//   ball    the rotation nearest to A; free: that and t
//   cylindrical, planar   angle and distances as of a pivot and sliders
//   screw   the angle a that maximises r cos(a - b) - (p a - d)^2 / 2, with b the pivot's angle in the turn
//   that
//           the distance d = k . t tells, r = hypot of atan2's arguments above, p the pitch: between b and d
//           / p
//   universal   in axes (m, k x m, k), k and m the axes, the product is
//           [ c1  -s1 c2   s1 s2;  s1  c1 c2  -c1 s2;  0  s2  c2 ]: given one angle the other is an atan2, in
//           turn
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/link.hpp>
#include <pantin/scenegraph/rotation.hpp>

namespace pantin {
namespace {

/// The angle of sine and cosine times something, in the turn nearest to `near`.
double angle_near(double along_sine, double along_cosine, double near) {
  const double angle = std::atan2(along_sine, along_cosine);
  const double turn = 2 * std::numbers::pi;
  return angle + turn * std::round((near - angle) / turn);
}

/// r cos b and r sin b.
struct Turning {
  double sine{0}, cosine{0};
  bool is_noise{false};  ///< below round-off of the entries
};

Turning turning(const Matrix3& A, const Vector3& axis) {
  const Vector3 w{A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)};
  Turning out{axis.dot(w), A.trace() - axis.dot(A * axis)};
  out.is_noise = std::hypot(out.sine, out.cosine) <= 1e-14 * A.cwiseAbs().maxCoeff();
  return out;
}

double fit_angle(const Matrix3& A, const Vector3& axis, double near) {
  const Turning found = turning(A, axis);
  return found.is_noise ? near : angle_near(found.sine, found.cosine, near);
}

double fit_screw(const Affine& T, const Vector3& axis, double pitch, double near) {
  // A pitch that moves a whole turn by no more than round-off says nothing about turns.
  const double distance = axis.dot(T.translation());
  if (!(std::abs(pitch) > 1e-12 * std::max(1.0, std::abs(distance))))
    return fit_angle(T.linear(), axis, near);
  const Turning found = turning(T.linear(), axis);
  const double by_distance = distance / pitch;
  if (found.is_noise) return by_distance;
  const double by_rotation = angle_near(found.sine, found.cosine, by_distance);
  const double r = std::hypot(found.sine, found.cosine);
  // The derivative changes sign between the two; Newton's steps are kept inside.
  double low = std::min(by_rotation, by_distance), high = std::max(by_rotation, by_distance), a = by_rotation;
  for (int i = 0; i < 100 && low < high; ++i) {
    const double slope = r * std::sin(a - by_rotation) + pitch * (pitch * a - distance);
    (slope > 0 ? high : low) = a;
    const double curvature = r * std::cos(a - by_rotation) + pitch * pitch;
    double next = curvature > 0 ? a - slope / curvature : low;
    if (!(next > low && next < high)) next = slope == 0 ? a : (low + high) / 2;
    if (std::abs(next - a) <= 1e-16 * std::abs(a)) break;
    a = next;
  }
  return a;
}

LinkValue fit_universal(const Matrix3& A, const Link& link, const LinkValue& near) {
  Matrix3 C;
  C << link.axis2, link.axis.cross(link.axis2), link.axis;
  const Matrix3 B = C.transpose() * A * C;
  double first = near[0], second = near[1];
  const double noise = 1e-14 * A.cwiseAbs().maxCoeff();
  if (std::hypot(B(1, 0), B(0, 0)) > noise) first = angle_near(B(1, 0), B(0, 0), near[0]);
  for (int i = 0; i < 100; ++i) {
    const double c1 = std::cos(first), s1 = std::sin(first);
    const double sine2 = B(2, 1) + s1 * B(0, 2) - c1 * B(1, 2),
                 cosine2 = B(2, 2) - s1 * B(0, 1) + c1 * B(1, 1);
    if (std::hypot(sine2, cosine2) > noise) second = angle_near(sine2, cosine2, near[1]);
    const double c2 = std::cos(second), s2 = std::sin(second);
    const double sine1 = B(1, 0) - c2 * B(0, 1) + s2 * B(0, 2),
                 cosine1 = B(0, 0) + c2 * B(1, 1) - s2 * B(1, 2);
    const double before = first;
    if (std::hypot(sine1, cosine1) > noise) first = angle_near(sine1, cosine1, near[0]);
    if (std::abs(first - before) <= 1e-15) break;
  }
  return {first, second};
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
    case LinkKind::Cylindrical:
      fit.value = {fit_angle(T.linear(), link.axis, near[0]), link.axis.dot(T.translation())};
      break;
    case LinkKind::Universal:
      fit.value = fit_universal(T.linear(), link, near);
      break;
    case LinkKind::Planar:
      fit.value = {link.axis2.dot(T.translation()), link.axis.cross(link.axis2).dot(T.translation()),
                   fit_angle(T.linear(), link.axis, near[2])};
      break;
    case LinkKind::Screw:
      fit.value = fit_screw(T, link.axis, link.pitch, near[0]);
      break;
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
