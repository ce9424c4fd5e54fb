#pragma once
// Private to the integrators. Solves z = y + s f(z) for stiff f by Newton's method. Its linear systems are
// solved whole where the numbers that touch each other are few, by GMRES with directional differences where
// they are many (D. A. Knoll, D. E. Keyes, J. Comp. Phys. 193, 357 (2004), 2.2).
#include <span>
#include <vector>

#include <pantin/physics/integrators/group_solver.hpp>

namespace pantin {

/// The function f.
class SlopeFunction {
 public:
  virtual ~SlopeFunction() = default;
  virtual void evaluate(std::span<const double> z, std::span<double> slope) = 0;
  /// As of Dynamics.
  virtual void list_groups(NumberGroups& groups) = 0;
  /// df/dz at z, where f is `slope`; `change` is a small one of each number.
  virtual void jacobian(std::span<const double> z, std::span<const double> slope,
                        std::span<const double> change, Jacobian& J) = 0;
};

/// Keeps its work space: solving again for as many numbers allocates nothing.
class NewtonKrylov {
 public:
  /// Improves z from its present value until the equation holds to round-off; false if it does not get there.
  /// `scale` (> 0): the size of each number, against which round-off is judged.
  [[nodiscard]] bool solve(SlopeFunction& f, double s, std::span<const double> y,
                           std::span<const double> scale, std::span<double> z);

 private:
  void reserve(SlopeFunction& f, std::size_t n);
  /// z - y - s f(z) over scale, into residual_; its greatest entry.
  double residual(SlopeFunction& f, double s, std::span<const double> y, std::span<const double> scale,
                  std::span<const double> z);
  /// The whole matrix, at z.
  void factor(SlopeFunction& f, double s, std::span<const double> scale, std::span<const double> z);
  /// The step in units of scale that takes the residual away to first order, into step_.
  void whole_direction();
  void krylov_direction(SlopeFunction& f, double s, std::span<const double> scale, std::span<const double> z);
  /// column[k + 1] = (1 - s f') column[k].
  void apply(SlopeFunction& f, double s, std::span<const double> scale, std::span<const double> z,
             std::size_t k);
  void back_substitute(std::size_t columns);
  [[nodiscard]] std::span<double> basis(std::size_t k) { return std::span{basis_}.subspan(k * n_, n_); }

  std::size_t n_{0}, most_columns_{0};
  bool is_whole_{false};
  std::vector<double> slope_{}, residual_{}, trial_{}, trial_slope_{}, step_{}, basis_{};
  Jacobian J_{};
  GroupSolver solver_{};
  std::vector<double> hessenberg_{}, cosine_{}, sine_{}, right_{};
};

}  // namespace pantin
