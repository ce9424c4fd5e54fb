#include <gtest/gtest.h>

#include <limits>
#include <support/random_affine.hpp>

namespace pantin {
namespace {

TEST(Matrix34, KeepsRowsInOrder) {
  // Entry (row, column) of the matrix stands at 4 * row + column: the definition of row-major.
  Affine M = Affine::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) M(row, column) = 10 * row + column;
  const Matrix34 stored = Matrix34::from(M);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(stored.m[i], 10 * double(i / 4) + double(i % 4));
}

TEST(Matrix34, RoundTripKeepsEveryBit) {
  // Both ways only copy numbers, so nothing may change, and the lower row comes back as (0, 0, 0, 1).
  std::mt19937_64 random{1};
  for (int k = 0; k < 100; ++k) {
    const Affine M = test::random_affine(random);
    EXPECT_EQ(Matrix34::from(M).affine().matrix(), M.matrix());
  }
}

TEST(Matrix34, IsFiniteUnlessAnEntryIsNot) {
  // Each entry in turn; the greatest numbers and the smallest are finite.
  Matrix34 M;
  M.m.fill(std::numeric_limits<double>::max());
  EXPECT_TRUE(M.is_finite());
  M.m.fill(-std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(M.is_finite());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 12; ++i) {
    for (const double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
      Matrix34 broken;
      broken.m[i] = bad;
      EXPECT_FALSE(broken.is_finite());
    }
  }
}

TEST(Matrix34, IsTheIdentityByDefault) {
  // What a new node's matrix is before anybody sets it.
  EXPECT_EQ(Matrix34{}, Matrix34::from(Affine::Identity()));
}

}  // namespace
}  // namespace pantin
