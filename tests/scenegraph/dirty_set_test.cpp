#include <gtest/gtest.h>

#include <set>
#include <support/random_affine.hpp>

#include <pantin/scenegraph/dirty_set.hpp>

namespace pantin {
namespace {

TEST(DirtySet, AgreesWithAnOrderedSet) {
  // Random marks, cleaned ranges and searches; std::set does the same in the plainest way. 20,000 positions
  // are five summary words, so that searches cross words and summaries.
  std::mt19937_64 random{2};
  constexpr std::uint32_t kCount = 20'000;
  DirtySet dirty;
  dirty.grow(kCount);
  std::set<std::uint32_t> reference;
  for (int k = 0; k < 20'000; ++k) {
    const std::uint32_t at = static_cast<std::uint32_t>(test::pick(random, kCount));
    if (test::pick(random, 8) == 0) {
      const std::uint32_t end = std::min(kCount, at + static_cast<std::uint32_t>(test::pick(random, 6000)));
      dirty.clean(at, end);
      if (at < end) reference.erase(reference.lower_bound(at), reference.lower_bound(end));
    } else {
      EXPECT_EQ(dirty.mark(at), reference.insert(at).second);
    }
    const std::uint32_t from = static_cast<std::uint32_t>(test::pick(random, kCount));
    const auto next = reference.lower_bound(from);
    ASSERT_EQ(dirty.next(from), next == reference.end() ? DirtySet::kNone : *next);
    ASSERT_EQ(dirty.test(from), reference.contains(from));
    ASSERT_LE(dirty.lowest(), dirty.next(0));
  }
}

TEST(DirtySet, FindsNothingWhenEmptyAndPastTheEnd) {
  // No position is dirty in a new set, and none is beyond its end; 64 and 4096 are the ends of a word and of
  // a block.
  for (const std::uint32_t count : {1U, 64U, 4096U, 5000U}) {
    DirtySet dirty;
    EXPECT_EQ(dirty.next(0), DirtySet::kNone);
    dirty.grow(count);
    EXPECT_EQ(dirty.next(0), DirtySet::kNone);
    dirty.mark(count - 1);
    EXPECT_EQ(dirty.next(0), count - 1);
    EXPECT_EQ(dirty.next(count), DirtySet::kNone);
  }
}

TEST(DirtySet, LowestIsForgottenOnlyOnDemand) {
  // `lowest` may stay too low after cleaning, never become too high; forgetting it says that nothing is
  // dirty.
  DirtySet dirty;
  dirty.grow(100);
  EXPECT_EQ(dirty.lowest(), DirtySet::kNone);
  dirty.mark(70);
  dirty.mark(30);
  EXPECT_EQ(dirty.lowest(), 30U);
  dirty.clean(0, 100);
  dirty.forget_lowest();
  EXPECT_EQ(dirty.lowest(), DirtySet::kNone);
}

}  // namespace
}  // namespace pantin
