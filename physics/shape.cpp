#include <pantin/physics/shape.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <pantin/physics/convex_hull.hpp>
#include <pantin/physics/mesh_integrals.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

constexpr double kConvexity = 1e-9;  // of the extent

std::optional<SettingsProblem> geometry_problem(const SphereShape& sphere) {
  return must_be_positive({"sphere", "radius", "m"}, sphere.radius);
}

std::optional<SettingsProblem> geometry_problem(const BoxShape& box) {
  return first_problem({must_be_positive({"box", "size along x", "m"}, box.size.x()),
                        must_be_positive({"box", "size along y", "m"}, box.size.y()),
                        must_be_positive({"box", "size along z", "m"}, box.size.z())});
}

std::optional<SettingsProblem> geometry_problem(const CapsuleShape& capsule) {
  return first_problem({must_be_positive({"capsule", "radius", "m"}, capsule.radius),
                        must_not_be_negative({"capsule", "length", "m"}, capsule.length)});
}

std::optional<SettingsProblem> geometry_problem(const CylinderShape& cylinder) {
  return first_problem({must_be_positive({"cylinder", "radius", "m"}, cylinder.radius),
                        must_be_positive({"cylinder", "length", "m"}, cylinder.length)});
}

std::optional<SettingsProblem> geometry_problem(const ConeShape& cone) {
  return first_problem({must_be_positive({"cone", "radius", "m"}, cone.radius),
                        must_be_positive({"cone", "length", "m"}, cone.length)});
}

std::optional<SettingsProblem> geometry_problem(const EllipsoidShape& ellipsoid) {
  return first_problem({must_be_positive({"ellipsoid", "radius along x", "m"}, ellipsoid.radii.x()),
                        must_be_positive({"ellipsoid", "radius along y", "m"}, ellipsoid.radii.y()),
                        must_be_positive({"ellipsoid", "radius along z", "m"}, ellipsoid.radii.z())});
}

/// What makes the numbers of a mesh unusable, closed or not.
std::optional<SettingsProblem> content_problem(const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.vertices[i].allFinite()) continue;
    return SettingsProblem{
        ProblemCode::NotFinite,
        "mesh: vertex " + std::to_string(i) + " is " + text_of(mesh.vertices[i]) + "; it must be finite",
        "give finite vertices"};
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t index = *std::max_element(mesh.triangles[i].begin(), mesh.triangles[i].end());
    if (index < mesh.vertices.size()) continue;
    return SettingsProblem{ProblemCode::OutOfRange,
                           "mesh: triangle " + std::to_string(i) + " names vertex " + std::to_string(index) +
                               " of " + std::to_string(mesh.vertices.size()),
                           "count vertices from 0 and give all that triangles name"};
  }
  return std::nullopt;
}

std::optional<SettingsProblem> geometry_problem(const MeshShape& shape) {
  if (!shape.mesh || shape.mesh->triangles.empty()) {
    return SettingsProblem{ProblemCode::OutOfRange, "mesh: there are no triangles",
                           "give a mesh with triangles"};
  }
  if (std::optional<SettingsProblem> problem = must_be_finite({"mesh", "scale", ""}, shape.scale)) {
    return problem;
  }
  if ((shape.scale.array() == 0).any()) {
    return SettingsProblem{ProblemCode::OutOfRange,
                           "mesh: scale is " + text_of(shape.scale) + "; no part of it may be zero",
                           "give a scale other than zero along each axis"};
  }
  return content_problem(*shape.mesh);
}

std::optional<SettingsProblem> geometry_problem(const ConvexShape& convex) {
  if (std::optional<SettingsProblem> problem = geometry_problem(MeshShape{convex.hull, convex.scale}))
    return problem;
  if (std::optional<SettingsProblem> problem = closedness_problem(*convex.hull)) return problem;
  Eigen::AlignedBox3d box;
  for (const Vector3& vertex : convex.hull->vertices) box.extend(vertex);
  const double bulge = bulge_of(*convex.hull);
  if (bulge <= kConvexity * box.sizes().norm()) return std::nullopt;
  return SettingsProblem{ProblemCode::OutOfRange,
                         "convex: a vertex lies " + text_of(bulge) + " m outside the plane of a triangle",
                         "give the mesh as it is, as a mesh, or make its convex_hull"};
}

std::optional<SettingsProblem> geometry_problem(const CompoundShape& compound) {
  if (!compound.parts || compound.parts->empty()) {
    return SettingsProblem{ProblemCode::OutOfRange, "compound: there are no parts", "give it at least one"};
  }
  for (std::size_t i = 0; i < compound.parts->size(); ++i) {
    const Shape& part = (*compound.parts)[i];
    const std::string place = "compound: part " + std::to_string(i) + ": ";
    if (std::holds_alternative<CompoundShape>(part.geometry)) {
      return SettingsProblem{ProblemCode::OutOfRange, place + "it is a compound itself",
                             "give its parts instead"};
    }
    if (std::optional<SettingsProblem> problem = problem_with(part)) {
      problem->text = place + problem->text;
      return problem;
    }
  }
  return std::nullopt;
}

/// An edge as one of its triangles runs along it. Ends are vertices after welding, low < high.
struct HalfEdge {
  std::uint32_t low{0}, high{0};
  int sense{1};  ///< 1 from low to high, -1 back
};

/// For each vertex the first one at the same place.
std::vector<std::uint32_t> welded(const std::vector<Vector3>& vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Vector3 &p = vertices[i], &r = vertices[j];
    return p != r ? std::lexicographical_compare(p.begin(), p.end(), r.begin(), r.end()) : i < j;
  });
  std::vector<std::uint32_t> first(vertices.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && vertices[order[k]] == vertices[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

/// All half edges, those of one edge side by side. Edges without length, of triangles without area, bound
/// nothing.
std::vector<HalfEdge> half_edges(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> first = welded(mesh.vertices);
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const std::array<std::uint32_t, 3>& corner : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = first[corner[k]];
      const std::uint32_t to = first[corner[(k + 1) % 3]];
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  return edges;
}

SettingsProblem edge_problem(const TriangleMesh& mesh, const HalfEdge& edge, bool open) {
  const std::string place = "mesh: edge from vertex " + std::to_string(edge.low) + " at " +
                            text_of(mesh.vertices[edge.low]) + " to vertex " + std::to_string(edge.high) +
                            " at " + text_of(mesh.vertices[edge.high]);
  if (open) {
    return {ProblemCode::NotClosed, place + " has a triangle on one side only",
            "close the surface, or give mass and inertia instead of a density"};
  }
  return {ProblemCode::NotClosed, place + " has triangles that run along it in the same sense",
          "wind all triangles counter-clockwise seen from outside"};
}

}  // namespace

std::string_view kind_of(const ShapeGeometry& geometry) noexcept {
  constexpr std::array<std::string_view, 9> kNames{"sphere", "box",       "capsule", "cylinder", "mesh",
                                                   "cone",   "ellipsoid", "convex",  "compound"};
  static_assert(kNames.size() == std::variant_size_v<ShapeGeometry>);
  return kNames[geometry.index()];
}

std::optional<SettingsProblem> problem_with(const Shape& shape) {
  const std::string_view kind = kind_of(shape.geometry);
  return first_problem(
      {std::visit([](const auto& geometry) { return geometry_problem(geometry); }, shape.geometry),
       must_be_finite({kind, "position", "m"}, shape.X_BS.p),
       must_be_unit({kind, "orientation", ""}, shape.X_BS.q)});
}

std::optional<SettingsProblem> closedness_problem(const TriangleMesh& mesh) {
  if (std::optional<SettingsProblem> problem = content_problem(mesh)) return problem;
  // Each edge must be run along as often in one sense as in the other. Then the surface bounds a volume, also
  // where parts of it touch along an edge.
  const std::vector<HalfEdge> edges = half_edges(mesh);
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    int balance = 0;
    for (; end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high;
         ++end) {
      balance += edges[end].sense;
    }
    if (balance != 0) return edge_problem(mesh, edges[begin], (end - begin) % 2 == 1);
  }
  const MeshIntegrals integrals = integrals_of(mesh);
  if (std::abs(integrals.volume) <= integrals.volume_round_off) {
    return SettingsProblem{
        ProblemCode::NotClosed,
        "mesh: its " + std::to_string(mesh.triangles.size()) + " triangles enclose no volume",
        "give a solid, or mass and inertia instead of a density"};
  }
  if (integrals.volume < 0) {
    return SettingsProblem{
        ProblemCode::NotClosed,
        "mesh: the triangles face inward, their volume is " + text_of(integrals.volume) + " m^3",
        "swap two indices of every triangle"};
  }
  return std::nullopt;
}

}  // namespace pantin
