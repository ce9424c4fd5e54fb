#include <gtest/gtest.h>

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

TEST(Matrix34, IsTheIdentityByDefault) {
  // What a new node's matrix is before anybody sets it.
  EXPECT_EQ(Matrix34{}, Matrix34::from(Affine::Identity()));
}

}  // namespace
}  // namespace pantin
