#include <pantin/bridge/cli/run_loop.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

#include <pantin/bridge/cli/text_table.hpp>
#include <pantin/bridge/writers/energy_watch.hpp>

namespace pantin::cli {
namespace {

class Run {
 public:
  explicit Run(const RunJob& job)
      : job_{job},
        recorder_{job.world.scene, job.world.physics, job.world.bridge},
        slack_{1e-9 * job.options.step} {}

  RunOutcome carry_out() {
    const auto begin = std::chrono::steady_clock::now();
    outcome_.summary.completed = run();
    outcome_.summary.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    account_for_end();
    return outcome_;
  }

 private:
  /// False where it had to stop early.
  bool run() {
    if (!toggle_until(0)) return false;
    watch_.begin(job_.world.physics.energy(), conserves_energy(job_.world.physics));
    outcome_.summary.energy_initial = job_.world.physics.energy().total();
    sample();
    const double intervals = std::ceil(job_.options.duration / job_.options.every - 1e-9);
    for (double k = 1; k <= intervals; ++k) {
      const double at = k < intervals ? k * job_.options.every : job_.options.duration;
      while (next_toggle_ < job_.toggles.size() && job_.toggles[next_toggle_].time < at - slack_) {
        const double time = job_.toggles[next_toggle_].time;
        if (!advance_to(time) || !toggle_until(time)) return false;
      }
      if (!advance_to(at) || !toggle_until(at)) return false;
      sample();
    }
    return true;
  }

  bool advance_to(double time) {
    const AdvanceReport report = job_.world.bridge.advance_until(time);
    outcome_.summary.steps += report.updates;
    outcome_.summary.evaluations += report.evaluations;
    outcome_.summary.joint_events += report.joint_events;
    outcome_.summary.crowded += report.crowded;
    // Stops without bounce take energy from what hits them.
    if (report.joint_events > 0) watch_.begin(job_.world.physics.energy(), false);
    job_.ledger.add(report.notes);
    if (!report.last.ok()) {
      outcome_.code = ExitCode::NumericalFailure;
      const bool culprit_is_named = has_error(report.notes);
      job_.ledger.add(
          {Severity::Error, "t = " + short_number(report.time) + " s", "simulation",
           "stopped early" + (culprit_is_named ? "" : ": " + report.last.message),
           "try a smaller --step, or --integrator implicit-midpoint; what was reached until then is kept"});
      return false;
    }
    return continues();
  }

  bool toggle_until(double time) {
    const std::size_t first = next_toggle_;
    while (next_toggle_ < job_.toggles.size() && job_.toggles[next_toggle_].time <= time + slack_) {
      const PlannedToggle& toggle = job_.toggles[next_toggle_++];
      if (next_toggle_ == first + 1) watch_.see(job_.world.physics.energy());
      job_.ledger.add(cli::carry_out(job_.world, toggle));
      if (!continues()) return false;
      ++outcome_.summary.toggles;
      if (job_.on_toggle) job_.on_toggle(toggle);
    }
    if (next_toggle_ > first) watch_.begin(job_.world.physics.energy(), conserves_energy(job_.world.physics));
    return true;
  }

  bool continues() {
    if (!job_.ledger.has_error()) return true;
    outcome_.code = ExitCode::BadInput;
    return false;
  }

  void sample() {
    const Sample& sample = recorder_.record();
    for (TrajectoryWriter* writer : job_.writers) writer->write(sample);
    watch_.see(sample.energy);
    const JointDrift drift = job_.world.physics.joint_drift();
    RunSummary& summary = outcome_.summary;
    summary.joint_drift_m = std::max(summary.joint_drift_m, drift.distance);
    summary.joint_drift_rad = std::max(summary.joint_drift_rad, drift.angle);
    ++summary.samples;
    if (job_.on_sample) job_.on_sample(sample.t);
  }

  void account_for_end() {
    RunSummary& summary = outcome_.summary;
    const Bridge& bridge = job_.world.bridge;
    summary.models = job_.options.models;
    const std::vector<NodeId> bound = bridge.bound();
    summary.bodies = bound.size();
    summary.bodies_simulated = static_cast<std::size_t>(std::count_if(
        bound.begin(), bound.end(), [&](NodeId id) { return bridge.drive_of(id) == Drive::Physics; }));
    summary.joints = job_.world.physics.joints().size();
    summary.duration = bridge.time();
    summary.integrator = job_.options.integrator;
    summary.step = job_.options.step;
    summary.energy_final = job_.world.physics.energy().total();
    summary.energy_conserved_expected = watch_.conserved();
    summary.energy_drift = watch_.drift();
  }

  const RunJob& job_;
  TrajectoryRecorder recorder_;
  EnergyWatch watch_{};
  RunOutcome outcome_{};
  std::size_t next_toggle_{0};
  double slack_;  ///< times nearer than this are one [s]
};

}  // namespace

RunOutcome simulate(const RunJob& job) { return Run{job}.carry_out(); }

}  // namespace pantin::cli
