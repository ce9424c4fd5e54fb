#pragma once
// Dormand-Prince 5(4): the Runge-Kutta method of fifth order with an error estimate of fourth order, which
// cuts the step asked for into as many steps of its own as the tolerance needs.
#include <memory>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

struct DormandPrinceSettings {
  /// Local error per unit time of body position [m/s] and attitude [rad/s], > 0; infinity: no control, one
  /// step.
  double tolerance{1e-9};
};

/// "dormand-prince": six evaluations an accepted or refused step, and one more at the start of each step
/// asked for.
[[nodiscard]] std::unique_ptr<Integrator> make_dormand_prince(const DormandPrinceSettings& settings);
[[nodiscard]] std::unique_ptr<Integrator> make_dormand_prince();

}  // namespace pantin
