#pragma once
// The implicit midpoint rule: of second order, symmetric in time and stable however stiff forces are
// (undamped ones too: they ring, but do not grow). It keeps linear and quadratic invariants, such as momenta,
// to rounding.
#include <memory>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

/// "implicit-midpoint": solves for the middle of each step, by iteration where that contracts fast, by
/// Newton's method where forces are stiff; a dozen evaluations for smooth forces, more the more stiff
/// directions there are. A step whose equations cannot be solved ends with numbers that are not finite, which
/// the manager reports.
[[nodiscard]] std::unique_ptr<Integrator> make_implicit_midpoint();

}  // namespace pantin
