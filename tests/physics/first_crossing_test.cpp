#include <pantin/physics/stops/first_crossing.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pantin {
namespace {

/// Coefficients of s * product (x - roots).
std::vector<double> with_roots(double s, std::initializer_list<double> roots) {
  std::vector<double> c{s};
  for (const double root : roots) {
    c.push_back(0);
    for (std::size_t k = c.size(); k-- > 0;) c[k] = (k > 0 ? c[k - 1] : 0) - root * c[k];
  }
  return c;
}

TEST(FirstCrossing, FindsTheFirstOfSeveral) {
  // Polynomials are made of their roots; from below zero the first crossing is the least root within [0, 1],
  // also where the next is only 1e-5 away, so that samples would miss both.
  EXPECT_NEAR(first_above_zero(with_roots(1, {0.3})).value(), 0.3, 1e-15);
  EXPECT_NEAR(first_above_zero(with_roots(-1, {0.61800, 0.61801})).value(), 0.618, 1e-10);
  EXPECT_NEAR(first_above_zero(with_roots(1, {0.2, 0.5, 0.9, 1.5, 2})).value(), 0.2, 1e-13);
  EXPECT_NEAR(first_above_zero(with_roots(1, {0.25, -1, -0.5})).value(), 0.25, 1e-14);
}

TEST(FirstCrossing, FindsNoneWhereThereIsNone) {
  // Below zero throughout; touching zero from below; crossing outside of [0, 1] only; coming down from zero.
  EXPECT_FALSE(first_above_zero(with_roots(1, {1.5})));
  EXPECT_FALSE(first_above_zero(with_roots(1, {-0.1, 1.1})));
  EXPECT_FALSE(first_above_zero(std::vector<double>{-1, 0, 0, 0}));
  EXPECT_FALSE(first_above_zero(std::vector<double>{0, -1, 0.5}));
  EXPECT_FALSE(first_above_zero(std::vector<double>{0, 0, 0}));
}

TEST(FirstCrossing, BeginsAboveOrAtZero) {
  // Above zero at 0 it is 0; at zero and rising it is at once, to the finest halving.
  EXPECT_EQ(first_above_zero(std::vector<double>{1e-300, -1}).value(), 0);
  EXPECT_LT(first_above_zero(std::vector<double>{0, 1}).value(), 1e-14);
  // At zero, falling, rising again: x (x - 0.5).
  EXPECT_NEAR(first_above_zero(with_roots(1, {0, 0.5})).value(), 0.5, 1e-15);
}

}  // namespace
}  // namespace pantin
