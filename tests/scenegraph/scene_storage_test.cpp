#include <gtest/gtest.h>

#include <support/random_affine.hpp>

#include <pantin/scenegraph/scene_storage.hpp>

namespace pantin {
namespace {

std::vector<std::uint32_t> below(const SceneStorage& nodes, std::uint32_t top) {
  std::vector<std::uint32_t> positions;
  nodes.collect(top, positions);
  return positions;
}

TEST(SceneStorage, DepthFirstBuildIsOneRun) {
  // Each new node's parent is the last node or above it, so every one extends the run: no tail, sizes as
  // counted.
  SceneStorage nodes;
  std::mt19937_64 random{5};
  std::vector<std::uint32_t> path{0};
  for (int k = 0; k < 1000; ++k) {
    path.resize(1 + test::pick(random, path.size()));
    path.push_back(nodes.position(nodes.append(path.back(), Matrix34{})));
  }
  EXPECT_EQ(nodes.tails(), 0U);
  for (std::uint32_t at = 0; at < nodes.end(); ++at) EXPECT_EQ(below(nodes, at).size(), nodes.extent(at));
}

TEST(SceneStorage, TakesAtMost220BytesANodeAfterCompaction) {
  // Counted from the capacities of all arrays and tables, in the worst order: each node's parent is closed
  // already.
  SceneStorage nodes;
  constexpr std::uint32_t kCount = 100'000;
  for (std::uint32_t i = 1; i < kCount; ++i) nodes.append((i - 1) / 2, Matrix34{});
  EXPECT_GT(nodes.tails(), 0U);
  static_cast<void>(nodes.compact());
  EXPECT_EQ(nodes.tails(), 0U);
  EXPECT_EQ(nodes.alive(), kCount);
  SceneMemory memory;
  nodes.add_bytes(memory);
  EXPECT_LE(double(memory.total()) / kCount, 220.0);
}

TEST(SceneStorage, CompactionReportsWhereNodesWere) {
  // The local matrix is a label here: entry i of the result must be the place where the label at i was
  // before.
  SceneStorage nodes;
  std::mt19937_64 random{6};
  for (std::uint32_t i = 1; i < 200; ++i) {
    Matrix34 label;
    label.m[3] = i;
    nodes.append(static_cast<std::uint32_t>(test::pick(random, i)), label);
  }
  const std::vector<Matrix34> before = nodes.locals();
  const std::vector<std::uint32_t> from = nodes.compact();
  ASSERT_EQ(from.size(), 200U);
  for (std::uint32_t i = 0; i < 200; ++i) {
    EXPECT_EQ(nodes.locals()[i], before[from[i]]);
    EXPECT_EQ(nodes.position(nodes.order()[i]), i);
    if (i > 0) {
      EXPECT_LT(nodes.parent(i), i);
    }
  }
}

TEST(SceneStorage, HolesAreSkippedAsWholes) {
  // A chain removed from its end: each hole swallows the one before, so walking over it takes one step. The
  // extent of the first hole is all of it.
  SceneStorage nodes;
  std::vector<std::uint32_t> chain{0};
  for (int k = 0; k < 100; ++k) chain.push_back(nodes.position(nodes.append(chain.back(), Matrix34{})));
  nodes.append(0, Matrix34{});
  for (std::size_t k = 100; k > 1; --k) nodes.remove(chain[k], below(nodes, chain[k]));
  EXPECT_EQ(nodes.holes(), 99U);
  EXPECT_EQ(nodes.extent(chain[2]), 99U);
  EXPECT_EQ(below(nodes, 0).size(), 3U);
}

TEST(SceneStorage, AppendsInPlaceAfterTheLastNodeWasRemoved) {
  // Removing the end of the rightmost path leaves its ancestors open, so that no tail is needed for what
  // comes next.
  SceneStorage nodes;
  const std::uint32_t a = nodes.position(nodes.append(0, Matrix34{}));
  const std::uint32_t b = nodes.position(nodes.append(a, Matrix34{}));
  nodes.append(b, Matrix34{});
  nodes.remove(b, below(nodes, b));
  const std::uint32_t c = nodes.position(nodes.append(a, Matrix34{}));
  EXPECT_EQ(nodes.tails(), 0U);
  EXPECT_EQ(below(nodes, a), (std::vector<std::uint32_t>{a, c}));
}

}  // namespace
}  // namespace pantin
