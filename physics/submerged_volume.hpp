#pragma once
// The part of a solid that lies below a plane: exact for spheres, ellipsoids, boxes, hulls and closed meshes,
// and for compounds of them.
#include <optional>
#include <vector>

#include <pantin/physics/problem.hpp>
#include <pantin/physics/shape.hpp>

namespace pantin {

/// The points x with normal . x < offset.
struct HalfSpace {
  Vector3 normal{Vector3::UnitZ()};  ///< unit, out of the half-space
  double offset{0};                  ///< [m]
};

/// A volume with its first moment, so that parts can be added.
struct VolumeMoment {
  double volume{0};                 ///< [m^3]
  Vector3 moment{Vector3::Zero()};  ///< volume times centroid [m^4]
};

/// What problem_with(shape) says, an open mesh, or a kind whose part below a plane has no closed form here
/// (capsule, cylinder, cone).
[[nodiscard]] std::optional<SettingsProblem> immersion_problem(const Shape& shape);

/// A solid prepared for being cut, in the frame of its carrier.
class Immersible {
 public:
  explicit Immersible(const Shape& shape);  ///< without an immersion_problem

  [[nodiscard]] VolumeMoment whole() const;
  [[nodiscard]] VolumeMoment below(const HalfSpace& space) const;

 private:
  /// A sphere of radius 1 at the origin, stretched.
  struct Ellipsoid {
    Vector3 radii{Vector3::Ones()};
    Pose X_BS{};
  };
  /// Triangles already in the frame of the carrier.
  struct Polyhedron {
    std::vector<Vector3> vertices{};
    std::vector<std::array<std::uint32_t, 3>> triangles{};
    Vector3 centre{Vector3::Zero()};  ///< of the vertices
    VolumeMoment whole{};
  };
  void add(const Shape& shape, const Pose& X_BC);
  [[nodiscard]] static VolumeMoment below(const Ellipsoid& solid, const HalfSpace& space);
  [[nodiscard]] static VolumeMoment below(const Polyhedron& solid, const HalfSpace& space);

  std::vector<Ellipsoid> ellipsoids_{};
  std::vector<Polyhedron> polyhedra_{};
};

}  // namespace pantin
