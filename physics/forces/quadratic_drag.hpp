#pragma once
// Drag proportional to the square of the velocity against a medium: F = -c |v - u| (v - u), T = -k |w| w.
// For a solid of drag coefficient C and cross-section A in a medium of density rho, c = rho C A / 2. It has
// no potential and depends on velocity, once differentiably at v = u.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct QuadraticDrag {
  BodyId body{};                             ///< null, and no system = every simulated body and particle
  double coefficient{0};                     ///< c, at the centre of gravity [N s^2/m^2], >= 0
  double angular_coefficient{0};             ///< k [N m s^2/rad^2], >= 0; bodies only
  Vector3 medium_velocity{Vector3::Zero()};  ///< u, in W [m/s]
  ParticleSystemId particles{};              ///< the particles of this system only
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const QuadraticDrag& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const QuadraticDrag& settings);

}  // namespace pantin
