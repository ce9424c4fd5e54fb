#pragma once
// Radau IIA collocation with four stages, of order seven and L-stable: for stiff, damped forces. What decays
// faster than a step is followed to where it goes without being resolved; oscillations that a step does not
// resolve are damped. Where stiff forces act along lines that turn with the motion, as springs between
// bodies, these are followed from stage to stage (stage_factors.hpp).
#include <memory>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

struct RadauSettings {
  /// Local error per unit time of body position [m/s] and attitude [rad/s], > 0; infinity: no control, one
  /// step, cut only where the iteration does not converge.
  double tolerance{1e-9};
};

/// "radau". Needs the derivative of the motion by differences, so as many evaluations as there are numbers
/// every few steps, their square in memory, and room for factors in every step: for scenes of some hundred
/// numbers.
[[nodiscard]] std::unique_ptr<Integrator> make_radau(const RadauSettings& settings);
[[nodiscard]] std::unique_ptr<Integrator> make_radau();

}  // namespace pantin
