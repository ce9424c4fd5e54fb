#pragma once
// Drag proportional to the velocity against a medium: F = -c (v_WBcm - u), T = -k w_WB; on a particle -c (v -
// u).
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct LinearDrag {
  BodyId body{};                             ///< null, and no system = every simulated body and particle
  double coefficient{0};                     ///< c [N s/m], >= 0
  double angular_coefficient{0};             ///< k [N m s/rad], >= 0
  Vector3 medium_velocity{Vector3::Zero()};  ///< u, in W [m/s]
  ParticleSystemId particles{};              ///< the particles of this system only
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const LinearDrag& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const LinearDrag& settings);

}  // namespace pantin
