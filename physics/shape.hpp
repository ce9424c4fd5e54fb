#pragma once
// The solids that carry mass (and, later, collide). Each is centred on its own frame S; a Shape places it in
// a body or node.
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include <pantin/physics/pose.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct SphereShape {
  double radius{0.5};  ///< [m], > 0
};
struct BoxShape {
  Vector3 size{1, 1, 1};  ///< full edge lengths [m], each > 0
};
struct CapsuleShape {
  double radius{0.5};  ///< [m], > 0
  double length{1};    ///< between the centres of the caps, along z [m], >= 0
};
struct CylinderShape {
  double radius{0.5};  ///< [m], > 0
  double length{1};    ///< full height along z [m], > 0
};

struct ConeShape {
  double radius{0.5};  ///< of the base, at z = -length / 2 [m], > 0
  double length{1};    ///< from the base to the tip, at z = length / 2 [m], > 0
};
struct EllipsoidShape {
  Vector3 radii{0.5, 0.5, 0.5};  ///< half axes along x, y and z [m], each > 0
};

/// Triangles over shared vertices; counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vector3> vertices{};                        ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles{};  ///< indices of vertices
};
/// A surface of triangles; closed where mass is to be found from it. Immutable, so that many shapes may share
/// it.
struct MeshShape {
  std::shared_ptr<const TriangleMesh> mesh{};
  Vector3 scale{1, 1, 1};  ///< along the axes of S, not 0; a negative product mirrors
};

/// A convex solid between the triangles of its surface; convex_hull makes them of points.
struct ConvexShape {
  std::shared_ptr<const TriangleMesh> hull{};  ///< closed and convex (to 1e-9 of its extent)
  Vector3 scale{1, 1, 1};                      ///< as of a mesh
};

struct Shape;
/// Several solids as one; where they overlap, mass counts twice.
struct CompoundShape {
  std::shared_ptr<const std::vector<Shape>> parts{};  ///< at least one, none of them a compound
};

using ShapeGeometry = std::variant<SphereShape, BoxShape, CapsuleShape, CylinderShape, MeshShape, ConeShape,
                                   EllipsoidShape, ConvexShape, CompoundShape>;

/// A solid with its pose in the body or node that carries it.
struct Shape {
  ShapeGeometry geometry{SphereShape{}};
  Pose X_BS{};
};

/// Lower-case name of the kind: "sphere", "box", "capsule", "cylinder", "mesh", "cone", "ellipsoid",
/// "convex", "compound".
[[nodiscard]] std::string_view kind_of(const ShapeGeometry& geometry) noexcept;

/// Numbers that are not finite or out of range, an orientation that is not of unit length, a mesh that is
/// null or names vertices it does not have, a hull that is not convex, a compound without parts or of
/// compounds. A mesh may be open here: only mass_of and volume_of need a volume.
[[nodiscard]] std::optional<SettingsProblem> problem_with(const Shape& shape);

/// Why a mesh does not enclose a volume: an edge without or with a same-sensed neighbour, no volume beyond
/// rounding, triangles that face inward, an index out of range, a vertex that is not finite; nothing where it
/// does. Vertices at exactly the same place count as one. Solids that touch along an edge are fine.
[[nodiscard]] std::optional<SettingsProblem> closedness_problem(const TriangleMesh& mesh);

}  // namespace pantin
