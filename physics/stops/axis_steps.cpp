// Where events crowd: which numbers rest and which slide over a short step is decided at once, at its begin,
// from where the step would end (velocity-level time stepping; J. Moreau, Unilateral contact and dry friction
// in finite freedom dynamics, 1988; M. Anitescu, F. Potra, Nonlinear Dynamics 14, 231 (1997)):
//
//   w = v + h v'(q, v) + M^-1 S x       friction  |x| <= h F  against w       at a stop  x >= 0, w >= 0
//
// What comes to rest by it does so now, by impulses that only take energy, and is locked for the step; what
// slides is braked by its friction. Of first order.
#include <algorithm>
#include <cmath>

#include <pantin/physics/stops/axis_guard.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

bool AxisGuard::decide_over(const GuardedMotion& motion, double h) {
  constraints_.ground_motions(bodies_, motion.at, grounds_);
  std::copy(bodies_.state.axis_modes.begin(), bodies_.state.axis_modes.end(), before_.begin());
  std::fill(bodies_.state.axis_modes.begin(), bodies_.state.axis_modes.end(), AxisMode::Free);
  accelerate(motion);
  bool changed = false;
  for (const Tree& tree : constraints_.layout().trees) {
    const auto [begin, end] = range_of(tree);
    picked_.clear();
    for (std::size_t i = begin; i < end; ++i) {
      if (axes_[i].has_friction() || at_lower(i, motion) || at_upper(i, motion)) picked_.push_back(i);
    }
    if (picked_.empty()) continue;
    foresee(tree, motion, h);
    changed = bring_to_rest(tree, motion) || changed;
  }
  released_.reset();
  return changed;
}

/// Modes of the axes picked, by where a step of h would end.
void AxisGuard::foresee(const Tree& tree, const GuardedMotion& motion, double h) {
  fill_response(tree, motion);
  const std::size_t first = dynamics_.velocities() - constraints_.layout().rates;
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    const Range bears = bearing(picked_[k], motion);
    problem_.b[k] = v_of(picked_[k], motion) + h * v_dot_[first + axes_[picked_[k]].v];
    problem_.lower[k] = h * bears.lower;
    problem_.upper[k] = h * bears.upper;
  }
  problem_.solve();
  for (std::size_t k = 0; k < picked_.size(); ++k) {
    const std::size_t i = picked_[k];
    if (problem_.at[k] == BoxedProblem::At::Between) {
      mode(i) = at_lower(i, motion)   ? AxisMode::HeldLower
                : at_upper(i, motion) ? AxisMode::HeldUpper
                                      : AxisMode::Stuck;
    } else if (axes_[i].has_friction()) {
      const double v = v_of(i, motion);
      const bool forward = v > 0 || (v == 0 && problem_.at[k] == BoxedProblem::At::Lower);
      mode(i) = forward ? AxisMode::SlidingForward : AxisMode::SlidingBackward;
    }
    note_change(i, motion);
  }
}

/// Impulses that stop what is locked from here. Whether there were any.
bool AxisGuard::bring_to_rest(const Tree& tree, const GuardedMotion& motion) {
  std::erase_if(picked_, [this](std::size_t i) { return !is_locked(mode(i)); });
  if (std::all_of(picked_.begin(), picked_.end(), [&](std::size_t i) { return v_of(i, motion) == 0; })) {
    return false;
  }
  fill_response(tree, motion);
  for (std::size_t k = 0; k < picked_.size(); ++k) problem_.b[k] = v_of(picked_[k], motion);
  problem_.solve();
  add_response(tree, motion);
  for (const std::size_t i : picked_) v_of(i, motion) = 0;
  return true;
}

}  // namespace pantin
