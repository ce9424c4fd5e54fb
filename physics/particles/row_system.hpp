#pragma once
// A sparse symmetric system over rows that share particles, A = J W J^T + D, solved by conjugate gradients
// with an incomplete factor of A's own pattern. Rows in order along a rope make the factor exact. Private to
// physics.
#include <cstdint>
#include <span>
#include <vector>

#include <pantin/physics/pose.hpp>

namespace pantin {

/// One scalar condition on up to four particles; its gradient by particle k is c_k g.
struct TieRow {
  std::uint32_t particle[4]{};
  double c[4]{};
  int particles{0};
  int axis{-1};  ///< 0 .. 2: the part of d along a world axis; -1: its length
  double rest{0}, compliance{0}, damping_time{0}, scale{1};
  Vector3 g{Vector3::Zero()};
};

class RowSystem {
 public:
  /// Finds which rows share particles; inverse masses by particle.
  void build(std::span<const TieRow> rows, std::span<const double> inverse_mass);
  /// A = factor * (sums of inverse masses) * (products of gradients) + diagonal.
  void assemble(std::span<const TieRow> rows, double factor, std::span<const double> diagonal);
  /// Solves A x = b to |b - A x| <= tolerance |b|; returns the iterations taken.
  int solve(std::span<const double> b, std::span<double> x, double tolerance, int most);
  /// Sum of c^2 w of a row.
  [[nodiscard]] double inverse_mass(std::size_t row) const { return share_[begin_[row + 1] - 1]; }

 private:
  void factorise();
  void multiply(std::span<const double> x, std::span<double> y) const;
  void precondition(std::span<const double> r, std::span<double> z) const;

  std::vector<std::uint32_t> begin_{}, column_{};     // lower triangle by rows, the diagonal last in each
  std::vector<double> share_{}, value_{}, factor_{};  // sums of c_i c_j w; A; L
  std::vector<double> r_{}, z_{}, p_{}, Ap_{};
};

}  // namespace pantin
