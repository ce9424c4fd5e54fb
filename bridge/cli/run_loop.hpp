#pragma once
// The running of `pantin run`: advances from sample to sample and toggle to toggle, and keeps account.
#include <functional>
#include <vector>

#include <pantin/bridge/cli/run_drives.hpp>
#include <pantin/bridge/writers/trajectory.hpp>

namespace pantin::cli {

struct RunJob {
  const RunOptions& options;
  RunWorld& world;
  std::vector<PlannedToggle> toggles{};                   ///< ascending in time
  std::vector<TrajectoryWriter*> writers{};               ///< receive the samples; not finished here
  Ledger& ledger;                                         ///< receives what happens on the way
  std::function<void(double)> on_sample{};                ///< after each sample, with its time [s]
  std::function<void(const PlannedToggle&)> on_toggle{};  ///< after each change of drive
};

struct RunOutcome {
  ExitCode code{ExitCode::Fine};
  RunSummary summary{};
};

/// Samples at every k * options.every and at the end. A sample at the time of a toggle shows the state after
/// it. A step whose numbers go wrong, or a toggle that is refused, ends the run early: the ledger has the
/// error then.
[[nodiscard]] RunOutcome simulate(const RunJob& job);

}  // namespace pantin::cli
