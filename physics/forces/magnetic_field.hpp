#pragma once
// A uniform magnetic field on moving charges: F = c v x B at the centre of gravity. It does no work, so it
// has no potential; it depends on velocity.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct MagneticField {
  Vector3 field_W{Vector3::Zero()};  ///< B [T]
  double charge{0};                  ///< c of each body and particle [C]
  BodyId body{};                     ///< null, and no system = every simulated body and particle
  ParticleSystemId particles{};      ///< the particles of this system only
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const MagneticField& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const MagneticField& settings);

}  // namespace pantin
