#pragma once
// Private to bridge. Velocity and acceleration under scale and shear: what a rigid body does that is fixed in
// a node whose affine matrix moves.
#include <pantin/physics/pose.hpp>
#include <pantin/scenegraph/player.hpp>

namespace pantin {

/// The motion of a node that does not move.
[[nodiscard]] LocalMotion constant_motion(const Affine& M);

/// M_AC(t) = M_AB(t) * M_BC(t) with first and second time derivatives.
[[nodiscard]] LocalMotion operator*(const LocalMotion& M_AB, const LocalMotion& M_BC);

/// An affine motion split into the rigid motion of a body frame and the residual: M(t) = X(t) * S(t), by
/// polar decomposition at each time; the body origin is the node's.
struct SplitMotion {
  RigidMotion X{};
  Matrix3 S{Matrix3::Identity()};
  Matrix3 S1{Matrix3::Zero()};  ///< dS/dt [1/s]; zero while the node moves rigidly
  Matrix3 S2{Matrix3::Zero()};  ///< [1/s^2]
  bool singular{false};         ///< M has no polar rotation: the motion of the origin alone is right
};
[[nodiscard]] SplitMotion split(const LocalMotion& M);

/// The affine motion that `split` splits.
[[nodiscard]] LocalMotion joined(const SplitMotion& split);

/// The motion of frame B seen from a moving frame A, in axes of A; both given in W.
[[nodiscard]] RigidMotion relative_motion(const RigidMotion& X_WA, const RigidMotion& X_WB);

/// X_WC from X_WB and X_BC.
[[nodiscard]] RigidMotion composed(const RigidMotion& X_WB, const RigidMotion& X_BC);

/// w with cross(w) x = w x x.
[[nodiscard]] Matrix3 cross_matrix(const Vector3& w);

}  // namespace pantin
