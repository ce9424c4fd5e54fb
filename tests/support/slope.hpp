#pragma once
// Numerical derivatives, as oracles for exact ones.

namespace pantin::test {

/// Central difference of fourth order: truncation h^4 / 30 times the fifth derivative, rounding some 1e-16 /
/// h.
template <class F>
auto slope(F f, double t, double h) -> decltype(f(t)) {
  return ((f(t - 2 * h) - f(t + 2 * h)) + 8 * (f(t + h) - f(t - h))) / (12 * h);
}

}  // namespace pantin::test
