#pragma once
// The triangles of a mesh in a bounding-volume hierarchy of FCL. Component collision_fcl
// (PANTIN_COLLISION_FCL).
#include <memory>

#include <pantin/physics/collision/triangle_index.hpp>

namespace pantin {

/// Builds the hierarchy over a mesh with its scale applied. Settings with a problem (a null mesh, a vertex
/// that is not finite) break the contract.
[[nodiscard]] std::shared_ptr<const TriangleIndex> make_fcl_triangle_index(const MeshShape& shape);

}  // namespace pantin
