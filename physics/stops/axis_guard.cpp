// Modes at the begin of a smooth part: blows on stops, then what holds and what slides.
#include <pantin/physics/stops/axis_guard.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/physics/stops/guard_limits.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

void AxisGuard::fit() {
  const State& state = bodies_.state;
  if (!fits_ || topology_ != state.topology) {
    std::vector<const JointDefinition*> joints;
    for (std::size_t j = 0; j < constraints_.size(); ++j) joints.push_back(&constraints_.joint(j));
    axes_ = guarded_axes(constraints_.layout(), joints);
    stops_.assign(axes_.size(), {});
    effort_of_axis_.assign(axes_.size(), 0.0);
    open_.assign(axes_.size(), 0);
    before_.assign(axes_.size(), AxisMode::Free);
    topology_ = state.topology;
    fits_ = true;
  }
  if (state.axis_modes.size() != axes_.size()) bodies_.state.axis_modes.assign(axes_.size(), AxisMode::Free);
}

std::optional<std::size_t> AxisGuard::find(std::size_t joint, int axis) const {
  const auto found = std::find_if(axes_.begin(), axes_.end(), [&](const GuardedAxis& guarded) {
    return guarded.joint == joint && guarded.axis == axis;
  });
  if (found == axes_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - axes_.begin());
}

double& AxisGuard::q_of(std::size_t i, const GuardedMotion& motion) const {
  return motion.q[dynamics_.coordinates() - constraints_.layout().coordinates + axes_[i].q];
}

double& AxisGuard::v_of(std::size_t i, const GuardedMotion& motion) const {
  return motion.v[dynamics_.velocities() - constraints_.layout().rates + axes_[i].v];
}

std::span<const double> AxisGuard::tree_q(const GuardedMotion& motion) const {
  const std::size_t count = constraints_.layout().coordinates;
  return std::span<const double>{motion.q}.subspan(dynamics_.coordinates() - count, count);
}

bool AxisGuard::at_lower(std::size_t i, const GuardedMotion& motion) const {
  return q_of(i, motion) <= stops_[i].lower + kTouch * (1 + std::abs(stops_[i].lower));
}

bool AxisGuard::at_upper(std::size_t i, const GuardedMotion& motion) const {
  return q_of(i, motion) >= stops_[i].upper - kTouch * (1 + std::abs(stops_[i].upper));
}

AxisGuard::Range AxisGuard::bearing(std::size_t i, const GuardedMotion& motion) const {
  const double friction = axes_[i].friction, infinite = JointAxis::kUnlimited;
  return {at_upper(i, motion) ? -infinite : -friction, at_lower(i, motion) ? infinite : friction};
}

void AxisGuard::note(std::size_t i, JointEventKind kind, const GuardedMotion& motion) {
  const GuardedAxis& axis = axes_[i];
  events.push_back({.time = motion.at.t,
                    .joint = constraints_.id(axis.joint),
                    .axis = axis.axis,
                    .kind = kind,
                    .value = axis.sense * q_of(i, motion),
                    .rate = axis.sense * v_of(i, motion)});
}

void AxisGuard::note_change(std::size_t i, const GuardedMotion& motion) {
  const AxisMode then = before_[i];
  const bool slid = then == AxisMode::SlidingForward || then == AxisMode::SlidingBackward;
  if (slid && mode(i) == AxisMode::Stuck) note(i, JointEventKind::Stuck, motion);
  if (!is_locked(then) || is_locked(mode(i))) return;
  note(i, then == AxisMode::Stuck ? JointEventKind::Slipped : JointEventKind::StopLeft, motion);
}

std::pair<std::size_t, std::size_t> AxisGuard::range_of(const Tree& tree) const {
  const auto before = [](const GuardedAxis& axis, std::uint32_t link) { return axis.link < link; };
  const auto begin = std::lower_bound(axes_.begin(), axes_.end(), tree.links_begin, before);
  const auto end = std::lower_bound(begin, axes_.end(), tree.links_end, before);
  return {static_cast<std::size_t>(begin - axes_.begin()), static_cast<std::size_t>(end - axes_.begin())};
}

/// The problem over the axes picked, of one tree, with nothing but its matrix.
void AxisGuard::fill_response(const Tree& tree, const GuardedMotion& motion) {
  problem_.reset(picked_.size());
  change_.resize(constraints_.layout().rates);
  response_.factor(tree, grounds_, motion.at, tree_q(motion));
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    response_.push(axes_[picked_[k]].link, axes_[picked_[k]].v, 1);
    response_.respond(change_);
    for (std::size_t m = 0; m < picked_.size(); ++m) problem_.W(m, k) = change_[axes_[picked_[m]].v];
  }
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    for (std::size_t m = 0; m < k; ++m) {
      problem_.W(m, k) = problem_.W(k, m) = 0.5 * (problem_.W(m, k) + problem_.W(k, m));
    }
  }
}

/// Adds what the answer to the problem, as impulses, does to the rates of a tree.
void AxisGuard::add_response(const Tree& tree, const GuardedMotion& motion) {
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    response_.push(axes_[picked_[k]].link, axes_[picked_[k]].v, problem_.x[k]);
  }
  response_.respond(change_);
  const std::size_t first = dynamics_.velocities() - constraints_.layout().rates;
  for (std::uint32_t j = tree.v_begin; j < tree.v_end; ++j) motion.v[first + j] += change_[j];
}

bool AxisGuard::strike(const GuardedMotion& motion) {
  bool changed = false;
  constraints_.ground_motions(bodies_, motion.at, grounds_);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double q = q_of(i, motion);
    stops_[i] = {std::min(axes_[i].lower, q), std::max(axes_[i].upper, q)};
    double& v = v_of(i, motion);
    const bool rests = axes_[i].has_friction() || at_lower(i, motion) || at_upper(i, motion);
    if (v != 0 && std::abs(v) <= kStill && rests) v = 0, changed = true;
  }
  for (const Tree& tree : constraints_.layout().trees) {
    const auto [begin, end] = range_of(tree);
    picked_.clear();
    bool any = false;
    for (std::size_t i = begin; i < end; ++i) {
      const bool lower = at_lower(i, motion), upper = at_upper(i, motion);
      if (lower || upper) picked_.push_back(i);
      any = any || (lower && v_of(i, motion) < 0) || (upper && v_of(i, motion) > 0);
    }
    if (!any) continue;
    strike_tree(tree, motion);
    changed = true;
  }
  return changed;
}

void AxisGuard::strike_tree(const Tree& tree, const GuardedMotion& motion) {
  fill_response(tree, motion);
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    const std::size_t i = picked_[k];
    const bool lower = at_lower(i, motion), upper = at_upper(i, motion);
    const double v = v_of(i, motion);
    const bool hits = (lower && v < 0) || (upper && v > 0);
    // What already leans on the stop does not bounce off it, nor do blows too weak to be worth following.
    const bool bounces = hits && !is_locked(mode(i)) && std::abs(v) > kWeakBlow;
    problem_.b[k] = bounces ? (1 + axes_[i].restitution) * v : v;
    if (!upper) problem_.lower[k] = 0;
    if (!lower) problem_.upper[k] = 0;
    if (hits && !is_locked(mode(i))) note(i, JointEventKind::StopHit, motion);
  }
  problem_.solve();
  add_response(tree, motion);
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    if (problem_.at[k] != BoxedProblem::At::Between) continue;
    const std::size_t i = picked_[k];
    double& v = v_of(i, motion);
    const double before = v - change_[axes_[i].v];
    v = before - problem_.b[k];
    if (std::abs(v) <= kStill) v = 0;
  }
}

void AxisGuard::accelerate(const GuardedMotion& motion) {
  hold(false);
  q_dot_.resize(motion.q.size());
  v_dot_.resize(motion.v.size());
  motion.system.derivative(motion.at, motion.q, motion.v, q_dot_, v_dot_);
}

void AxisGuard::decide(const GuardedMotion& motion) {
  std::copy(bodies_.state.axis_modes.begin(), bodies_.state.axis_modes.end(), before_.begin());
  bool any = false;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double v = v_of(i, motion);
    const bool rests = axes_[i].has_friction() || at_lower(i, motion) || at_upper(i, motion);
    open_[i] = v == 0 && rests && released_ != i;
    any = any || open_[i] != 0;
    if (released_ == i) continue;
    mode(i) = v == 0 || !axes_[i].has_friction() ? AxisMode::Free
              : v > 0                            ? AxisMode::SlidingForward
                                                 : AxisMode::SlidingBackward;
    if (open_[i] == 0) note_change(i, motion);
  }
  released_.reset();
  if (!any) return;
  constraints_.ground_motions(bodies_, motion.at, grounds_);
  accelerate(motion);
  for (const Tree& tree : constraints_.layout().trees) decide_tree(tree, motion);
}

void AxisGuard::decide_tree(const Tree& tree, const GuardedMotion& motion) {
  const auto [begin, end] = range_of(tree);
  picked_.clear();
  for (std::size_t i = begin; i < end; ++i) {
    if (open_[i]) picked_.push_back(i);
  }
  if (picked_.empty()) return;
  fill_response(tree, motion);
  const std::size_t first = dynamics_.velocities() - constraints_.layout().rates;
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    const Range bears = bearing(picked_[k], motion);
    problem_.b[k] = v_dot_[first + axes_[picked_[k]].v];
    problem_.lower[k] = bears.lower;
    problem_.upper[k] = bears.upper;
  }
  problem_.solve();
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    const std::size_t i = picked_[k];
    effort_of_axis_[i] = problem_.x[k];
    if (problem_.at[k] == BoxedProblem::At::Between) {
      mode(i) = at_lower(i, motion)   ? AxisMode::HeldLower
                : at_upper(i, motion) ? AxisMode::HeldUpper
                                      : AxisMode::Stuck;
    } else {
      const bool forward = problem_.at[k] == BoxedProblem::At::Lower;
      mode(i) = !axes_[i].has_friction() ? AxisMode::Free
                : forward                ? AxisMode::SlidingForward
                                         : AxisMode::SlidingBackward;
    }
    note_change(i, motion);
  }
}

void AxisGuard::hold() { hold(true); }

void AxisGuard::hold(bool locks) {
  locked_.assign(constraints_.layout().rates, 0);
  efforts_.assign(constraints_.layout().rates, 0.0);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const bool rests = bodies_.state.rates[axes_[i].v] == 0;  // unless it was edited since
    if (is_locked(mode(i))) locked_[axes_[i].v] = locks && rests ? 1 : 0;
    if (mode(i) == AxisMode::SlidingForward) efforts_[axes_[i].v] = -axes_[i].friction;
    if (mode(i) == AxisMode::SlidingBackward) efforts_[axes_[i].v] = axes_[i].friction;
  }
  constraints_.kernel().hold(locked_, efforts_);
  dynamics_.holds_have_changed();
}

void AxisGuard::let_go() {
  constraints_.kernel().hold_nothing();
  dynamics_.holds_have_changed();
}

}  // namespace pantin
