#pragma once
// The row of a coupling between numbers of two joints: with q = q_b - ratio q_a - offset,
//
//   q = 0,   q' = sum_i n_i' f_i,   n_i' = g_i . v_i,   n_i'' = g_i . v_i' + g_i' . v_i
//
// where n_i is the number, f_i its factor (1 for b, -ratio for a), v_i the rates of the link that the joint
// ties and g_i the gradient of the number by them: a unit vector, unless the tree sees the joint from its B.
// By a multiplier lambda it acts with the generalised forces f_i g_i lambda at the joints, whose work is
// lambda q' = 0.
#include <span>

#include <pantin/physics/constraints/closure.hpp>

namespace pantin {

/// Coordinates and rates of all trees, and the accelerations substituted last (empty: none).
struct CoordinateMotion {
  std::span<const double> q{}, v{}, v_dot{};
};

/// A closure with its path, which is appended to `layout.paths`, for a coupling between joints that both tie
/// a link of the same tree. `position` is the coupling's.
[[nodiscard]] Closure make_coupling(TreeLayout& layout, const JointCoupling& coupling, std::int32_t position);

/// The row of such a closure.
[[nodiscard]] ClosureRow coupling_row(const TreeLayout& layout, const Closure& closure,
                                      const CoordinateMotion& motion);

}  // namespace pantin
