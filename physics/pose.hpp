#pragma once
// Rigid poses and their rates: what a body can be, as opposed to the affine matrices of the scene graph.
#include <Eigen/Geometry>

namespace pantin {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;  ///< (w, x, y, z) in constructors and text

/// X_AB: pose of frame B in frame A; p_A = X_AB * p_B. Cannot hold scale.
struct Pose {
  Vector3 p{Vector3::Zero()};            ///< p_AB, origin of B in A [m]
  Quaternion q{Quaternion::Identity()};  ///< q_AB, unit

  [[nodiscard]] Matrix3 rotation() const { return q.toRotationMatrix(); }
  /// X_AC = X_AB * X_BC
  friend Pose operator*(const Pose& X_AB, const Pose& X_BC) {
    return {X_AB.p + X_AB.q * X_BC.p, (X_AB.q * X_BC.q).normalized()};
  }
  /// p_A = X_AB * p_B
  friend Vector3 operator*(const Pose& X_AB, const Vector3& p_B) { return X_AB.p + X_AB.q * p_B; }
};

/// X_BA from X_AB.
[[nodiscard]] inline Pose inverse(const Pose& X_AB) {
  const Quaternion q_BA = X_AB.q.conjugate();
  return {-(q_BA * X_AB.p), q_BA};
}

/// Pose of a frame B moving in A with its first and second time derivatives, all in axes of A, of B's origin.
struct RigidMotion {
  Pose X_AB{};
  Vector3 v_AB{Vector3::Zero()};      ///< velocity of B's origin [m/s]
  Vector3 w_AB{Vector3::Zero()};      ///< angular velocity [rad/s]
  Vector3 a_AB{Vector3::Zero()};      ///< acceleration of B's origin [m/s^2]
  Vector3 alpha_AB{Vector3::Zero()};  ///< angular acceleration [rad/s^2]
};

/// The motion of A in B from that of B in A.
[[nodiscard]] RigidMotion inverse(const RigidMotion& of_B_in_A);

/// A force and the torque about a stated point, in W.
struct Wrench {
  Vector3 force{Vector3::Zero()};   ///< [N]
  Vector3 torque{Vector3::Zero()};  ///< [N m]
};

}  // namespace pantin
