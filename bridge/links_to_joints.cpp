#include <pantin/bridge/links_to_joints.hpp>

#include <Eigen/LU>
#include <algorithm>

#include <pantin/bridge/polar.hpp>

namespace pantin {
namespace {

JointKind joint_kind(LinkKind kind) {
  switch (kind) {
    case LinkKind::Pivot:
      return JointKind::Pivot;
    case LinkKind::Slider:
      return JointKind::Slider;
    case LinkKind::Ball:
      return JointKind::Ball;
    case LinkKind::Cylindrical:
      return JointKind::Cylindrical;
    case LinkKind::Universal:
      return JointKind::Universal;
    case LinkKind::Planar:
      return JointKind::Planar;
    case LinkKind::Screw:
      return JointKind::Screw;
    case LinkKind::Fixed:
    case LinkKind::Free:
      break;
  }
  return JointKind::Fixed;
}

/// Frame with its z axis along `axis`, turned as little as possible.
Quaternion with_z_along(const Vector3& axis) {
  return Quaternion::FromTwoVectors(Vector3::UnitZ(), axis).normalized();
}

/// Frame with its z axis along the first and its x axis as near to the second as may be.
Quaternion with_z_and_x_along(const Vector3& z_along, const Vector3& x_along) {
  Matrix3 R;
  R.col(2) = z_along.normalized();
  R.col(1) = R.col(2).cross(x_along).normalized();
  R.col(0) = R.col(1).cross(R.col(2));
  return Quaternion{R};
}

/// Joint frame of a link with an axis, and how far the body moves for one unit of each number. A mirror turns
/// the sense of a rotation about the image of an axis round.
void place_on_axes(const Link& link, const Affine& M_WJ, Pose& X_WJ, LinkJoint& joint) {
  const Matrix3 M = M_WJ.linear();
  const double sense = M.determinant() < 0 ? -1 : 1;
  const Vector3 along = M * link.axis, across = M * link.axis2;
  switch (link.kind) {
    case LinkKind::Slider:
      X_WJ.q = with_z_along(along);
      joint.metres_per_value[0] = along.norm();
      break;
    case LinkKind::Pivot:
      X_WJ.q = with_z_along(sense * along);
      break;
    case LinkKind::Cylindrical:
      X_WJ.q = with_z_along(sense * along);
      joint.metres_per_value[1] = sense * along.norm();
      break;
    case LinkKind::Screw:
      X_WJ.q = with_z_along(sense * along);
      joint.definition.pitch = sense * along.norm() * link.pitch;
      break;
    case LinkKind::Universal:
      X_WJ.q = with_z_and_x_along(sense * along, sense * across);
      break;
    case LinkKind::Planar: {
      const Vector3 third = M * link.axis.cross(link.axis2);
      X_WJ.q = with_z_and_x_along(across.cross(third), across);
      joint.metres_per_value[0] = across.norm();
      joint.metres_per_value[1] = third.dot(X_WJ.q * Vector3::UnitY());
      break;
    }
    default:
      break;
  }
}

/// The limits of a link as stops of its joint, number by number. A number that counts the other way round has
/// its lower limit at the upper stop.
void place_stops(const Link& link, LinkJoint& joint) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(limit_count(link.kind)); ++i) {
    const LinkLimits& limits = link.limits[i];
    if (limits == LinkLimits{}) continue;
    const double metres = joint.metres_per_value[i];
    joint.definition.axes[i].lower = std::min(metres * limits.lower, metres * limits.upper);
    joint.definition.axes[i].upper = std::max(metres * limits.lower, metres * limits.upper);
  }
}

}  // namespace

JointNumbers joint_numbers(const LinkValue& value, const std::array<double, 3>& metres_per_value) {
  JointNumbers out{value.numbers()};
  if (value.size() <= 3)
    for (int i = 0; i < value.size(); ++i) out[i] *= metres_per_value[static_cast<std::size_t>(i)];
  return out;
}

LinkValue link_value(const JointNumbers& numbers, const std::array<double, 3>& metres_per_value,
                     const LinkValue& near) {
  LinkValue out{numbers.numbers()};
  double along = 0;
  for (int i = 0; i < out.size(); ++i) along += numbers[i] * near[i];
  for (int i = 0; i < out.size(); ++i) {
    if (out.size() <= 3) out[i] /= metres_per_value[static_cast<std::size_t>(i)];
    else if (along < 0) out[i] = -out[i];  // of the two quaternions of a rotation, the nearer
  }
  return out;
}

std::optional<LinkJoint> joint_of_link(const Link& link, const LinkPlace& place) {
  const Affine M_WJ = place.M_WP * link.M_PJ;
  const Polar frame = polar(M_WJ.linear());
  if (frame.singular) return std::nullopt;
  LinkJoint joint;
  joint.definition.kind = joint_kind(link.kind);
  joint.definition.name = link.name;
  const LinkFit fit = fit_link(link, place.M_PN, link.value);
  joint.value = fit.value;
  joint.misfit = fit.residual / std::max(1.0, place.M_PN.affine().cwiseAbs().maxCoeff());

  Pose X_WJ{M_WJ.translation(), frame.q};
  if (has_axis(link.kind)) place_on_axes(link, M_WJ, X_WJ, joint);
  place_stops(link, joint);
  joint.definition.X_AJ = inverse(place.X_WA) * X_WJ;
  joint.definition.X_BJ =
      inverse(place.X_WB) *
      (X_WJ * joint_pose(joint.definition, joint_numbers(joint.value, joint.metres_per_value)));
  return joint;
}

}  // namespace pantin
