#pragma once
// Private to scenegraph. Rotation matrices of quaternions, and the rotation nearest to a matrix.
#include <pantin/scenegraph/affine.hpp>

namespace pantin {

/// Of the normalised quaternion; its length must not be 0.
[[nodiscard]] Matrix3 rotation_matrix(const Quaternion& q);

/// The rotation (determinant +1) that minimises the sum of squared differences to the entries of A: U diag(1,
/// 1, d) V^T from the singular value decomposition A = U S V^T, d = det(U V^T) (Kabsch 1976; for det A > 0
/// the polar factor).
[[nodiscard]] Quaternion nearest_rotation(const Matrix3& A);

/// The given quaternion or its negative, whichever is nearer to `near`: both are the same rotation.
[[nodiscard]] Quaternion with_sign_of(const Quaternion& q, const Quaternion& near);

}  // namespace pantin
