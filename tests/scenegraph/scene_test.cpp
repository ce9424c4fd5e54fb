#include <gtest/gtest.h>

#include <limits>
#include <support/expect_contract.hpp>
#include <support/random_affine.hpp>

#include <pantin/scenegraph/scene.hpp>

namespace pantin {
namespace {

Affine translation(double x, double y, double z) { return Affine{Eigen::Translation3d{x, y, z}}; }

TEST(Scene, StartsWithItsRoot) {
  // The root is there from the start, is nobody's child and has neither name nor path.
  Scene scene;
  EXPECT_EQ(scene.size(), 1U);
  EXPECT_TRUE(scene.contains(scene.root()));
  EXPECT_FALSE(scene.parent(scene.root()));
  EXPECT_EQ(scene.name(scene.root()), "");
  EXPECT_EQ(scene.world(scene.root()).matrix(), Affine::Identity().matrix());
}

TEST(Scene, ChildrenAreInOrderOfCreation) {
  // Also where a child comes after other branches were begun, so that it lies in another run.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  const NodeId a1 = scene.create(a, "a1");
  const NodeId b = scene.create(scene.root(), "b");
  const NodeId a2 = scene.create(a, "a2");
  const NodeId c = scene.create(scene.root(), "c");
  const NodeId a3 = scene.create(a, "a3");
  EXPECT_EQ(scene.children(scene.root()), (std::vector<NodeId>{a, b, c}));
  EXPECT_EQ(scene.children(a), (std::vector<NodeId>{a1, a2, a3}));
  EXPECT_EQ(scene.subtree(scene.root()), (std::vector<NodeId>{scene.root(), a, a1, a2, a3, b, c}));
  EXPECT_EQ(scene.parent(a2), a);
  EXPECT_EQ(scene.size(), 7U);
}

TEST(Scene, RemovesWithAllBelow) {
  // Everything under the node is gone, also what lies in other runs; the rest stays.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  const NodeId b = scene.create(scene.root(), "b");
  const NodeId a1 = scene.create(a, "a1");
  const NodeId b1 = scene.create(b, "b1");
  const NodeId a11 = scene.create(a1, "a11");
  scene.remove(a);
  for (const NodeId gone : {a, a1, a11}) EXPECT_FALSE(scene.contains(gone));
  EXPECT_EQ(scene.subtree(scene.root()), (std::vector<NodeId>{scene.root(), b, b1}));
  EXPECT_EQ(scene.size(), 3U);
}

TEST(Scene, StaleIdsStayInvalidWhenTheirPlaceIsUsedAgain) {
  // A new node takes the slot of the removed one, with another generation; the old id must not name it, ever.
  Scene scene;
  std::vector<NodeId> stale;
  for (int k = 0; k < 100; ++k) {
    const NodeId id = scene.create(scene.root(), "short-lived");
    for (const NodeId old : stale) ASSERT_FALSE(scene.contains(old));
    scene.remove(id);
    ASSERT_FALSE(scene.contains(id));
    stale.push_back(id);
  }
  EXPECT_EQ(stale.front().index, stale.back().index);
}

TEST(Scene, NeverIssuedIdsAreNotContained) {
  // Null, an index beyond the table, and the generations next to a living one.
  Scene scene;
  const NodeId id = scene.create(scene.root(), "a");
  EXPECT_FALSE(scene.contains({}));
  EXPECT_FALSE(scene.contains({.index = 99, .generation = 1}));
  EXPECT_FALSE(scene.contains({.index = id.index, .generation = id.generation + 1}));
  EXPECT_FALSE(scene.contains({.index = id.index, .generation = id.generation - 1}));
  scene.remove(id);
  EXPECT_FALSE(scene.contains({.index = id.index, .generation = id.generation + 1}));
}

TEST(Scene, EveryUseOfAStaleIdIsRefused) {
  // Each member that takes an id names the id that is not alive.
  Scene scene;
  const NodeId root = scene.root();
  const NodeId id = scene.create(root, "a");
  scene.remove(id);
  const std::string text = "is null or was removed";
  test::expect_contract([&] { scene.create(id, "b"); }, text);
  test::expect_contract([&] { scene.remove(id); }, text);
  test::expect_contract([&] { scene.set_parent(id, root, Keep::Local); }, text);
  test::expect_contract([&] { scene.set_parent(root, id, Keep::Local); }, text);
  test::expect_contract([&] { static_cast<void>(scene.parent(id)); }, text);
  test::expect_contract([&] { static_cast<void>(scene.children(id)); }, text);
  test::expect_contract([&] { static_cast<void>(scene.subtree(id)); }, text);
  test::expect_contract([&] { static_cast<void>(scene.is_above(root, id)); }, text);
  test::expect_contract([&] { static_cast<void>(scene.is_above(id, root)); }, text);
  test::expect_contract([&] { static_cast<void>(scene.name(id)); }, text);
  test::expect_contract([&] { scene.rename(id, "c"); }, text);
  test::expect_contract([&] { static_cast<void>(scene.path(id)); }, text);
  test::expect_contract([&] { static_cast<void>(scene.link(id)); }, text);
  test::expect_contract([&] { scene.set_link(id, {}); }, text);
  test::expect_contract([&] { scene.clear_link(id); }, text);
  test::expect_contract([&] { scene.set_link_value(id, {}); }, text);
  test::expect_contract([&] { scene.note_link_value(id, {}); }, text);
  test::expect_contract([&] { static_cast<void>(scene.local(id)); }, text);
  test::expect_contract([&] { scene.set_local(id, Affine::Identity()); }, text);
  test::expect_contract([&] { scene.set_locals(std::vector<NodeLocal>{{.node = id}}); }, text);
  test::expect_contract([&] { static_cast<void>(scene.world(id)); }, text);
  test::expect_contract([&] { static_cast<void>(scene.index_of(id)); },
                        "generation 1) is null or was removed");
}

TEST(Scene, RefusesMatricesThatAreNotFinite) {
  // One bad entry anywhere in the upper three rows is enough; the text names the node.
  Scene scene;
  const NodeId id = scene.create(scene.root(), "arm");
  Affine M = Affine::Identity();
  M(1, 2) = std::numeric_limits<double>::quiet_NaN();
  test::expect_contract([&] { scene.set_local(id, M); },
                        "local matrix of node 'arm' has an entry that is not finite");
  M(1, 2) = std::numeric_limits<double>::infinity();
  test::expect_contract(
      [&] { scene.create(id, "hand", M); },
      "local matrix of the new node 'hand' under node 'arm' has an entry that is not finite");
  EXPECT_EQ(scene.size(), 2U);
}

TEST(Scene, TheRootCannotBeRemovedNorNamed) {
  // Both would break what every scene has: one root, which has no name.
  Scene scene;
  test::expect_contract([&] { scene.remove(scene.root()); }, "the root cannot be removed");
  test::expect_contract([&] { scene.rename(scene.root(), "world"); }, "the root has no name");
}

TEST(Scene, NamesAreKeptAsGivenAndCanChange) {
  // Any text is a name, twice the same too; a name of a removed node does not come back with its slot.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "wheel/~ [1]");
  const NodeId b = scene.create(scene.root(), "wheel/~ [1]");
  EXPECT_EQ(scene.name(a), "wheel/~ [1]");
  scene.rename(a, "");
  EXPECT_EQ(scene.name(a), "");
  EXPECT_EQ(scene.name(b), "wheel/~ [1]");
  scene.remove(b);
  EXPECT_EQ(scene.name(scene.create(scene.root(), "")), "");
}

TEST(Scene, LocalsAreKeptBitForBitAndInBulk) {
  // What is set is read back unchanged; a bulk set does what single ones do, the last entry of a node wins.
  Scene scene;
  std::mt19937_64 random{7};
  const NodeId a = scene.create(scene.root(), "a", translation(1, 2, 3));
  const NodeId b = scene.create(a, "b");
  EXPECT_EQ(scene.local(a).matrix(), translation(1, 2, 3).matrix());
  const Affine M = test::random_affine(random);
  scene.set_locals(std::vector<NodeLocal>{{a, test::random_affine(random)}, {b, M}, {a, M}});
  EXPECT_EQ(scene.local(a).matrix(), M.matrix());
  EXPECT_EQ(scene.local(b).matrix(), M.matrix());
}

TEST(Scene, MovesAsAValue) {
  // A moved scene keeps its nodes and ids; nothing is shared.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a", translation(0, 0, 5));
  Scene other = std::move(scene);
  EXPECT_EQ(other.world(a).translation().z(), 5);
  scene = Scene{};
  EXPECT_EQ(scene.size(), 1U);
  EXPECT_EQ(other.size(), 2U);
}

}  // namespace
}  // namespace pantin
