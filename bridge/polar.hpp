#pragma once
// Private to bridge. An affine matrix as a rotation and what a rigid body cannot be.
#include <optional>

#include <pantin/scenegraph/affine.hpp>

namespace pantin {

/// M = R(q) * S, R the polar rotation with determinant +1. S is symmetric to round-off: positive definite, or
/// negative definite where M mirrors. S is computed with the rotation that q gives, so R(q) * S is M again.
struct Polar {
  Quaternion q{Quaternion::Identity()};
  Matrix3 S{Matrix3::Identity()};
  bool singular{false};  ///< no rotation is nearest, or only to round-off; q is then one of several
};

/// The residual M_BN of a node whose body has the rotation q and the node's origin.
[[nodiscard]] Affine residual_of(const Polar& polar);

/// By Newton's iteration X <- (g X + X^-T / g) / 2 with Higham's scaling g (Higham, Computing the polar
/// decomposition, 1986, (3.1) and (4.1)); by singular values where that is not safe. Not finite counts as
/// singular, with identity for q.
[[nodiscard]] Polar polar(const Matrix3& M);

/// M_PN with M_WP * M_PN = M_WN; nothing where M_WP is singular or not finite. Columns of M_WP are brought to
/// length 1 first, so that very different scales along the axes cost no accuracy.
[[nodiscard]] std::optional<Affine> solve_local(const Affine& M_WP, const Affine& M_WN);

}  // namespace pantin
