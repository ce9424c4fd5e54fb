#pragma once
// The classical Runge-Kutta method of fourth order. Attitudes are taken as coordinates of R^4 within the
// step, so that they are of fourth order too.
#include <memory>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

/// "rk4": four evaluations a step.
[[nodiscard]] std::unique_ptr<Integrator> make_rk4();

}  // namespace pantin
