#pragma once
// A reference solution by a method that shares nothing with the integrators under test: extrapolation of
// Gragg's modified midpoint rule (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.9),
// order 16, on steps so short that only rounding is left.
#include <array>
#include <cmath>

#include <support/toy_dynamics.hpp>

namespace pantin::test {

/// The state after `duration` [s] from `start` at t = 0, to about 1e-13 for motions with frequencies of order
/// one.
inline State tight_solution(Dynamics& dynamics, const State& start, double duration, int steps = 40) {
  using Vector = Eigen::VectorXd;
  const std::size_t nq = start.q.size(), nv = start.v.size();
  const auto f = [&](double t, const Vector& y) {
    Vector slope(y.size());
    dynamics.derivative({t, Side::After}, {y.data(), nq}, {y.data() + nq, nv}, {slope.data(), nq},
                        {slope.data() + nq, nv});
    return slope;
  };
  Vector y(static_cast<Eigen::Index>(nq + nv));
  std::copy(start.q.begin(), start.q.end(), y.data());
  std::copy(start.v.begin(), start.v.end(), y.data() + nq);
  const double H = duration / steps;
  for (int step = 0; step < steps; ++step) {
    const double t = step * H;
    std::array<Vector, 8> row{};  // of the table of extrapolation, from h^2 to h^16
    for (int j = 0; j < 8; ++j) {
      const int n = 2 * (j + 1);
      const double h = H / n;
      Vector before = y, now = y + h * f(t, y);
      for (int m = 1; m < n; ++m) {
        const Vector next = before + 2 * h * f(t + m * h, now);
        before = now;
        now = next;
      }
      Vector value = 0.5 * (now + before + h * f(t + H, now));
      for (int k = 0; k < j; ++k) {
        const double ratio = static_cast<double>(j + 1) / (j - k);
        const Vector better = value + (value - row[static_cast<std::size_t>(k)]) / (ratio * ratio - 1);
        row[static_cast<std::size_t>(k)] = value;
        value = better;
      }
      row[static_cast<std::size_t>(j)] = value;
    }
    y = row[7];
    dynamics.settle({t + H, Side::Before}, {y.data(), nq}, {y.data() + nq, nv});
  }
  return {{y.data(), y.data() + nq}, {y.data() + nq, y.data() + nq + nv}};
}

}  // namespace pantin::test
