// What ends a smooth part: stops reached, sliding that comes to rest, holds that no longer bear the load.
#include <algorithm>
#include <array>
#include <cmath>

#include <pantin/physics/stops/axis_guard.hpp>
#include <pantin/physics/stops/first_crossing.hpp>
#include <pantin/physics/stops/guard_limits.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

namespace {

using Coefficients = std::array<double, kMostDegree + 1>;

double slope_at(std::span<const double> c, double x) {
  double slope = 0;
  for (std::size_t k = c.size(); k-- > 1;) slope = slope * x + static_cast<double>(k) * c[k];
  return slope;
}

/// Where sign * (polynomial - level) rises above slack.
std::optional<double> crossing(std::span<const double> c, double sign, double level, double slack) {
  if (!std::isfinite(level)) return std::nullopt;
  Coefficients g;
  for (std::size_t k = 0; k < c.size(); ++k) g[k] = sign * c[k];
  g[0] -= sign * level + slack;
  return first_above_zero({g.data(), c.size()});
}

}  // namespace

std::optional<AxisCrossing> AxisGuard::first_crossing(const MotionRecord& record, std::size_t first,
                                                      std::size_t coordinates) const {
  const std::size_t q0 = dynamics_.coordinates() - constraints_.layout().coordinates;
  const std::size_t v0 = coordinates + dynamics_.velocities() - constraints_.layout().rates;
  for (std::size_t part = first; part < record.parts(); ++part) {
    const MotionRecord::Span at = record.part(part);
    Coefficients room;
    const std::span<double> c{room.data(), at.degree + 1};
    std::optional<AxisCrossing> found;
    double least = 2;
    const auto offer = [&](std::optional<double> x, std::size_t i, AxisCrossing::Kind kind, bool upper) {
      if (!x || *x >= least) return;
      least = *x;
      found = {at.t + *x * at.h, i, kind, upper, slope_at(c, *x) / at.h};
    };
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const AxisMode m = mode(i);
      if (is_locked(m)) continue;
      const Range stops = stops_[i];
      record.coefficients(part, q0 + axes_[i].q, c);
      offer(crossing(c, 1, stops.upper, kPassedStop * (1 + std::abs(stops.upper))), i,
            AxisCrossing::Kind::Stop, true);
      offer(crossing(c, -1, stops.lower, kPassedStop * (1 + std::abs(stops.lower))), i,
            AxisCrossing::Kind::Stop, false);
      if (m == AxisMode::Free) continue;
      record.coefficients(part, v0 + axes_[i].v, c);
      offer(crossing(c, m == AxisMode::SlidingForward ? -1 : 1, 0, kPassedRest), i, AxisCrossing::Kind::Rest,
            m == AxisMode::SlidingBackward);
    }
    if (found) return found;
  }
  return std::nullopt;
}

double AxisGuard::miss(const AxisCrossing& crossing, const GuardedMotion& motion) const {
  const std::size_t i = crossing.axis;
  if (crossing.kind == AxisCrossing::Kind::Effort || crossing.slope == 0) return 0;
  if (crossing.kind == AxisCrossing::Kind::Rest) {
    const double v = v_of(i, motion);
    return std::abs(v) <= kPassedRest ? 0 : v / crossing.slope;
  }
  const double stop = crossing.upper ? stops_[i].upper : stops_[i].lower, beyond = q_of(i, motion) - stop;
  return std::abs(beyond) <= kPassedStop * (1 + std::abs(stop)) ? 0 : beyond / crossing.slope;
}

void AxisGuard::pass(const AxisCrossing& crossing, const GuardedMotion& motion) {
  const std::size_t i = crossing.axis;
  switch (crossing.kind) {
    case AxisCrossing::Kind::Stop:
      q_of(i, motion) = crossing.upper ? stops_[i].upper : stops_[i].lower;
      break;
    case AxisCrossing::Kind::Rest:
      v_of(i, motion) = 0;
      break;
    case AxisCrossing::Kind::Effort:
      note(i, mode(i) == AxisMode::Stuck ? JointEventKind::Slipped : JointEventKind::StopLeft, motion);
      mode(i) = !axes_[i].has_friction() ? AxisMode::Free
                : crossing.upper         ? AxisMode::SlidingBackward
                                         : AxisMode::SlidingForward;
      released_ = i;
      break;
  }
}

bool AxisGuard::any_bounded_hold() const {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (is_locked(mode(i)) && stops_[i].lower < stops_[i].upper) return true;
  }
  return false;
}

std::span<const double> AxisGuard::efforts(const GuardedMotion& motion) {
  constraints_.ground_motions(bodies_, motion.at, grounds_);
  accelerate(motion);
  const std::size_t first = dynamics_.velocities() - constraints_.layout().rates;
  for (const Tree& tree : constraints_.layout().trees) {
    const auto [begin, end] = range_of(tree);
    picked_.clear();
    for (std::size_t i = begin; i < end; ++i) {
      effort_of_axis_[i] = efforts_[axes_[i].v];
      if (is_locked(mode(i))) picked_.push_back(i);
    }
    if (picked_.empty()) continue;
    fill_response(tree, motion);
    for (std::size_t k = 0; k < picked_.size(); ++k) {
      problem_.b[k] = v_dot_[first + axes_[picked_[k]].v];
    }
    problem_.solve();
    for (std::size_t k = 0; k < picked_.size(); ++k) effort_of_axis_[picked_[k]] = problem_.x[k];
  }
  return effort_of_axis_;
}

AxisGuard::Excess AxisGuard::excess(const GuardedMotion& motion) {
  static_cast<void>(efforts(motion));
  Excess most;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!is_locked(mode(i))) continue;
    const Range bears = bearing(i, motion);
    const double effort = effort_of_axis_[i], size = std::abs(effort) + axes_[i].friction;
    if (size == 0) continue;
    const double above = (effort - bears.upper) / size, below = (bears.lower - effort) / size;
    const double amount = std::max(above, below) - kPassedEffort;
    if (amount > most.amount) most = {amount, i, above > below};
  }
  return most;
}

}  // namespace pantin
