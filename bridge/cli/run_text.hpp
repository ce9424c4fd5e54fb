#pragma once
// What `pantin run` tells people.
#include <ostream>

#include <pantin/bridge/cli/run_world.hpp>
#include <pantin/bridge/writers/run_summary.hpp>

namespace pantin::cli {

/// Every model: file, what it holds, how it was placed; then how many nodes each drive has.
void print_world(std::ostream& out, const RunWorld& world);

/// The account of a run, a line for each matter.
void print_summary(std::ostream& out, const RunSummary& summary);

}  // namespace pantin::cli
