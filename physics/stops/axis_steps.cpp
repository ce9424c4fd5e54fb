// Where events crowd: stops and friction at the end of short steps, all at once (velocity-level time
// stepping; J. Moreau, Unilateral contact and dry friction in finite freedom dynamics, 1988; M. Anitescu, F.
// Potra, Nonlinear Dynamics 14, 231 (1997)). Of first order; it ends whatever happens.
//
//   v* = v + h v'(q, v)      v+ = v* + M^-1 S x      q+ = q (+) h v+
//   friction  |x| <= h F  against v+            stop  x >= 0  complementary to  v+ + gap / h >= 0
#include <algorithm>
#include <cmath>

#include <pantin/physics/stops/axis_guard.hpp>
#include <pantin/physics/stops/guard_limits.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

void AxisGuard::step_over(const GuardedMotion& motion, double h, std::span<double> q_dot,
                          std::span<double> v_dot) {
  let_go();
  motion.system.derivative(motion.at, motion.q, motion.v, q_dot, v_dot);
  for (std::size_t j = 0; j < motion.v.size(); ++j) motion.v[j] += h * v_dot[j];
  constraints_.ground_motions(bodies_, motion.at, grounds_);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double q = q_of(i, motion);
    stops_[i] = {std::min(axes_[i].lower, q), std::max(axes_[i].upper, q)};
    before_[i] = mode(i);
    mode(i) = AxisMode::Free;
  }
  for (const Tree& tree : constraints_.layout().trees) step_tree(tree, motion, h);
  motion.system.rate(motion.at, motion.q, motion.v, q_dot);
  for (std::size_t j = 0; j < motion.q.size(); ++j) motion.q[j] += h * q_dot[j];
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (mode(i) == AxisMode::HeldLower) q_of(i, motion) = stops_[i].lower;
    if (mode(i) == AxisMode::HeldUpper) q_of(i, motion) = stops_[i].upper;
    if (is_locked(mode(i))) v_of(i, motion) = 0;
    const bool held = mode(i) == AxisMode::HeldLower || mode(i) == AxisMode::HeldUpper;
    if (held && !is_locked(before_[i])) note(i, JointEventKind::StopHit, motion);
    if (mode(i) == AxisMode::Stuck && !is_locked(before_[i]) && before_[i] != AxisMode::Free)
      note(i, JointEventKind::Stuck, motion);
    if (!is_locked(before_[i]) || is_locked(mode(i))) continue;
    note(i, before_[i] == AxisMode::Stuck ? JointEventKind::Slipped : JointEventKind::StopLeft, motion);
  }
  motion.system.settle({motion.at.t + h, Side::Before}, motion.q, motion.v);
}

void AxisGuard::step_tree(const Tree& tree, const GuardedMotion& motion, double h) {
  // First what friction may act on, then what comes to a stop in this step: a number may be both.
  const auto [begin, end] = range_of(tree);
  picked_.clear();
  for (std::size_t i = begin; i < end; ++i) {
    if (axes_[i].has_friction()) picked_.push_back(i);
  }
  const std::size_t frictions = picked_.size();
  const auto reaches_lower = [&](std::size_t i) {
    return q_of(i, motion) + 2 * h * std::min(0.0, v_of(i, motion)) <= stops_[i].lower;
  };
  const auto reaches_upper = [&](std::size_t i) {
    return q_of(i, motion) + 2 * h * std::max(0.0, v_of(i, motion)) >= stops_[i].upper;
  };
  for (std::size_t i = begin; i < end; ++i) {
    if (reaches_lower(i) || reaches_upper(i)) picked_.push_back(i);
  }
  if (picked_.empty()) return;
  fill_response(tree, motion);
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    const std::size_t i = picked_[k];
    const double v = v_of(i, motion);
    problem_.b[k] = v;
    if (k < frictions) {
      problem_.lower[k] = -h * axes_[i].friction;
      problem_.upper[k] = h * axes_[i].friction;
      continue;
    }
    const bool lower = reaches_lower(i), upper = reaches_upper(i);
    if (lower && upper) continue;
    (lower ? problem_.lower[k] : problem_.upper[k]) = 0;
    const double gap = q_of(i, motion) - (lower ? stops_[i].lower : stops_[i].upper);
    const bool bounces = axes_[i].restitution > 0 && std::abs(v) > kWeakBlow && !is_locked(before_[i]);
    problem_.b[k] += bounces ? axes_[i].restitution * v : gap / h;
  }
  problem_.solve();
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    response_.push(axes_[picked_[k]].link, axes_[picked_[k]].v, problem_.x[k]);
  }
  response_.respond(change_);
  const std::size_t first = dynamics_.velocities() - constraints_.layout().rates;
  for (std::uint32_t j = tree.v_begin; j < tree.v_end; ++j) motion.v[first + j] += change_[j];
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    const std::size_t i = picked_[k];
    const bool between = problem_.at[k] == BoxedProblem::At::Between;
    if (k < frictions) {
      mode(i) = between                 ? AxisMode::Stuck
                : v_of(i, motion) > 0 ? AxisMode::SlidingForward
                                        : AxisMode::SlidingBackward;
    } else if (between && !(axes_[i].restitution > 0 && std::abs(v_of(i, motion)) > kWeakBlow)) {
      mode(i) = problem_.upper[k] > 0 ? AxisMode::HeldLower : AxisMode::HeldUpper;
    }
  }
}

}  // namespace pantin
