#pragma once
// Velocity Verlet, second order, as a one-step method: half kick, drift through the middle, half kick.
// Symplectic and time-reversible where v' = a(q) and q' = v; second order also for attitudes and for forces
// that look at velocities.
#include <memory>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

/// "verlet": two evaluations a step, three where accelerations depend on velocities.
[[nodiscard]] std::unique_ptr<Integrator> make_verlet();

}  // namespace pantin
