// What is done with many nodes at once: setting locals, reading arrays, making room, giving it back.
#include <gtest/gtest.h>

#include <limits>
#include <support/expect_contract.hpp>
#include <support/random_affine.hpp>

#include <pantin/scenegraph/scene.hpp>

namespace pantin {
namespace {

/// A random tree of so many nodes besides the root, created in an order that leaves tails.
std::vector<NodeId> grow(Scene& scene, std::size_t count, std::uint64_t seed = 1) {
  std::mt19937_64 random{seed};
  std::vector<NodeId> ids{scene.root()};
  for (std::size_t k = 0; k < count; ++k)
    ids.push_back(scene.create(ids[test::pick(random, ids.size())], "n", test::random_affine(random)));
  return ids;
}

TEST(SetLocals, DoesWhatSettingOneByOneDoes) {
  // More than a block of them, in any order and some twice, where the last counts; every world comes out with
  // the same bits.
  std::mt19937_64 random{2};
  Scene many;
  Scene one_by_one;
  const std::vector<NodeId> ids = grow(many, 300);
  ASSERT_EQ(grow(one_by_one, 300), ids);
  std::vector<NodeId> chosen;
  std::vector<Matrix34> locals;
  for (int k = 0; k < 200; ++k) {
    chosen.push_back(ids[test::pick(random, ids.size())]);
    locals.push_back(Matrix34::from(test::random_affine(random)));
    one_by_one.set_local(chosen.back(), locals.back().affine());
  }
  many.set_locals(chosen, locals);
  many.update();
  one_by_one.update();
  for (const NodeId id : ids) {
    EXPECT_EQ(many.local(id).matrix(), one_by_one.local(id).matrix());
    EXPECT_EQ(many.world(id).matrix(), one_by_one.world(id).matrix());
  }
}

TEST(SetLocals, SweepsOnlyWhatWasSet) {
  // Setting marks the nodes given and no others: two leaves of three, each a range of one.
  Scene scene;
  std::vector<NodeId> leaves;
  for (int k = 0; k < 3; ++k) leaves.push_back(scene.create(scene.root(), "leaf"));
  scene.update();
  scene.set_locals(std::array{leaves[0], leaves[2]}, std::array<Matrix34, 2>{});
  scene.update();
  ASSERT_EQ(scene.changed().size(), 2U);
  EXPECT_EQ(scene.changed()[0].begin, scene.index_of(leaves[0]));
  EXPECT_EQ(scene.changed()[1].begin, scene.index_of(leaves[2]));
}

TEST(SetLocals, NeedsAMatrixForEachNode) {
  // One id and no matrix: the text says how many there are of either.
  Scene scene;
  test::expect_contract([&] { scene.set_locals(std::array{scene.root()}, std::span<const Matrix34>{}); },
                        "set_locals: 1 ids with 0 matrices; give one matrix for each id");
}

TEST(SetLocals, RefusesMatricesThatAreNotFinite) {
  // By the path of the node, like set_local; stale ids are refused as everywhere.
  Scene scene;
  const NodeId node = scene.create(scene.root(), "arm");
  Matrix34 bad;
  bad.m[7] = std::numeric_limits<double>::infinity();
  test::expect_contract([&] { scene.set_locals(std::array{node}, std::array{bad}); },
                        "local matrix of node 'arm' has an entry that is not finite");
  scene.remove(node);
  test::expect_contract([&] { scene.set_locals(std::array{node}, std::array<Matrix34, 1>{}); },
                        "is null or was removed");
}

TEST(Locals, StandWhereTheirNodesDo) {
  // The span shows at once what was set, each matrix at its node's index.
  Scene scene;
  const std::vector<NodeId> ids = grow(scene, 100);
  std::mt19937_64 random{3};
  scene.set_local(ids[50], test::random_affine(random));
  ASSERT_EQ(scene.locals().size(), scene.order().size());
  for (const NodeId id : ids)
    EXPECT_EQ(scene.locals()[scene.index_of(id)].affine().matrix(), scene.local(id).matrix());
}

TEST(Reserve, CreatingMovesNothingThen) {
  // Room for all was made, so the arrays stay where they are.
  Scene scene;
  scene.reserve(1001);
  const Matrix34* const locals = scene.locals().data();
  const Matrix34* const worlds = scene.worlds().data();
  const SceneMemory before = scene.memory();
  grow(scene, 1000);
  EXPECT_EQ(scene.locals().data(), locals);
  EXPECT_EQ(scene.worlds().data(), worlds);
  EXPECT_EQ(scene.memory().matrices, before.matrices);
}

TEST(Compact, PutsNodesIntoDepthFirstOrderAndTellsTheNextUpdate) {
  // Order is that of subtree(), without holes; no world changes a bit, yet all positions did, so everything
  // is reported as changed.
  Scene scene;
  std::vector<NodeId> ids = grow(scene, 500);
  scene.update();
  scene.remove(ids[1]);
  scene.update();  // so that nothing but the order is left to be told
  std::erase_if(ids, [&](NodeId id) { return !scene.contains(id); });
  std::vector<Affine> worlds;
  for (const NodeId id : ids) worlds.push_back(scene.world(id));
  scene.compact();
  const std::vector<NodeId> subtree = scene.subtree(scene.root());
  EXPECT_TRUE(std::equal(subtree.begin(), subtree.end(), scene.order().begin(), scene.order().end()));
  scene.update();
  ASSERT_EQ(scene.changed().size(), 1U);
  EXPECT_EQ(scene.changed()[0].end - scene.changed()[0].begin, scene.size());
  for (std::size_t k = 0; k < ids.size(); ++k) {
    EXPECT_EQ(scene.worlds()[scene.index_of(ids[k])], Matrix34::from(worlds[k]));
  }
}

TEST(Compact, KeepsWhatIsDirtyDirty) {
  // A local set before and not yet swept is swept by the update after it.
  Scene scene;
  const std::vector<NodeId> ids = grow(scene, 50);
  scene.update();
  scene.set_local(ids[7], Affine{Eigen::Translation3d{1, 2, 3}});
  const Affine expected = scene.world(ids[7]);
  scene.compact();
  EXPECT_EQ(scene.world(ids[7]).matrix(), expected.matrix());
  scene.update();
  EXPECT_EQ(scene.worlds()[scene.index_of(ids[7])], Matrix34::from(expected));
}

TEST(Memory, IsAtMost220BytesANodeAfterCompaction) {
  // Counted by hand: 2 x 96 bytes of matrices, 2 x 4 of topology, 2 x 8 of ids, one node in 64 to spare and a
  // dirty bit make less than 220, whatever order they were created in.
  Scene scene;
  const auto count = double(grow(scene, 100'000).size());
  scene.compact();
  const SceneMemory memory = scene.memory();
  EXPECT_GE(double(memory.matrices), 192 * count);
  EXPECT_GE(double(memory.topology), 8 * count);
  EXPECT_GE(double(memory.ids), 16 * count);
  EXPECT_LE(double(memory.matrices + memory.topology + memory.ids), 220 * count);
  EXPECT_EQ(memory.total(), memory.matrices + memory.topology + memory.ids + memory.names + memory.links);
}

TEST(Memory, CountsLongNamesAndLinks) {
  // A name of 1000 letters lies on the heap with its end mark; a link takes at least itself and its name.
  Scene scene;
  const NodeId node = scene.create(scene.root(), "short");
  const SceneMemory before = scene.memory();
  EXPECT_EQ(before.links, 0U);
  scene.rename(node, std::string(1000, 'x'));
  EXPECT_GE(scene.memory().names, before.names + 1001);
  Link link;
  link.name = std::string(500, 'y');
  scene.set_link(node, link);
  EXPECT_GE(scene.memory().links, sizeof(Link) + 501);
}

}  // namespace
}  // namespace pantin
