#pragma once
// Explicit Euler, first order: q and v both move along the derivative at the start of the step. It feeds
// energy into everything that oscillates; here for comparison.
#include <memory>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

/// "euler": q1 = q + h q', v1 = v + h v', both derivatives at t. One evaluation a step.
[[nodiscard]] std::unique_ptr<Integrator> make_euler();

}  // namespace pantin
