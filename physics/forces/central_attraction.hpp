#pragma once
// Attraction towards a point of the world or of a body, falling with the square of the distance: the
// acceleration a = -mu r / (r^2 + s^2)^(3/2), r from the centre, s the softening (H. C. Plummer, MNRAS 71,
// 460 (1911)). It acts at centres of gravity; on a body's centre acts the reaction, so that momentum stays.
// Potential energy -m mu / sqrt(r^2 + s^2); no dependence on velocity. Where r is zero so is the force.
//
// Particles attracted by a point of a body are integrated with the bodies.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct CentralAttraction {
  Attachment centre{};           ///< a point of the world, or of a body of any kind
  double mu{0};                  ///< G times the centre's mass [m^3/s^2]; negative repels
  double softening{0};           ///< s [m], >= 0
  BodyId body{};                 ///< null, and no system = every simulated body and particle
  ParticleSystemId particles{};  ///< the particles of this system only
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const CentralAttraction& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const CentralAttraction& settings);

}  // namespace pantin
