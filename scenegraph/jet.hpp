#pragma once
// Private to scenegraph. A number that varies in time, known to second order: arithmetic on it gives the
// exact first and second time derivatives of whatever is computed. Functions written for both `double` and
// `Jet` have the same value to the last bit, because a Jet's value is computed by the same operations.
#include <cmath>

namespace pantin {

struct Jet {
  double value{0};
  double first{0};   ///< [1/s]
  double second{0};  ///< [1/s^2]

  Jet() = default;
  Jet(double constant) : value{constant} {}  // NOLINT: a constant is a number that does not vary
  Jet(double v, double v1, double v2) : value{v}, first{v1}, second{v2} {}

  Jet& operator+=(const Jet& b) { return *this = {value + b.value, first + b.first, second + b.second}; }
};

inline Jet operator-(const Jet& a) { return {-a.value, -a.first, -a.second}; }
inline Jet operator+(const Jet& a, const Jet& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}
inline Jet operator-(const Jet& a, const Jet& b) {
  return {a.value - b.value, a.first - b.first, a.second - b.second};
}
inline Jet operator*(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + 2 * a.first * b.first + a.value * b.second};
}
inline Jet operator/(const Jet& a, const Jet& b) {
  Jet q;
  q.value = a.value / b.value;
  q.first = (a.first - q.value * b.first) / b.value;
  q.second = (a.second - 2 * q.first * b.first - q.value * b.second) / b.value;
  return q;
}

inline double value_of(double x) { return x; }
inline double value_of(const Jet& x) { return x.value; }

/// f(x), given f and its first and second derivative at the value of x.
inline double composed(double, double f, double, double) { return f; }
inline Jet composed(const Jet& x, double f, double f1, double f2) {
  return {f, f1 * x.first, f1 * x.second + f2 * x.first * x.first};
}

template <class S>
S square_root(const S& x) {
  const double root = std::sqrt(value_of(x));
  return composed(x, root, 0.5 / root, -0.25 / (root * value_of(x)));
}

inline bool is_exactly(double x, double number) { return x == number; }
inline bool is_exactly(const Jet& x, double number) {
  return x.value == number && x.first == 0 && x.second == 0;
}

/// Whether x is above 0 just after (before) the time at which it has these derivatives. What is 0 to
/// round-off is judged by where it goes.
inline bool is_positive(double x, bool) { return x >= 0; }
inline bool is_positive(const Jet& x, bool before) {
  constexpr double kRoundOff = 1e-13;  // of numbers of order 1
  if (std::abs(x.value) > kRoundOff) return x.value > 0;
  if (x.first != 0) return (x.first > 0) != before;
  return x.second >= 0;
}

}  // namespace pantin
