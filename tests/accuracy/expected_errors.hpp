#pragma once
// How near rk4 must come to a problem, and how that is checked.
#include <gtest/gtest.h>

#include "reference_run.hpp"

namespace pantin::test {

/// Bounds at one step h. Errors of rk4 are c h^4 with c as large as the fastest motion makes it; a bound is
/// three times the error found when it was written down (rounded up), so that a lost order, which costs a
/// factor of 10 to 1e6 at these steps, cannot hide, while another compiler's rounding can.
struct ExpectedErrors {
  double step{2e-3};                                      ///< [s]
  double position{0};                                     ///< [m]
  double attitude{0};                                     ///< [rad]
  double energy{0};                                       ///< relative
  double until{std::numeric_limits<double>::infinity()};  ///< [s]
};

/// What rounding may add over the 1e3 to 1e5 steps of a run: steps x 1e-16 x sizes up to 10.
inline constexpr double kRounding = 1e-11;

inline void expect_within(const RunErrors& errors, const ExpectedErrors& expected) {
  ASSERT_EQ(errors.failure, "");
  EXPECT_GT(errors.compared, 0u);
  EXPECT_LE(errors.position, expected.position + kRounding);
  EXPECT_LE(errors.attitude, expected.attitude + kRounding);
  EXPECT_LE(errors.energy, expected.energy + kRounding);
  // Poses are made from joint coordinates, so they miss the joints by rounding only, at any step.
  EXPECT_LE(errors.joint_drift, 1e-13);
}

}  // namespace pantin::test
