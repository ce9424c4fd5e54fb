#pragma once
// Damped springs between particles, of one system or several, or from particles to points of bodies or of the
// world: tension = k (l - l0) + c dl/dt along the line that joins the ends, as DampedSpring. All springs are
// one law, so a net costs one call. Their systems are integrated together with the bodies, by their
// integrator and at its order.
#include <memory>
#include <optional>
#include <vector>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

/// One spring of the net. Where an end's particle is gone, it pulls no more.
struct ParticleSpring {
  ParticleId a{};
  ParticleId b{};         ///< null = the other end is `anchor`
  Attachment anchor{};    ///< a point of a body, or of the world
  double stiffness{0};    ///< k [N/m], >= 0
  double damping{0};      ///< c [N s/m], >= 0
  double rest_length{0};  ///< l0 [m], >= 0
};

struct ParticleSprings {
  std::vector<ParticleSpring> springs{};  ///< at least one
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const ParticleSprings& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const ParticleSprings& settings);

}  // namespace pantin
