#pragma once
// Private to the integrators. Solves (1 - s J) x = b, group by group, by LU. Rows are scaled by their
// greatest entry, so that pivots are chosen by direction, not by stiffness, and the diagonal is kept where it
// is not much smaller: of a group that lists coordinates before velocities, q' = B v then costs next to
// nothing, and the work is that of the velocities alone (I. S. Duff, A. M. Erisman, J. K. Reid, Direct
// Methods for Sparse Matrices, 2nd ed., 7.4).
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <pantin/physics/integrators/jacobian.hpp>

namespace pantin {

class GroupSolver {
 public:
  /// Factors again as many numbers, in groups of the same sizes, without allocating. `scale` (> 0): the size
  /// of each number; x and b are in units of it. Empty: all are one.
  void factor(const Jacobian& J, double s, std::span<const double> scale = {});
  /// From b to x, of what was factored last.
  void solve(const Jacobian& J, std::span<double> x);

 private:
  /// A group's part of the arrays below, k numbers.
  struct Part {
    std::size_t k{0};
    std::span<double> matrix{};  ///< by columns; then L below, U above, one over the pivots on the diagonal
    std::span<double> row{};     ///< one over the greatest entry of each
    std::span<std::uint32_t> pivot{};
  };
  /// Calls visit(part, numbers of the group) group by group.
  template <class Visit>
  void for_each_part(const Jacobian& J, const Visit& visit);
  static void scale_rows(const Part& part);
  static void decompose(const Part& part);
  static void substitute(const Part& part, std::span<double> x);

  std::vector<double> matrices_{}, rows_{}, inverse_scale_{}, x_{};
  std::vector<std::uint32_t> pivots_{};
};

}  // namespace pantin
