#pragma once
// Triangles out of assimp's meshes.
#include <cstddef>
#include <optional>
#include <string>

#include <pantin/bridge/model.hpp>

struct aiMesh;
struct aiNode;

namespace pantin::assimp_loader {

/// The matrix of a node in metres: its linear part as it is, its translation times `unit_m`.
[[nodiscard]] Affine matrix_of(const aiNode& node, double unit_m);

/// Text of a name; names are given as UTF-8.
[[nodiscard]] std::string name_of(const aiNode& node);
[[nodiscard]] std::string name_of(const aiMesh& mesh);

/// Adds the triangles of `mesh`, mapped by `M` after `unit_m`, to `out`; a mirroring M turns their winding.
/// Points and lines are left out and counted in `others`. Nothing is added and the reason returned where an
/// index is out of range or a coordinate not finite.
[[nodiscard]] std::optional<std::string> append_triangles(const aiMesh& mesh, const Affine& M, double unit_m,
                                                          TriangleMesh& out, std::size_t& others);

}  // namespace pantin::assimp_loader
