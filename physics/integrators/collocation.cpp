#include <pantin/physics/integrators/collocation.hpp>

#include <cmath>
#include <string>

#include <pantin/physics/expects.hpp>

namespace pantin {

namespace {

// Extended precision, so that what is kept is right to the last bit or two.
using Real = long double;
using Values = std::array<Real, kMostNodes + 1>;

/// P_0 to P_n at x in [0, 1].
Values legendre_at(Real x, int n) {
  Values P{1, 2 * x - 1};
  for (int k = 1; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    P[i + 1] = ((2 * k + 1) * (2 * x - 1) * P[i] - k * P[i - 1]) / (k + 1);
  }
  return P;
}

/// Whose roots the nodes are: P_n of Gauss, P_n - P_n-1 of Radau, which is 0 at the end of the step.
Real node_polynomial(Real x, int n, bool radau) {
  const Values P = legendre_at(x, n);
  const auto i = static_cast<std::size_t>(n);
  return radau ? P[i] - P[i - 1] : P[i];
}

/// The n roots in (0, 1], ascending: each lies alone between two neighbours of a grid fine enough.
std::array<Real, kMostNodes> roots(int n, bool radau) {
  std::array<Real, kMostNodes> found{};
  int count = 0;
  constexpr int kGrid = 1000;
  for (int i = 0; i < kGrid && count < n; ++i) {
    Real low = (i + Real(1) / 3) / kGrid, high = (i + Real(4) / 3) / kGrid;
    const Real at_low = node_polynomial(low, n, radau);
    if (at_low * node_polynomial(high, n, radau) > 0) continue;
    for (int halving = 0; halving < 70; ++halving) {
      const Real middle = (low + high) / 2;
      (node_polynomial(middle, n, radau) * at_low > 0 ? low : high) = middle;
    }
    found[static_cast<std::size_t>(count++)] = (low + high) / 2;
  }
  if (radau) found[static_cast<std::size_t>(n - 1)] = 1;
  return found;
}

/// Coefficient of x^k in P_m.
Real legendre_power(int m, int k) {
  Real value = (m + k) % 2 == 0 ? 1 : -1;  // times (m + k)! / ((m - k)! k!^2)
  for (int i = 1; i <= k; ++i) value *= static_cast<Real>((m + i) * (m - i + 1)) / (i * i);
  return value;
}

Collocation collocation(int n, bool radau) {
  PANTIN_EXPECTS(n >= 1 && n <= kMostNodes, "number of nodes is " + std::to_string(n) + "; give 1 to 8");
  Collocation method;
  method.nodes = n;
  const auto size = static_cast<std::size_t>(n);
  const std::array<Real, kMostNodes> c = roots(n, radau);
  std::array<Values, kMostNodes> P{};
  std::array<Real, kMostNodes> b{};
  for (std::size_t i = 0; i < size; ++i) {
    P[i] = legendre_at(c[i], n);
    // 1 / sum (2k+1) P_k^2 over k < n: the weight of a node, from the exactness for products.
    Real sum = 0;
    for (std::size_t k = 0; k < size; ++k) sum += static_cast<Real>(2 * k + 1) * P[i][k] * P[i][k];
    b[i] = 1 / sum;
  }
  for (std::size_t j = 0; j < size; ++j) {
    method.c[j] = static_cast<double>(c[j]);
    method.b[j] = static_cast<double>(b[j]);
    for (std::size_t k = 0; k < size; ++k)
      method.legendre[j][k] = static_cast<double>(static_cast<Real>(2 * k + 1) * b[j] * P[j][k]);
    for (std::size_t i = 0; i < size; ++i) {
      Real sum = c[i];  // k = 0
      for (std::size_t k = 1; k < size; ++k) sum += P[j][k] * (P[i][k + 1] - P[i][k - 1]) / 2;
      method.a[j][i] = static_cast<double>(b[j] * sum);
    }
    for (int k = 0; k < n; ++k) {
      Real sum = 0;
      for (int m = k; m < n; ++m)
        sum += static_cast<Real>(2 * m + 1) * P[j][static_cast<std::size_t>(m)] * legendre_power(m, k);
      method.powers[static_cast<std::size_t>(k)][j] = static_cast<double>(b[j] * sum / (k + 1));
    }
  }
  return method;
}

}  // namespace

Collocation gauss_collocation(int nodes) { return collocation(nodes, false); }
Collocation radau_collocation(int nodes) { return collocation(nodes, true); }

NodeMatrix legendre_at_nodes(const Collocation& method, double start, double ratio) {
  NodeMatrix P{};
  std::array<double, kMostNodes> x{};  // in [-1, 1] where P_k has its usual form
  for (std::size_t i = 0; i < kMostNodes; ++i) x[i] = 2 * (start + ratio * method.c[i]) - 1;
  P[0].fill(1);
  if (method.nodes > 1) P[1] = x;
  for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(method.nodes); ++k) {
    const double n = static_cast<double>(k), up = (2 * n + 1) / (n + 1), back = n / (n + 1);
    for (std::size_t i = 0; i < kMostNodes; ++i) P[k + 1][i] = up * x[i] * P[k][i] - back * P[k - 1][i];
  }
  return P;
}

}  // namespace pantin
