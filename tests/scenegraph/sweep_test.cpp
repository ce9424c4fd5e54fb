#include <gtest/gtest.h>

#include <support/random_affine.hpp>
#include <vector>

#include <pantin/scenegraph/sweep.hpp>

namespace pantin {
namespace {

TEST(Sweep, MultipliesLikeEigen) {
  // The product of two affine maps; Eigen computes it independently. Sums of four products of entries below 3
  // differ by a few round-offs of 16.
  std::mt19937_64 random{3};
  for (int k = 0; k < 1000; ++k) {
    const Affine a = test::random_affine(random);
    const Affine b = test::random_affine(random);
    const Affine c = multiply(Matrix34::from(a), Matrix34::from(b)).affine();
    ASSERT_LT(((a * b).matrix() - c.matrix()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(Sweep, WritesItsRangeOnlyAndHasTheBitsOfMultiply) {
  // Both go through one kernel, so the bits agree; what lies outside the range is not touched.
  std::mt19937_64 random{4};
  std::vector<Matrix34> locals;
  std::vector<std::uint32_t> parents;
  for (std::uint32_t i = 0; i < 50; ++i) {
    locals.push_back(Matrix34::from(test::random_affine(random)));
    parents.push_back(i == 0 ? 0 : static_cast<std::uint32_t>(test::pick(random, i)));
  }
  std::vector<Matrix34> worlds(50);
  sweep(locals.data(), parents.data(), worlds.data(), 10, 40);
  for (std::uint32_t i = 0; i < 50; ++i) {
    const bool inside = i >= 10 && i < 40;
    EXPECT_EQ(worlds[i], inside ? multiply(worlds[parents[i]], locals[i]) : Matrix34{});
  }
}

}  // namespace
}  // namespace pantin
