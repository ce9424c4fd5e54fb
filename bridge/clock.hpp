#pragma once
// Turns elapsed time into physics updates: a constant step with the unused rest carried over, a cap on
// updates, and times on which an update has to land. Time is a count times the step, so it does not drift.
// Where the integrator chooses its steps, several steps that are due may go as one update.
#include <cstdint>
#include <optional>
#include <vector>

#include <pantin/physics/problem.hpp>

namespace pantin {

/// How far an update goes.
enum class Stepping : std::uint8_t {
  Fixed,     ///< one step
  Adaptive,  ///< all steps that are due up to the next landing: the integrator cuts them as its tolerance
             ///< needs
};

struct ClockSettings {
  double step{1.0 / 240};  ///< [s], > 0
  int max_updates{1000};   ///< steps of one advance, >= 1; what does not fit is dropped and reported
  /// Adaptive counts only while the integrator keeps to a tolerance (Integrator::tolerance) and there are no
  /// particles, which meet deflectors update by update.
  Stepping stepping{Stepping::Fixed};
  /// Whether steps are cut, or taken implicitly, where the integrator would not bear them
  /// (PhysicsManager::watch_stability); a note says so once for each body or joint that is too fast.
  bool watch_stability{true};
};
[[nodiscard]] std::optional<SettingsProblem> problem_with(const ClockSettings& settings);

class Clock {
 public:
  explicit Clock(ClockSettings settings = {}, double start = 0);

  [[nodiscard]] const ClockSettings& settings() const noexcept { return settings_; }
  void set_step(double step);  ///< counts afresh from the present time
  void set_stepping(Stepping stepping) noexcept { settings_.stepping = stepping; }
  [[nodiscard]] double time() const noexcept { return time_; }  ///< reached by updates [s]
  [[nodiscard]] double rest() const noexcept;                   ///< elapsed but not yet due [s], < step
  [[nodiscard]] double due_until() const noexcept { return due_until_; }  ///< where the due updates end [s]
  [[nodiscard]] double dropped() const noexcept { return dropped_; }      ///< in all, by the cap [s]

  /// Adds elapsed time: floor((elapsed + rest) / step) whole updates become due, with 1e-9 of a step of
  /// slack.
  void add(double elapsed);
  /// Makes everything up to `time` due, the last update shortened so as to land on it; the rest becomes 0.
  /// Counting goes on as before.
  void add_until(double time);
  /// The end of the next due update: the next count of the step, or an earlier landing; nothing when none is
  /// due.
  [[nodiscard]] std::optional<double> next() const;
  /// The end of everything that is due, or an earlier landing; nothing when nothing is due.
  [[nodiscard]] std::optional<double> next_stop() const;
  /// Says that physics has reached `time`, the value of next() or next_stop().
  void reached(double time);
  /// An update has to end at this time (toggle, sample); ignored if it is not ahead.
  void land_on(double time);
  /// Goes on from another time (physics was stepped or set back by somebody else); the rest is kept.
  void restart(double time);

 private:
  [[nodiscard]] double at_count(std::int64_t count) const noexcept {
    return origin_ + static_cast<double>(count) * settings_.step;
  }
  void count_from(double time, double rest);

  ClockSettings settings_{};
  double origin_{0};           ///< where counting began [s]
  std::int64_t count_{0};      ///< whole steps since origin_ that are reached
  std::int64_t due_count_{0};  ///< and that are due
  double beyond_{0};           ///< elapsed beyond due_count_ [s]
  double time_{0};
  double due_until_{0};
  double dropped_{0};
  std::vector<double> landings_{};  ///< ascending
};

}  // namespace pantin
