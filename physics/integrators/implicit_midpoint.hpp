#pragma once
// The implicit midpoint rule: of second order, symmetric in time and stable at any stiffness for which its
// equations can be solved. It is not damping: undamped stiff forces ring without growing, strongly damped
// ones die out slowly. It keeps linear and quadratic invariants, such as momenta, to rounding.
#include <memory>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

/// "implicit-midpoint": solves for the middle of each step, by iteration where that contracts fast, by
/// Newton's method where forces are stiff, with an evaluation for each number of the state and step of
/// Newton's. A step whose equations cannot be solved ends with numbers that are not finite, which the manager
/// reports.
[[nodiscard]] std::unique_ptr<Integrator> make_implicit_midpoint();

}  // namespace pantin
