#pragma once
// A field that points away from a point of the world and goes with a power of the distance: F = c S (d /
// d0)^n r / d at the centre of gravity, with r from the centre, d = sqrt(r^2 + s^2), s the softening and c
// the mass or, where one is given, a charge. Potential energy -c S d0 (d / d0)^(n+1) / (n+1), for n = -1 -c S
// d0 ln(d / d0); no dependence on velocity. Where d is zero so is the force. n = -2 is a point charge's
// field, -1 a fan's without end, 1 an isotropic spring's.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct RadialField {
  Vector3 centre{Vector3::Zero()};  ///< in W [m]
  double strength{0};               ///< S [N/kg], or [N] per unit of charge; negative points inward
  double exponent{-2};              ///< n
  double at_distance{1};            ///< d0, where the field has its strength [m], > 0
  double softening{0};              ///< s [m], >= 0
  std::optional<double> charge{};   ///< c of each body and particle; nothing = its mass [kg]
  BodyId body{};                    ///< null, and no system = every simulated body and particle
  ParticleSystemId particles{};     ///< the particles of this system only
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const RadialField& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const RadialField& settings);

}  // namespace pantin
