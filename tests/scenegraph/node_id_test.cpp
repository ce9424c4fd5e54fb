#include <gtest/gtest.h>

#include <unordered_set>

#include <pantin/scenegraph/node_id.hpp>

namespace pantin {
namespace {

TEST(NodeId, IsNullByDefaultAndEightBytes) {
  // The generation 0 is given to no node, so a default id names none; two 32 bit numbers make 8 bytes.
  EXPECT_FALSE(NodeId{});
  EXPECT_TRUE((NodeId{.index = 0, .generation = 1}));
  static_assert(sizeof(NodeId) == 8);
}

TEST(NodeId, HashesIndexAndGenerationApart) {
  // A set tells ids apart that differ in one of the two numbers only.
  const std::unordered_set<NodeId> ids{{1, 1}, {1, 2}, {2, 1}, {2, 2}, {1, 1}};
  EXPECT_EQ(ids.size(), 4U);
}

}  // namespace
}  // namespace pantin
