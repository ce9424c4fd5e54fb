#pragma once
// Turns the nodes of a document's scene into nodes of a Model: names, matrices and, where the file says so,
// mass.
#include <pantin/bridge/model.hpp>

#include "gltf_hierarchy.hpp"

namespace pantin::gltf {

/// How the file gives a node's local matrix M_PN = T R S.
struct NodeTransform {
  bool by_matrix{false};  ///< M_PN as it is; no translation, rotation, scale
  Affine M_PN{Affine::Identity()};
  Quaternion rotation{Quaternion::Identity()};  ///< unit
  Vector3 scale{1, 1, 1};
};

struct SceneNodes {
  Hierarchy hierarchy{};
  std::vector<NodeTransform> transforms{};  ///< of each node of the document
};

/// Fills Model::nodes without their meshes.
[[nodiscard]] SceneNodes read_nodes(const Document& document, Model& model);

/// A quaternion given as x, y, z, w, made unit. Refused if it is zero; a warning where its length is off by
/// more than `tolerance`.
[[nodiscard]] Quaternion unit_quaternion(Report& report, const JsonValue& at,
                                         const std::array<double, 4>& xyzw, double tolerance);

/// Lengths of quaternions that were rounded to float when written stay this near to 1.
constexpr double kUnitTolerance = 1e-3;

}  // namespace pantin::gltf
