#pragma once
// A field that is the same everywhere: F = c E at the centre of gravity, with c the mass or, where one is
// given, a charge. Potential energy -c E . p, zero at the world origin; no dependence on velocity. Unlike
// Gravity it can be kept to one body or system.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct UniformField {
  Vector3 field_W{Vector3::Zero()};  ///< E [N/kg], or [N] per unit of charge
  std::optional<double> charge{};    ///< c of each body and particle; nothing = its mass [kg]
  BodyId body{};                     ///< null, and no system = every simulated body and particle
  ParticleSystemId particles{};      ///< the particles of this system only
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const UniformField& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const UniformField& settings);

}  // namespace pantin
