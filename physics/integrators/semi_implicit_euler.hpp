#pragma once
// Semi-implicit Euler, first order: velocities first, then coordinates with the new velocities. Symplectic
// where v' = a(q) and q' = v: energy oscillates and does not drift.
#include <memory>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

/// "semi-implicit-euler": v1 = v + h v'(t, q, v), q1 = q + h q'(q, v1). One evaluation a step.
[[nodiscard]] std::unique_ptr<Integrator> make_semi_implicit_euler();

}  // namespace pantin
