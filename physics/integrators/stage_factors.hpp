#pragma once
// Private to the integrators. The implicit parts of the stages of a step,
//
//   (1 - h g_i (J + sum_r b_r c_r^T)) x = r,
//
// J = df/dy at the begin of the step for all of them. Forces that act along lines (LineStiffness) may be left
// out of it: each of them is then a row of its own at each stage, whose effort changes by c_r . x =
// stiffness (stretch by q) . x_q + damping (rate by v) . x_v and changes v' by b_r. However stiff they are,
// what is solved turns with the motion. A few rows cost little beside the factor of J (M. A. Woodbury,
// Inverting modified matrices, 1950):  x = x_0 + sum_r s_r z_r,  (1 - C S) z = C x_0.
#include <array>
#include <span>
#include <vector>

#include <pantin/physics/integrators/group_solver.hpp>
#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

class StageFactors {
 public:
  static constexpr std::size_t kStages = 4;
  static constexpr std::size_t kMostLines = 64;

  explicit StageFactors(const std::array<double, kStages>& diagonal) : diagonal_{diagonal} {}

  /// For another call, or system.
  void begin(Dynamics& dynamics);
  /// Whether there are lines to be left out of J, and not too many.
  [[nodiscard]] bool has_lines() const noexcept { return !lines_.empty() && lines_.size() <= kMostLines; }
  /// Takes J at a state, f there; with the forces along lines, or beside them.
  void take(Instant at, double h, std::span<const double> y, std::span<const double> f, bool beside_lines);
  /// Factors, if J or h are others than before.
  void factor(double h);
  /// Where J is beside them: lays the lines at the stages, whose derivative is known.
  void place_lines(const Stages& stages);
  void solve(std::size_t stage, std::span<double> x);
  [[nodiscard]] bool are_beside_lines() const noexcept { return beside_lines_; }

 private:
  [[nodiscard]] double effort(std::size_t line, std::size_t stage, std::span<const double> x) const;
  void add_lines(std::size_t stage, std::span<double> x);

  std::array<double, kStages> diagonal_;
  Dynamics* dynamics_{nullptr};
  std::size_t nq_{0}, nv_{0};
  Jacobian J_{};
  std::array<GroupSolver, kStages> solvers_{};
  double factored_for_{0};  ///< step [s]; 0 = none
  std::vector<double> change_{};

  bool beside_lines_{false};
  std::span<const LineStiffness> lines_{};
  std::vector<double> by_q_{}, by_v_{}, response_{};  ///< as LineStages
  std::vector<double> S_{}, z_{};                     ///< of one stage; S by columns
  Jacobian coupling_{};                               ///< C S, as if it were one group
  GroupSolver coupled_{};
};

}  // namespace pantin
