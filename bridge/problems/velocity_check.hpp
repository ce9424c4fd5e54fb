#pragma once
// Whether the velocities at t = 0 are such as the joints allow. Private to the reader of reference problems.
#include <vector>

#include <pantin/bridge/diagnostic.hpp>

#include "problem_index.hpp"

namespace pantin::reference {

/// Adds a warning for each joint whose bodies move against each other in a way that it holds. Names must be
/// good.
void add_velocity_warnings(const Problem& problem, const ProblemIndex& index,
                           std::vector<Diagnostic>& ledger);

}  // namespace pantin::reference
