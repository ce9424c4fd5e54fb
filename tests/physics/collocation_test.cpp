#include <pantin/physics/integrators/collocation.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace pantin {
namespace {

/// sum_j a_ij c_j^k over the nodes.
double applied(const Collocation& m, std::size_t i, int k) {
  double sum = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(m.nodes); ++j) sum += m.a[j][i] * std::pow(m.c[j], k);
  return sum;
}

TEST(Collocation, HasTheNodesOfTheBooks) {
  // Two stages in closed form: Gauss (3 -+ sqrt 3) / 6, Radau IIA 1/3 and 1 (Hairer, Wanner II, tables IV.5.1
  // and IV.5.5).
  const Collocation gauss = gauss_collocation(2), radau = radau_collocation(2);
  EXPECT_NEAR(gauss.c[0], (3 - std::sqrt(3.0)) / 6, 1e-16);
  EXPECT_NEAR(gauss.a[1][0], 0.25 - std::sqrt(3.0) / 6, 1e-16);
  EXPECT_NEAR(radau.c[0], 1.0 / 3, 1e-16);
  EXPECT_NEAR(radau.a[0][0], 5.0 / 12, 1e-16);
  EXPECT_NEAR(radau.a[1][0], -1.0 / 12, 1e-16);
}

TEST(Collocation, IntegratesPolynomialsExactly) {
  // Stages: int_0^c_i x^k = c_i^(k+1) / (k+1) for k < s. The end: degree 2 s - 1 for Gauss, 2 s - 2 for
  // Radau, and no further.
  for (int s = 1; s <= kMostNodes; ++s) {
    for (const bool radau : {false, true}) {
      const Collocation m = radau ? radau_collocation(s) : gauss_collocation(s);
      for (std::size_t i = 0; i < static_cast<std::size_t>(s); ++i) {
        for (int k = 0; k < s; ++k) EXPECT_NEAR(applied(m, i, k), std::pow(m.c[i], k + 1) / (k + 1), 5e-16);
      }
      const int exact = radau ? 2 * s - 2 : 2 * s - 1;
      const auto end = [&](int k) {
        double sum = 0;
        for (std::size_t j = 0; j < static_cast<std::size_t>(s); ++j) sum += m.b[j] * std::pow(m.c[j], k);
        return sum - 1.0 / (k + 1);
      };
      for (int k = 0; k <= exact; ++k) EXPECT_NEAR(end(k), 0, 3e-16) << s << ' ' << k;
      EXPECT_GT(std::abs(end(exact + 1)), 1e-11) << s;
    }
  }
}

/// The polynomial with values x^k at the nodes, at the nodes of another step: coefficients, then their sum.
double elsewhere(const Collocation& m, const NodeMatrix& P, int k, std::size_t i) {
  const auto s = static_cast<std::size_t>(m.nodes);
  double value = 0;
  for (std::size_t n = 0; n < s; ++n) {
    double coefficient = 0;
    for (std::size_t j = 0; j < s; ++j) coefficient += m.legendre[j][n] * std::pow(m.c[j], k);
    value += P[n][i] * coefficient;
  }
  return value;
}

TEST(Collocation, ContinuesPolynomialsExactly) {
  // What lies on a polynomial of degree s - 1 stays on it in a next step of any length.
  const Collocation m = gauss_collocation(8);
  const NodeMatrix P = legendre_at_nodes(m, 1, 0.7);
  for (std::size_t i = 0; i < 8; ++i) {
    for (int k = 0; k < 8; ++k) {
      const double expected = std::pow(1 + 0.7 * m.c[i], k);
      EXPECT_NEAR(elsewhere(m, P, k, i), expected, 1e-11 * expected);  // the sum cancels
    }
  }
}

TEST(Collocation, InterpolatesPolynomialsExactly) {
  // The same from the same start: a shorter step lies on the polynomial of the longer one.
  const Collocation m = gauss_collocation(4);
  const NodeMatrix P = legendre_at_nodes(m, 0, 0.6);
  for (std::size_t i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(elsewhere(m, P, k, i), std::pow(0.6 * m.c[i], k), 1e-14);
  }
}

}  // namespace
}  // namespace pantin
