#pragma once
// Multipliers of closures: what must act in the cut joints of loops so that they hold. With J the rows, M the
// inertia of the tree and b what the rows lack,
//
//   W lambda = b,   W = J M^-1 J^T = Y^T D^-1 Y,
//
// where Y is what a row's unit wrenches leave at the joints on their way to the ground (Articulated::reduce),
// D the joints' own inertia. Rows of rotors add 1 / armature on the diagonal: they act by what they resist.
// Rows are scaled to what W_ii would be were every lever at its best (not to W_ii, which vanishes where a
// loop is singular). Loops may be redundant and pass through singular positions, so W need not have an
// inverse: the proximal solve (proximal.hpp; N. Parikh, S. Boyd, Proximal Algorithms, 2014, 4.1; J.
// Carpentier, R. Budhiraja, N. Mansard, Proximal and Sparse Resolution of Constrained Dynamic Equations, RSS
// 2021) leaves a part (mu / (mu + s))^5 of what belongs to a singular value s of W; the motion is unique, the
// multipliers are the smallest. W is stored and factored within its envelope, so that a chain of loops costs
// what its loops cost.
#include <vector>

#include <pantin/physics/constraints/closure.hpp>
#include <pantin/physics/constraints/coupling_row.hpp>
#include <pantin/physics/constraints/row_layout.hpp>

namespace pantin {

/// What b says the rows lack.
enum class ClosureLevel { Position, Velocity, Acceleration };

/// Work space and verbs on the closures of one tree at a time. Nothing is allocated after resize.
class ClosureSolver {
 public:
  void resize(const TreeLayout& layout);
  [[nodiscard]] const RowLayout& row_layout() const noexcept { return at_; }

  /// Rows of the tree as placed, accelerations as last substituted; `motion` is what it was placed with.
  void measure(const TreeLayout& layout, const Tree& tree, const Articulated& kernel,
               std::span<const RigidMotion> grounds, Instant at, const CoordinateMotion& motion);
  /// Multipliers for the tree as measured, with the factor that the kernel holds.
  void factor(const TreeLayout& layout, const Tree& tree, const Articulated& kernel);
  /// Solves for multipliers, and adds what they leave at the joints to the kernel's right-hand side: the next
  /// substitution feels them.
  void solve(const TreeLayout& layout, const Tree& tree, ClosureLevel level, Articulated& kernel);

  /// Rotors of cut joints in a velocity solve: remembers how they turn in the tree as measured, and makes
  /// what has changed since, in the tree as measured then, what their rows lack.
  void keep_rotor_rates(const Tree& tree);
  void compare_rotor_rates(const Tree& tree);

  /// How far the tree as factored last is from a position in which rows that are independent elsewhere depend
  /// on each other: the least pivot that is not one of rows which always do, 1 where there are none.
  [[nodiscard]] double margin(const Tree& tree) const;

  /// Greatest gap over its rounding: up to one it is nothing but rounding.
  [[nodiscard]] double gap_in_roundings(const Tree& tree) const;
  /// The same of the rates of gaps.
  [[nodiscard]] double rate_in_roundings(const Tree& tree) const;
  /// Sum of the squares of all gaps [m^2] or [rad^2].
  [[nodiscard]] double gap_squared(const Tree& tree) const;

  [[nodiscard]] std::span<const ClosureRow> rows(std::uint32_t closure) const;
  /// Generalised force by which a coupling acts on its b, by the last multipliers [N m] or [N].
  [[nodiscard]] double effort(std::uint32_t closure) const { return multiplier_[at_.places[closure].row]; }
  /// Force at Jb's origin and torque on B of a closure by the last multipliers.
  [[nodiscard]] ClosureWrench wrench(std::uint32_t closure) const;

 private:
  void assemble(const TreeLayout& layout, const Tree& tree, const Articulated& kernel);
  void assemble_block(const TreeLayout& layout, std::uint32_t c, std::uint32_t d, const Articulated& kernel);
  [[nodiscard]] Proximal<double> proximal(const Tree& tree);

  RowLayout at_{};
  std::vector<ClosureRow> rows_{};
  std::vector<double> y_{}, W_{}, K_{};
  std::vector<Articulated::Passing> passing_{};
  std::vector<double> scale_{}, mu_{}, b_{}, lambda_{}, residual_{}, multiplier_{}, turned_{};
};

}  // namespace pantin
