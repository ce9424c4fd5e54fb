// Unit sphere below z = d: a cap of height t = 1 + d has volume pi t^2 (3 - t) / 3 and its centroid at z = -3
// (2
// - t)^2 / (4 (3 - t)). An ellipsoid is the sphere under a linear map, which turns a half-space into another.
//
// Polyhedron: its triangles cut by the plane, joined to a point o of the plane. The tetrahedra over the cut
// triangles add up with their signs to the part below, since those over the face in the plane are flat.
#include <pantin/physics/submerged_volume.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <pantin/physics/box_mesh.hpp>

namespace pantin {
namespace {

void operator+=(VolumeMoment& sum, const VolumeMoment& part) {
  sum.volume += part.volume;
  sum.moment += part.moment;
}

/// The tetrahedron (0, a, b, c), signed.
VolumeMoment tetrahedron(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double volume = a.dot(b.cross(c)) / 6;
  return {volume, volume / 4 * (a + b + c)};
}

/// Moved by p.
VolumeMoment moved(const VolumeMoment& part, const Vector3& p) {
  return {part.volume, part.moment + part.volume * p};
}

/// Where the edge from below (height h < 0) to above (g >= 0) meets the plane.
Vector3 crossing(const Vector3& below, double h, const Vector3& above, double g) {
  return below + h / (h - g) * (above - below);
}

/// The tetrahedra from 0 over the part of a triangle below the plane; heights over it.
VolumeMoment cut(const std::array<Vector3, 3>& p, const std::array<double, 3>& height) {
  std::array<std::size_t, 3> order{0, 1, 2};  // turned so that the odd one out stands first
  const int count = (height[0] < 0) + (height[1] < 0) + (height[2] < 0);
  if (count == 0) return {};
  if (count == 3) return tetrahedron(p[0], p[1], p[2]);
  const bool odd_is_below = count == 1;
  while ((height[order[0]] < 0) != odd_is_below) order = {order[1], order[2], order[0]};
  const auto [i, j, k] = order;
  if (odd_is_below) {
    return tetrahedron(p[i], crossing(p[i], height[i], p[j], height[j]),
                       crossing(p[i], height[i], p[k], height[k]));
  }
  const Vector3 on_j = crossing(p[j], height[j], p[i], height[i]);
  const Vector3 on_k = crossing(p[k], height[k], p[i], height[i]);
  VolumeMoment sum = tetrahedron(on_j, p[j], p[k]);
  sum += tetrahedron(on_j, p[k], on_k);
  return sum;
}

std::optional<SettingsProblem> part_problem(const Shape& shape) {
  if (auto problem = problem_with(shape)) return problem;
  const std::string kind{kind_of(shape.geometry)};
  if (kind == "capsule" || kind == "cylinder" || kind == "cone") {
    return SettingsProblem{ProblemCode::OutOfRange, kind + ": the part of it below a plane is not computed",
                           "give a sphere, ellipsoid, box, convex hull or closed mesh instead"};
  }
  if (const auto* mesh = std::get_if<MeshShape>(&shape.geometry)) return closedness_problem(*mesh->mesh);
  return std::nullopt;
}

}  // namespace

std::optional<SettingsProblem> immersion_problem(const Shape& shape) {
  if (auto problem = part_problem(shape)) return problem;
  if (const auto* compound = std::get_if<CompoundShape>(&shape.geometry)) {
    for (const Shape& part : *compound->parts) {
      if (auto problem = part_problem(part)) return problem;
    }
  }
  return std::nullopt;
}

Immersible::Immersible(const Shape& shape) {
  if (const auto* compound = std::get_if<CompoundShape>(&shape.geometry)) {
    for (const Shape& part : *compound->parts) add(part, shape.X_BS);
  } else {
    add(shape, {});
  }
}

void Immersible::add(const Shape& shape, const Pose& X_BC) {
  const Pose X_BS = X_BC * shape.X_BS;
  const auto add_mesh = [&](const TriangleMesh& mesh, const Vector3& scale) {
    Polyhedron solid{.triangles = mesh.triangles};
    for (const Vector3& p : mesh.vertices) {
      solid.vertices.push_back(X_BS * p.cwiseProduct(scale));
      solid.centre += solid.vertices.back() / static_cast<double>(mesh.vertices.size());
    }
    if (scale.prod() < 0) {
      for (auto& triangle : solid.triangles) std::swap(triangle[1], triangle[2]);
    }
    const Vector3 centre = solid.centre;
    for (const auto& [a, b, c] : solid.triangles) {
      solid.whole +=
          tetrahedron(solid.vertices[a] - centre, solid.vertices[b] - centre, solid.vertices[c] - centre);
    }
    solid.whole = moved(solid.whole, centre);
    polyhedra_.push_back(std::move(solid));
  };
  if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry)) {
    ellipsoids_.push_back({Vector3::Constant(sphere->radius), X_BS});
  } else if (const auto* ellipsoid = std::get_if<EllipsoidShape>(&shape.geometry)) {
    ellipsoids_.push_back({ellipsoid->radii, X_BS});
  } else if (const auto* box = std::get_if<BoxShape>(&shape.geometry)) {
    add_mesh(surface_of(*box), Vector3::Ones());
  } else if (const auto* mesh = std::get_if<MeshShape>(&shape.geometry)) {
    add_mesh(*mesh->mesh, mesh->scale);
  } else if (const auto* convex = std::get_if<ConvexShape>(&shape.geometry)) {
    add_mesh(*convex->hull, convex->scale);
  }
}

VolumeMoment Immersible::whole() const {
  return below({Vector3::UnitZ(), std::numeric_limits<double>::infinity()});
}

VolumeMoment Immersible::below(const HalfSpace& space) const {
  VolumeMoment sum;
  for (const Ellipsoid& solid : ellipsoids_) sum += below(solid, space);
  for (const Polyhedron& solid : polyhedra_) sum += below(solid, space);
  return sum;
}

VolumeMoment Immersible::below(const Ellipsoid& solid, const HalfSpace& space) {
  const Vector3 normal_S = solid.X_BS.q.conjugate() * space.normal;
  const Vector3 stretched = normal_S.cwiseProduct(solid.radii);
  const double length = stretched.norm();
  const double t = std::clamp(1 + (space.offset - space.normal.dot(solid.X_BS.p)) / length, 0.0, 2.0);
  if (t == 0) return {};
  const double volume = std::numbers::pi * t * t * (3 - t) / 3 * solid.radii.prod();
  const Vector3 centroid_S =
      (-0.75 * (2 - t) * (2 - t) / (3 - t) / length) * stretched.cwiseProduct(solid.radii);
  return {volume, volume * (solid.X_BS * centroid_S)};
}

VolumeMoment Immersible::below(const Polyhedron& solid, const HalfSpace& space) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Vector3& p : solid.vertices) {
    const double height = space.normal.dot(p) - space.offset;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (highest <= 0) return solid.whole;
  if (lowest >= 0) return {};
  const Vector3 o = solid.centre - (space.normal.dot(solid.centre) - space.offset) * space.normal;
  VolumeMoment sum;
  for (const auto& triangle : solid.triangles) {
    std::array<Vector3, 3> p;
    std::array<double, 3> height{};
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = solid.vertices[triangle[k]] - o;
      height[k] = space.normal.dot(p[k]);  // over the plane, which passes through o
    }
    sum += cut(p, height);
  }
  return moved(sum, o);
}

}  // namespace pantin
