#include <pantin/physics/integrators/stage_arrays.hpp>

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <pantin/physics/lanes/tree_lanes.hpp>

namespace pantin {
namespace {

struct Numbers {
  std::size_t stages{0}, count{5};
  NodeMatrix a{};
  std::vector<double> base{}, slopes{};

  explicit Numbers(std::size_t s) : stages{s}, base(count), slopes(count * s) {
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> any{-1, 1};
    for (auto& column : a)
      for (double& x : column) x = any(random);
    for (double& x : base) x = any(random);
    for (double& x : slopes) x = any(random);
  }
  /// In extended precision.
  [[nodiscard]] double exact(std::size_t n, std::size_t i, double h) const {
    long double sum = 0;
    for (std::size_t j = 0; j < stages; ++j)
      sum += static_cast<long double>(a[j][i]) * slopes[n * stages + j];
    return static_cast<double>(h == 0 ? sum : base[n] + h * sum);
  }
};

TEST(StageArrays, SumsAreRightForEveryNumberOfStages) {
  // Against extended precision: at most nine terms of size one, so a few units of 1e-16.
  for (std::size_t s = 1; s <= kMostNodes; ++s) {
    const Numbers given{s};
    std::vector<double> added(given.slopes.size()), combined(given.slopes.size());
    add_stages(static_cast<int>(s), added, given.base, 0.5, given.slopes, given.a);
    combine_stages(static_cast<int>(s), combined, given.slopes, given.a);
    for (std::size_t n = 0; n < given.count; ++n) {
      for (std::size_t i = 0; i < s; ++i) {
        EXPECT_NEAR(added[n * s + i], given.exact(n, i, 0.5), 2e-15) << s;
        EXPECT_NEAR(combined[n * s + i], given.exact(n, i, 0), 4e-15) << s;
      }
    }
  }
}

TEST(StageArrays, EveryInstructionSetSumsAlike) {
  // Lanes only share out the stages; fused multiply-adds round less, so up to round-off.
  for (const lanes::InstructionSet set : lanes::instruction_sets()) {
    const lanes::Kernel& kernel = lanes::kernel_for(set);
    for (const std::size_t s : {std::size_t{4}, std::size_t{8}}) {
      if (s % static_cast<std::size_t>(kernel.lanes) != 0) continue;
      const Numbers given{s};
      std::vector<double> out(given.slopes.size());
      kernel.sum_stages({s, given.count, given.base.data(), 0.25, given.slopes.data(), &given.a, out.data()});
      for (std::size_t n = 0; n < given.count; ++n) {
        for (std::size_t i = 0; i < s; ++i)
          EXPECT_NEAR(out[n * s + i], given.exact(n, i, 0.25), 2e-15) << lanes::to_string(set);
      }
    }
  }
}

}  // namespace
}  // namespace pantin
