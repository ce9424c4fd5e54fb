#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <support/expect_contract.hpp>
#include <support/random_affine.hpp>
#include <vector>

#include <pantin/scenegraph/scene.hpp>
#include <pantin/scenegraph/sweep.hpp>

namespace pantin {
namespace {

/// The formula of sweep_kernel.inc, entry by entry.
Matrix34 by_formula(const Matrix34& a, const Matrix34& b) {
  Matrix34 c;
  for (std::size_t row = 0; row < 12; row += 4) {
    for (std::size_t j = 0; j < 4; ++j) {
      const double xy = a.m[row] * b.m[j] + a.m[row + 1] * b.m[4 + j];
      const double z = a.m[row + 2] * b.m[8 + j];
      c.m[row + j] = j < 3 ? xy + z : xy + (z + a.m[row + 3]);
    }
  }
  return c;
}

std::array<std::uint64_t, 12> bits(const Matrix34& a) {
  return std::bit_cast<std::array<std::uint64_t, 12>>(a.m);
}

/// Entries of all sizes and signs: zeros of either sign, subnormal ones, ones whose products overflow.
Matrix34 wild(std::mt19937_64& random) {
  constexpr std::array kSpecial{0.0,    -0.0,    1.0,   -1.0,   std::numeric_limits<double>::denorm_min(),
                                1e-170, -3e-308, 1e170, -1e308, std::numeric_limits<double>::max()};
  Matrix34 a;
  for (double& entry : a.m)
    entry = test::pick(random, 2) == 0 ? kSpecial[test::pick(random, kSpecial.size())]
                                       : test::uniform(random, -3, 3);
  return a;
}

struct Arrays {
  std::vector<Matrix34> locals{};
  std::vector<std::uint32_t> parents{};
  std::vector<Matrix34> worlds{};
};

/// A tree in which every node's parent is any earlier one; worlds are what they may be before a sweep.
Arrays random_arrays(std::mt19937_64& random, std::uint32_t count) {
  Arrays arrays;
  for (std::uint32_t i = 0; i < count; ++i) {
    arrays.locals.push_back(Matrix34::from(test::random_affine(random)));
    // Half of them one after the other, as in chains.
    const bool chained = i > 0 && test::pick(random, 2) == 0;
    arrays.parents.push_back(i == 0    ? 0
                             : chained ? i - 1
                                       : static_cast<std::uint32_t>(test::pick(random, i)));
  }
  arrays.worlds.resize(count);
  return arrays;
}

void run(SweepFunction* sweep, Arrays& arrays, const std::vector<IndexRange>& ranges) {
  sweep(arrays.locals.data()->m.data(), arrays.parents.data(), arrays.worlds.data()->m.data(), ranges.data(),
        ranges.size());
}

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

TEST(Sweep, EveryInstructionSetHasTheBitsOfTheFormula) {
  // The formula fixes each operation and its order, and IEEE 754 each one's result. So no bit may differ
  // between this plain loop and any kernel, zeros' signs, subnormal numbers and overflow included; a kernel
  // that fuses, reorders or adds a positive zero is found out. Not-a-numbers have no sign that means
  // anything.
  std::mt19937_64 random{5};
  for (const SweepKernel& kernel : sweep_kernels()) {
    for (int k = 0; k < 20'000; ++k) {
      const Matrix34 a = wild(random);
      const Matrix34 b = wild(random);
      Matrix34 expected = by_formula(a, b);
      Matrix34 c;
      kernel.multiply(a.m.data(), b.m.data(), c.m.data());
      for (std::size_t i = 0; i < 12; ++i) {
        ASSERT_EQ(std::isnan(expected.m[i]), std::isnan(c.m[i]));
        if (std::isnan(c.m[i])) expected.m[i] = c.m[i] = 0;
      }
      ASSERT_EQ(bits(c), bits(expected)) << to_string(kernel.set);
    }
  }
}

TEST(Sweep, WritesItsRangesOnlyAndHasTheBitsOfMultiply) {
  // Whatever the kernel holds in registers, each world is its parent's times its local; what lies outside the
  // ranges is not touched.
  for (const SweepKernel& kernel : sweep_kernels()) {
    std::mt19937_64 random{4};
    Arrays arrays = random_arrays(random, 60);
    run(kernel.sweep, arrays, {{10, 11}, {15, 40}, {41, 50}});
    for (std::uint32_t i = 0; i < 60; ++i) {
      const bool inside = i == 10 || (i >= 15 && i < 40) || (i >= 41 && i < 50);
      const Matrix34 product = multiply(arrays.worlds[arrays.parents[i]], arrays.locals[i]);
      EXPECT_EQ(bits(arrays.worlds[i]), bits(inside ? product : Matrix34{})) << to_string(kernel.set);
    }
  }
}

TEST(Sweep, IndependentRangesMayGoInAnyOrder) {
  // Ranges whose nodes have their parents in the same range or before all of them: 0 to 12 ranges of 1 to 30
  // nodes, so that walks end in every order. Each product has the same factors as one after the other, so the
  // bits are the same.
  std::mt19937_64 random{6};
  for (int k = 0; k < 200; ++k) {
    Arrays arrays = random_arrays(random, 20);
    std::vector<IndexRange> ranges;
    for (std::size_t count = test::pick(random, 13); count > 0; --count) {
      const std::size_t begin = arrays.locals.size();
      const std::size_t end = begin + 1 + test::pick(random, 30);
      for (std::size_t i = begin; i < end; ++i) {
        arrays.locals.push_back(Matrix34::from(test::random_affine(random)));
        arrays.parents.push_back(static_cast<std::uint32_t>(
            i == begin ? test::pick(random, 20) : begin + test::pick(random, i - begin)));
      }
      ranges.push_back({begin, end});
    }
    arrays.worlds.resize(arrays.locals.size());
    for (const SweepKernel& kernel : sweep_kernels()) {
      Arrays in_turn = arrays;
      run(sweep_kernels().front().sweep, in_turn, ranges);
      Arrays any_order = arrays;
      run(kernel.sweep_independent, any_order, ranges);
      ASSERT_EQ(any_order.worlds, in_turn.worlds) << to_string(kernel.set);
    }
  }
}

TEST(InstructionSet, TheBaselineRunsEverywhereAndTheBestIsTheLast) {
  // Kernels are listed from the baseline up, so Best stands for the last; what is not listed does not run.
  EXPECT_EQ(sweep_kernels().front().set, InstructionSet::Baseline);
  EXPECT_EQ(sweep_kernel(InstructionSet::Best).set, sweep_kernels().back().set);
  EXPECT_TRUE(runs_here(InstructionSet::Best));
  EXPECT_TRUE(runs_here(InstructionSet::Baseline));
  EXPECT_EQ(runs_here(InstructionSet::Avx2), sweep_kernels().size() == 2);
  EXPECT_EQ(Scene{}.instruction_set(), sweep_kernels().back().set);
  EXPECT_EQ(Scene{InstructionSet::Baseline}.instruction_set(), InstructionSet::Baseline);
}

TEST(InstructionSet, HasAName) {
  // As written on tables; the two that can be in use and the one that stands for either.
  EXPECT_EQ(to_string(InstructionSet::Best), "best");
  EXPECT_EQ(to_string(InstructionSet::Baseline), "baseline");
  EXPECT_EQ(to_string(InstructionSet::Avx2), "avx2");
}

TEST(InstructionSet, OneThatDoesNotRunHereIsRefused) {
  // A set that does not exist is not in any build.
  test::expect_contract([] { Scene{static_cast<InstructionSet>(99)}; },
                        "instruction set unknown is not in this build or not in this processor; use Best");
}

TEST(InstructionSet, ScenesHaveTheSameBitsWithAll) {
  // The same edits in two scenes, with creations out of order and moves that leave tails and holes, so that
  // ranges are swept both at once and in turn; worlds agree to the last bit after every update.
  std::mt19937_64 random{7};
  for (const SweepKernel& kernel : sweep_kernels()) {
    Scene plain{InstructionSet::Baseline};
    Scene other{kernel.set};
    std::vector<NodeId> ids{plain.root()};
    for (int k = 0; k < 3000; ++k) {
      const NodeId node = ids[test::pick(random, ids.size())];
      const NodeId second = ids[test::pick(random, ids.size())];
      const std::size_t kind = test::pick(random, 10);
      const Affine M = test::random_affine(random);
      if (kind < 2) {
        ids.push_back(plain.create(node, "", M));
        ASSERT_EQ(other.create(node, "", M), ids.back());
      } else if (kind == 2 && !plain.is_above(node, second)) {
        for (Scene* scene : {&plain, &other}) scene->set_parent(node, second, Keep::World);
      } else if (kind < 9) {
        for (Scene* scene : {&plain, &other}) scene->set_local(node, M);
      } else {
        for (Scene* scene : {&plain, &other}) scene->update();
        for (std::size_t i = 0; i < plain.worlds().size(); ++i)
          ASSERT_EQ(bits(plain.worlds()[i]), bits(other.worlds()[i]));
      }
    }
  }
}

}  // namespace
}  // namespace pantin
