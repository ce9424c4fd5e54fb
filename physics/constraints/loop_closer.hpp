#pragma once
// Brings trees with closures to where their loops are closed, by the shortest way that their inertia knows:
//   positions   dq = -M^-1 J^T W^+ gap, repeated (Gauss-Newton in the metric of M)
//   rates       dv = -M^-1 J^T W^+ (J v)
// Gravity and other loads play no part. E. Hairer, G. Wanner, Solving Ordinary Differential Equations II,
// VII.2.
#include <vector>

#include <pantin/physics/constraints/closure_solver.hpp>

namespace pantin {

/// What a tree moves in: all by reference, for the time of a call.
struct TreeView {
  const TreeLayout& layout;
  const Tree& tree;
  Articulated& kernel;
  std::span<const RigidMotion> grounds;  ///< by body position
  Instant at;
};

/// The closure that is farthest from closed, and by how much.
struct OpenLoop {
  std::int32_t joint{-1};     ///< position; -1 = all are closed
  std::int32_t coupling{-1};  ///< position, if it is a coupling that is not met
  double gap{0};              ///< [m] or [rad]
};

class LoopCloser {
 public:
  void resize(const TreeLayout& layout);
  [[nodiscard]] ClosureSolver& solver() noexcept { return solver_; }
  [[nodiscard]] const ClosureSolver& solver() const noexcept { return solver_; }

  /// Coordinates and rates (of all trees) that a step has left with gaps of the size of its errors. What is
  /// closed but for rounding is not touched. Allocates nothing.
  void settle(const TreeView& view, std::span<double> q, std::span<double> v);
  /// Coordinates that may be far off. False if no way is found; q is then the nearest that was.
  [[nodiscard]] bool close(const TreeView& view, std::span<double> q);
  /// Rates, at coordinates that are closed. False if no rates meet all rows.
  [[nodiscard]] bool project(const TreeView& view, std::span<const double> q, std::span<double> v);
  /// Takes from a change of rates at q what the loops do not allow: what settling would take away again.
  void make_tangential(const TreeView& view, std::span<const double> q, std::span<double> change);
  /// What is open in a tree as measured last by more than files' and steps' imprecision (1e-7 of sizes).
  [[nodiscard]] OpenLoop open_loop(const TreeLayout& layout, const Tree& tree) const;

 private:
  void look(const TreeView& view, std::span<const double> q, std::span<const double> v);
  void factor(const TreeView& view);
  void step(const TreeView& view, ClosureLevel level);
  static void move(const TreeView& view, std::span<double> q, double part, std::span<const double> change);
  bool search(const TreeView& view, std::span<double> q, double before);

  ClosureSolver solver_{};
  std::vector<double> change_{}, still_{}, kept_{}, driven_{};
};

}  // namespace pantin
