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
    default:
      return JointKind::Fixed;
  }
}

/// Frame with its z axis along `axis`, turned as little as possible.
Quaternion with_z_along(const Vector3& axis) {
  return Quaternion::FromTwoVectors(Vector3::UnitZ(), axis).normalized();
}

/// Pose of B's joint frame in A's at this value: z is the axis.
Pose moved_by(const LinkJoint& joint) {
  Pose X;
  switch (joint.definition.kind) {
    case JointKind::Pivot:
      X.q = Quaternion{Eigen::AngleAxisd{joint.value[0], Vector3::UnitZ()}};
      break;
    case JointKind::Slider:
      X.p = {0, 0, joint.value[0] * joint.metres_per_value};
      break;
    case JointKind::Ball:
      X.q = Quaternion{joint.value[0], joint.value[1], joint.value[2], joint.value[3]}.normalized();
      break;
    default:
      break;
  }
  return X;
}

}  // namespace

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
  const Vector3 along = M_WJ.linear() * link.axis;
  if (link.kind == LinkKind::Pivot) {
    const bool mirrored = M_WJ.linear().determinant() < 0;
    X_WJ.q = with_z_along(mirrored ? Vector3{-along} : along);
  } else if (link.kind == LinkKind::Slider) {
    X_WJ.q = with_z_along(along);
    joint.metres_per_value = along.norm();
  }
  joint.definition.X_AJ = inverse(place.X_WA) * X_WJ;
  joint.definition.X_BJ = inverse(place.X_WB) * (X_WJ * moved_by(joint));
  return joint;
}

}  // namespace pantin
