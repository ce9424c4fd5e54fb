#pragma once
// Ties between particles of one system, for ropes and cloth. A system with ties or pins is advanced in
// substeps by a method of its own, whatever integrator is chosen (tied_particles.hpp): second order, momentum
// and angular momentum kept, energy kept or lowered, lengths without compliance held to 1e-10.
#include <optional>

#include <pantin/physics/bodies_at.hpp>
#include <pantin/physics/ids.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

/// Two particles at a distance, as joined by a massless rod, or by a spring where it has compliance.
struct DistanceTie {
  ParticleId a{}, b{};
  double length{-1};       ///< [m], >= 0; below zero = as they stand
  double compliance{0};    ///< 1 / stiffness [m/N], >= 0; 0 = rigid
  double damping_time{0};  ///< viscosity over stiffness [s], >= 0; without effect where rigid
};

/// Three particles in a row that resist bending, straight at rest: energy B k^2 (l1 + l2) / 4 with k the
/// curvature vector at b and l1, l2 the lengths as they stand. M. Bergou et al., Discrete Elastic Rods, 2008,
/// sec. 4.2, for small angles.
struct BendTie {
  ParticleId a{}, b{}, c{};
  double stiffness{0};     ///< B = E I [N m^2], > 0
  double damping_time{0};  ///< [s], >= 0
};

/// Two triangles a, b, c and b, a, d at an edge a-b that resist bending, flat at rest: energy (stiffness / 2)
/// |e|^2 angle^2 / (A0 + A1) for small angles, by the quadratic form of M. Bergou et al., A Quadratic Bending
/// Model for Inextensible Surfaces, 2006, over the shape as it stands. A sheet bent about edges of one
/// direction holds what a plate of this stiffness does; bent in other directions more, by the mesh. Where
/// that matters, tie rows by BendTie.
struct HingeTie {
  ParticleId a{}, b{};     ///< the edge
  ParticleId c{}, d{};     ///< the corners opposite of it
  double stiffness{0};     ///< of the sheet [N m], > 0
  double damping_time{0};  ///< [s], >= 0
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const DistanceTie& settings);
[[nodiscard]] std::optional<SettingsProblem> problem_with(const BendTie& settings);
[[nodiscard]] std::optional<SettingsProblem> problem_with(const HingeTie& settings);

/// A tie as the solver sees it: d = sum c_k p_k over its particles; either |d| is to be `rest`, or d to be
/// zero.
struct Tie {
  ParticleConstraintId id{};
  std::uint64_t serial[4]{};
  double c[4]{};
  int particles{2};
  bool straight{false};  ///< d is to be zero: three rows; else one for its length
  double rest{0};        ///< [m]
  double compliance{0};  ///< of |d|^2 / 2 over energy
  double damping_time{0};
  double scale{1};  ///< what errors of d are measured by
};

/// Where the particles of a tie stand when it is made.
[[nodiscard]] Tie tie_of(const DistanceTie& settings, const Vector3& a, const Vector3& b);
[[nodiscard]] Tie tie_of(const BendTie& settings, const Vector3& a, const Vector3& b, const Vector3& c);
[[nodiscard]] Tie tie_of(const HingeTie& settings, const Vector3& a, const Vector3& b, const Vector3& c,
                         const Vector3& d);

/// A particle that a point of a body, or of the world, carries along; simulated bodies feel what ties pull at
/// it.
struct Pin {
  std::uint64_t serial{0};
  Attachment to{};
};

}  // namespace pantin
