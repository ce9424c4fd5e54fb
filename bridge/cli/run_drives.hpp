#pragma once
// Who moves what in `pantin run`: clips are played, nodes handed over, and changes of drive looked up in
// advance.
#include <vector>

#include <pantin/bridge/cli/ledger_text.hpp>
#include <pantin/bridge/cli/run_world.hpp>

namespace pantin::cli {

/// A change of drive that was asked for, its node found.
struct PlannedToggle {
  double time{0};  ///< [s]
  NodeId node{};
  std::string path{};
  Drive drive{Drive::Physics};
};

/// Finds every path and clip, then plays, follows and hands over. The toggles come sorted by time, those of
/// one time in the order of the command line. Nothing is simulated where the ledger has an error afterwards.
[[nodiscard]] std::vector<PlannedToggle> assign_drives(const RunOptions& options, RunWorld& world,
                                                       Ledger& ledger);

/// Carries one out now: with the node go all below it. A warning where that changes nothing.
[[nodiscard]] std::vector<Diagnostic> carry_out(RunWorld& world, const PlannedToggle& toggle);

}  // namespace pantin::cli
