#include <filesystem>
#include <iostream>
#include <memory>

#include <pantin/bridge/cli/ledger_text.hpp>
#include <pantin/bridge/cli/progress_bar.hpp>
#include <pantin/bridge/cli/run_loop.hpp>
#include <pantin/bridge/cli/run_text.hpp>
#include <pantin/bridge/cli/text_table.hpp>
#include <pantin/bridge/writers/output_file.hpp>
#include <pantin/bridge/writers/trajectory_csv.hpp>
#include <pantin/bridge/writers/trajectory_json.hpp>

namespace pantin::cli {
namespace {

/// Where the trajectory goes: the files of --out, standard output for --json, or nowhere.
class Outputs {
 public:
  /// Opens the files; an error in the ledger where that fails.
  Outputs(const RunOptions& options, Ledger& ledger) {
    for (const std::string& name : options.out) {
      Loaded<OutputFile> opened = OutputFile::open(name);
      ledger.add(opened.notes);
      if (!opened.value) continue;
      files_.push_back(std::move(*opened.value));
      if (std::filesystem::path{name}.extension() == ".csv")
        writers_.push_back(std::make_unique<TrajectoryCsv>(files_.back().stream()));
      else writers_.push_back(std::make_unique<TrajectoryJson>(files_.back().stream()));
    }
    if (options.common.json && !ledger.has_error())
      writers_.push_back(std::make_unique<TrajectoryJson>(std::cout));
  }

  [[nodiscard]] std::vector<TrajectoryWriter*> writers() const {
    std::vector<TrajectoryWriter*> all;
    for (const std::unique_ptr<TrajectoryWriter>& writer : writers_) all.push_back(writer.get());
    return all;
  }

  /// Ends the documents and puts the files in place; false where that failed, with errors in the ledger.
  bool finish(const RunSummary& summary, Ledger& ledger) {
    for (const std::unique_ptr<TrajectoryWriter>& writer : writers_) writer->finish(summary, ledger.notes());
    bool all_well = true;
    for (OutputFile& file : files_) {
      const std::optional<Diagnostic> problem = file.commit();
      if (problem) ledger.add(*problem);
      all_well = all_well && !problem;
    }
    return all_well;
  }

 private:
  std::vector<OutputFile> files_{};
  std::vector<std::unique_ptr<TrajectoryWriter>> writers_{};
};

RunOutcome simulate_aloud(const RunOptions& options, RunWorld& world,
                          const std::vector<PlannedToggle>& toggles, const Outputs& outputs, Ledger& ledger) {
  ProgressBar bar{options.duration};
  RunJob job{
      .options = options, .world = world, .toggles = toggles, .writers = outputs.writers(), .ledger = ledger};
  job.on_sample = [&](double time) { bar.show(time); };
  if (!options.common.json)
    job.on_toggle = [&](const PlannedToggle& toggle) {
      bar.wipe();
      std::cout << "  t = " << short_number(world.bridge.time()) << " s: '" << printable(toggle.path)
                << "' is " << to_string(toggle.drive) << " from here on" << std::endl;
    };
  return simulate(job);
}

}  // namespace

ExitCode run(const RunOptions& options) {
  const bool for_people = !options.common.json;
  Ledger ledger{options.common.strict};
  RunWorld world{options};
  build_world(options, world, ledger);
  if (ledger.has_error()) return fail(options.common, ledger);
  const std::vector<PlannedToggle> toggles = assign_drives(options, world, ledger);
  if (ledger.has_error()) return fail(options.common, ledger);
  Outputs outputs{options, ledger};
  if (ledger.has_error()) return fail(options.common, ledger);

  const std::size_t said = ledger.notes().size();
  if (for_people) {
    print_world(std::cout, world);
    print_remarks(std::cout, ledger.notes());
    std::cout << "running " << short_number(options.duration) << " s in steps of "
              << short_seconds(options.step) << " with " << options.integrator << std::endl;
  }
  RunOutcome outcome = simulate_aloud(options, world, toggles, outputs, ledger);
  const bool is_written = outputs.finish(outcome.summary, ledger);
  if (!is_written && outcome.code == ExitCode::Fine) outcome.code = ExitCode::BadInput;
  if (for_people) {
    print_remarks(std::cout, std::span{ledger.notes()}.subspan(said));
    print_summary(std::cout, outcome.summary);
    if (is_written)
      for (const std::string& name : options.out)
        std::cout << (outcome.summary.completed ? "wrote " : "wrote what was reached to ") << printable(name)
                  << '\n';
    std::cout.flush();
  }
  print_errors(ledger.notes());
  return outcome.code;
}

}  // namespace pantin::cli
