#include <pantin/physics/integrators/series_tail.hpp>

#include <gtest/gtest.h>

namespace pantin {
namespace {

TEST(SeriesTail, ContinuesAGeometricSeries) {
  // Coefficients 0.1^k: of number s - 1 = 3, number 2 s = 8 is 1e-5.
  const SeriesTail tail = tail_of({1e-3, 1e-2, 1e-1, 1}, 4, 1e-16);
  EXPECT_EQ(tail.back, 0);
  EXPECT_NEAR(tail.share, 1e-5, 1e-18);
}

TEST(SeriesTail, LooksPastACoefficientThatSymmetryMakesVanish) {
  // Every other coefficient is zero: the last one left is number s - 2, one place further from number 2 s.
  const SeriesTail tail = tail_of({0, 1e-2, 0, 1}, 4, 1e-16);
  EXPECT_EQ(tail.back, 1);
  EXPECT_NEAR(tail.share, 1e-6, 1e-18);
}

TEST(SeriesTail, RoundingIsNoError) {
  // Coefficients below the noise say nothing of what is left out.
  EXPECT_EQ(tail_of({1e-17, 1e-17, 1e-9, 1}, 8, 1e-15).share, 0);
}

}  // namespace
}  // namespace pantin
