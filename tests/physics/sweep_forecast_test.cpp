#include <pantin/physics/integrators/sweep_forecast.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace pantin {
namespace {

/// The series of one number's slope, given as a function of time in steps of length one.
struct Series {
  Series(const Collocation& of, const std::function<double(double)>& slope) : method{of} {
    sizes.stages = method.nodes;
    for (std::size_t k = 0; k < count(); ++k) {
      for (std::size_t j = 0; j < count(); ++j) coefficients[k] += method.legendre[j][k] * slope(method.c[j]);
      sizes.q[k] = std::abs(coefficients[k]);
    }
  }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(method.nodes); }
  /// How far the sum by these polynomials is off at the nodes of the next step, at most.
  [[nodiscard]] double error(const NodeMatrix& P, const std::function<double(double)>& slope) const {
    double most = 0;
    for (std::size_t i = 0; i < count(); ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < count(); ++k) sum += P[k][i] * coefficients[k];
      most = std::max(most, std::abs(sum - slope(1 + method.c[i])));
    }
    return most;
  }

  Collocation method{};
  std::array<double, kMostNodes> coefficients{};
  SeriesSizes sizes{};
};

TEST(SweepForecast, ContinuesAllOfASmoothMotion) {
  // Terms of an entire function fall off beyond the step, too, where it is short: nothing is broken off. The
  // second function is even about the middle of the step: every other coefficient vanishes.
  for (const auto& slope :
       {std::function<double(double)>{[](double t) { return std::sin(0.4 * t + 0.1); }},
        std::function<double(double)>{[](double t) { return std::cos(0.4 * (t - 0.5)); }}}) {
    const Series series{gauss_collocation(8), slope};
    EXPECT_EQ(continuation(series.method, series.sizes, 1, 1), legendre_at_nodes(series.method, 1, 1));
    EXPECT_LT(series.error(continuation(series.method, series.sizes, 1, 1), slope), 1e-5);
  }
}

TEST(SweepForecast, BreaksOffWhereAPoleIsNear) {
  // Poles at 0.5 +- 0.3 i: the series converges in the step and diverges beyond it.
  const auto slope = [](double t) { return 1 / (1 + (t - 0.5) * (t - 0.5) / 0.09); };
  const Series series{gauss_collocation(8), slope};
  const double whole = series.error(legendre_at_nodes(series.method, 1, 1), slope),
               broken_off = series.error(continuation(series.method, series.sizes, 1, 1), slope);
  EXPECT_GT(whole, 100);
  EXPECT_LT(broken_off, 1);
}

TEST(SweepForecast, LengthensStepsThatSettleAtOnce) {
  SeriesSizes rest;
  rest.stages = 8;
  EXPECT_EQ(cheapest_ratio(rest, {.sweeps = 1}, 1, 1e-8), 2);
  const Series calm{gauss_collocation(8), [](double t) { return std::sin(0.1 * t); }};
  EXPECT_EQ(cheapest_ratio(calm.sizes, {.sweeps = 3, .first = 1e-4, .last = 1e-9}, 1, 1e-8), 2);
}

TEST(SweepForecast, ShortensStepsThatHardlySettle) {
  const Series wild{gauss_collocation(8), [](double t) { return 1 / (1 + (t - 0.5) * (t - 0.5) / 0.09); }};
  EXPECT_LT(cheapest_ratio(wild.sizes, {.sweeps = 12, .first = 1, .last = 0.01}, 1, 1e-2), 1);
  // Few sweeps are no reason to shorten a step.
  EXPECT_EQ(cheapest_ratio(wild.sizes, {.sweeps = 8, .first = 1, .last = 0.01}, 1, 1e-2), 1);
  // The better sweeps contract, the longer may a step be.
  double before = 0;
  for (const double last : {1e-1, 1e-3, 1e-6, 1e-9}) {
    const double ratio = cheapest_ratio(wild.sizes, {.sweeps = 5, .first = 1, .last = last}, 1, 1e-9);
    EXPECT_GE(ratio, before) << last;
    before = ratio;
  }
}

}  // namespace
}  // namespace pantin
