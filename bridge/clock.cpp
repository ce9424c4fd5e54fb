#include <pantin/bridge/clock.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/scenegraph/expects.hpp>

namespace pantin {
namespace {

constexpr double kSlack =
    1e-9;  // of a step: elapsed times that are meant to be whole steps are not exactly so

}  // namespace

std::optional<SettingsProblem> problem_with(const ClockSettings& settings) {
  if (!(settings.step > 0) || !std::isfinite(settings.step)) {
    return SettingsProblem{
        ProblemCode::OutOfRange,
        "clock: step is " + std::to_string(settings.step) + " s; it must be above 0 and finite",
        "a two hundred and fortieth of a second is usual"};
  }
  if (settings.max_updates < 1) {
    return SettingsProblem{
        ProblemCode::OutOfRange,
        "clock: max_updates is " + std::to_string(settings.max_updates) + "; it must be 1 or more",
        "give the number of updates that one advance may take"};
  }
  return std::nullopt;
}

Clock::Clock(ClockSettings settings, double start)
    : settings_{settings}, origin_{start}, time_{start}, due_until_{start} {
  const std::optional<SettingsProblem> problem = problem_with(settings);
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
  PANTIN_EXPECTS(std::isfinite(start), "clock: the time it starts at is not finite");
}

void Clock::count_from(double time, double rest) {
  origin_ = time_ = due_until_ = time;
  count_ = due_count_ = 0;
  beyond_ = rest;
}

void Clock::set_step(double step) {
  ClockSettings settings = settings_;
  settings.step = step;
  const std::optional<SettingsProblem> problem = problem_with(settings);
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
  count_from(time_, rest());
  settings_ = settings;
}

void Clock::restart(double time) {
  PANTIN_EXPECTS(std::isfinite(time), "clock: the time to go on from is not finite");
  count_from(time, rest());
  std::erase_if(landings_, [time](double landing) { return landing <= time; });
}

// What has elapsed and is not simulated: beyond the last due count, less what a landing beyond it has used.
double Clock::rest() const noexcept { return std::max(0.0, beyond_ - (time_ - at_count(due_count_))); }

void Clock::add(double elapsed) {
  PANTIN_EXPECTS(elapsed >= 0 && std::isfinite(elapsed),
                 "clock: elapsed time is " + std::to_string(elapsed) + " s; it must be 0 or more and finite");
  beyond_ += elapsed;
  const double whole = std::max(0.0, std::floor(beyond_ / settings_.step + kSlack));
  beyond_ -= whole * settings_.step;
  const double most = settings_.max_updates;
  if (whole > most) dropped_ += (whole - most) * settings_.step;
  const auto updates = static_cast<std::int64_t>(std::min(whole, most));
  if (updates == 0) return;
  due_count_ += updates;
  due_until_ = at_count(due_count_);
}

void Clock::add_until(double time) {
  PANTIN_EXPECTS(std::isfinite(time) && time >= due_until_, "clock: time " + std::to_string(time) +
                                                                " s to advance until is past, it is " +
                                                                std::to_string(due_until_) + " s");
  due_count_ += static_cast<std::int64_t>(
      std::max(0.0, std::floor((time - at_count(due_count_)) / settings_.step + kSlack)));
  beyond_ = time - at_count(due_count_);
  due_until_ = time;
  land_on(time);
}

std::optional<double> Clock::next() const {
  const double slack = kSlack * settings_.step;
  double end = at_count(count_ + 1);
  if (!landings_.empty() && landings_.front() < end + slack) end = landings_.front();
  if (end > due_until_ + slack) return std::nullopt;
  return end;
}

std::optional<double> Clock::next_stop() const {
  if (!next()) return std::nullopt;
  return landings_.empty() ? due_until_ : std::min(due_until_, landings_.front());
}

void Clock::reached(double time) {
  const double slack = kSlack * settings_.step;
  time_ = time;
  while (at_count(count_ + 1) <= time + slack) ++count_;
  std::erase_if(landings_, [time, slack](double landing) { return landing <= time + slack; });
}

void Clock::land_on(double time) {
  if (!(time > time_ + kSlack * settings_.step) || !std::isfinite(time)) return;
  const auto at = std::lower_bound(landings_.begin(), landings_.end(), time);
  if (at == landings_.end() || *at != time) landings_.insert(at, time);
}

}  // namespace pantin
