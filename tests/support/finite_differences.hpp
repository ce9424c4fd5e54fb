#pragma once
// Central differences of sixth order (Fornberg 1988, table 1): truncation error of order h^6, round-off error
// of a few eps / h and eps / h^2. `curve(t)` gives anything that can be added and scaled.
namespace pantin::test {

template <class Curve>
auto first_difference(const Curve& curve, double t, double h) {
  using Value = decltype(curve(t));
  return Value{(curve(t + 3 * h) - curve(t - 3 * h)) * (1 / (60 * h)) -
               (curve(t + 2 * h) - curve(t - 2 * h)) * (9 / (60 * h)) +
               (curve(t + h) - curve(t - h)) * (45 / (60 * h))};
}

template <class Curve>
auto second_difference(const Curve& curve, double t, double h) {
  using Value = decltype(curve(t));
  const double unit = 1 / (180 * h * h);
  return Value{(curve(t + 3 * h) + curve(t - 3 * h)) * (2 * unit) -
               (curve(t + 2 * h) + curve(t - 2 * h)) * (27 * unit) +
               (curve(t + h) + curve(t - h)) * (270 * unit) - curve(t) * (490 * unit)};
}

}  // namespace pantin::test
