#pragma once
// The first place in [0, 1] at which a polynomial rises above zero.
#include <optional>
#include <span>

namespace pantin {

constexpr std::size_t kMostDegree = 15;

/// Of sum_k c_k x^k, with at most kMostDegree + 1 coefficients: to rounding, none missed however near two
/// crossings are; 0 where it is above zero there. In Bernstein form a polynomial without positive
/// coefficients is nowhere above zero, and halves are as easily had (R. Farouki, The Bernstein polynomial
/// basis: a centennial retrospective, Computer Aided Geometric Design 29 (2012), 379).
[[nodiscard]] std::optional<double> first_above_zero(std::span<const double> c);

}  // namespace pantin
