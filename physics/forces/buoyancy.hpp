#pragma once
// Buoyancy in a fluid at rest that fills a half-space: the weight of the fluid displaced, upward, at the
// centroid of the part below the surface, whose volume is exact (submerged_volume.hpp). Potential energy is
// density * gravity * volume * depth of that centroid: zero above the surface.
//
// `drag` adds a resistance that goes with the volume below the surface, F = -drag * volume * (v - u) at its
// centroid; with it the law depends on velocity. The force is once differentiable where a smooth solid
// touches the surface, so there integrators of higher order lose some of it.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>
#include <pantin/physics/shape.hpp>

namespace pantin {

struct Buoyancy {
  BodyId body{};                 ///< this or `particles`, not both
  ParticleSystemId particles{};  ///< every particle of this system displaces the shape, a sphere around it
  Shape shape{};  ///< what displaces the fluid, in B: sphere, ellipsoid, box, convex hull, closed
                  ///< mesh or a compound of them
  Vector3 p_WS{Vector3::Zero()};     ///< a point of the surface [m]
  Vector3 up_W{Vector3::UnitZ()};    ///< out of the fluid, against gravity, unit
  double density{1000};              ///< of the fluid [kg/m^3], >= 0
  double gravity{9.81};              ///< [m/s^2], >= 0
  double drag{0};                    ///< [N s/m per m^3], >= 0
  Vector3 current{Vector3::Zero()};  ///< u, velocity of the fluid for its drag, in W [m/s]
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const Buoyancy& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const Buoyancy& settings);

}  // namespace pantin
