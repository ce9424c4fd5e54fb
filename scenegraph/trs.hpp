#pragma once
// Private to scenegraph. A local matrix as translation, rotation and scale.
#include <optional>

#include <pantin/scenegraph/affine.hpp>

namespace pantin {

/// M = translation * rotation * diag(scale).
struct Trs {
  Vector3 translation{Vector3::Zero()};
  Quaternion rotation{Quaternion::Identity()};
  Vector3 scale{Vector3::Ones()};
};

/// The lengths of the columns are the scale; a mirror (negative determinant) makes the x scale negative.
/// Nothing if the matrix is sheared, that is if two columns' directions have a dot product above 1e-6, which
/// leaves room for matrices from files in single precision. Directions of columns that are 0 are chosen.
[[nodiscard]] std::optional<Trs> decompose(const Affine& M);

}  // namespace pantin
