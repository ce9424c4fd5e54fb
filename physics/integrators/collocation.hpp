#pragma once
// Collocation methods: the polynomials that satisfy y' = f at s nodes of a step. Values at the nodes and
// coefficients of Legendre polynomials go into each other by sums over the nodes, because the quadrature that
// belongs to the nodes is exact for products of two such polynomials.
//   a_ij = b_j sum_k (2k+1) P_k(c_j) int_0^c_i P_k,   int_0^x P_k = (P_k+1(x) - P_k-1(x)) / (2 (2k+1))
// with P_k the Legendre polynomials shifted to [0, 1]. E. Hairer, G. Wanner, Solving Ordinary Differential
// Equations II, 2nd ed., IV.5.
#include <array>

namespace pantin {

/// At most this many nodes.
constexpr int kMostNodes = 8;

/// Row by column; rows that are read together lie together.
using NodeMatrix = std::array<std::array<double, kMostNodes>, kMostNodes>;

struct Collocation {
  int nodes{0};
  std::array<double, kMostNodes> c{};  ///< nodes, ascending in (0, 1]
  std::array<double, kMostNodes> b{};  ///< weights: the end of the step is y + h sum b_j f_j
  NodeMatrix a{};                      ///< by column: a[j][i] is a_ij
  NodeMatrix legendre{};               ///< by column: coefficient k is sum_j legendre[j][k] f_j
  /// By row: y(x h) = y_0 + h sum_k x^(k+1) sum_j powers[k][j] f_j inside the step, 0 <= x <= 1.
  NodeMatrix powers{};
};

/// Gauss-Legendre: order 2 s, symmetric and symplectic; 1 to 8 nodes.
[[nodiscard]] Collocation gauss_collocation(int nodes);
/// Radau IIA: order 2 s - 1, the last node at the end of the step; L-stable; 1 to 8 nodes.
[[nodiscard]] Collocation radau_collocation(int nodes);

/// Legendre polynomials of one step at the nodes of another, `ratio` times as long, that begins where `start`
/// of the first has passed (1: the next one): by column, a[k][i] is P_k(start + ratio c_i).
[[nodiscard]] NodeMatrix legendre_at_nodes(const Collocation& method, double start, double ratio);

}  // namespace pantin
