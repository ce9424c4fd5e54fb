#include <gtest/gtest.h>

#include <atomic>
#include <support/random_affine.hpp>
#include <thread>

#include <pantin/scenegraph/scene.hpp>

namespace pantin {
namespace {

std::size_t swept(const Scene& scene) {
  std::size_t count = 0;
  for (const IndexRange& range : scene.changed()) count += range.end - range.begin;
  return count;
}

/// A random tree built depth-first, so that it is one run.
std::vector<NodeId> plant(Scene& scene, std::mt19937_64& random, std::size_t count) {
  std::vector<NodeId> ids{scene.root()};
  std::vector<NodeId> path{scene.root()};
  while (ids.size() < count) {
    path.resize(1 + test::pick(random, path.size()));
    path.push_back(scene.create(path.back(), "n", test::random_affine(random)));
    ids.push_back(path.back());
  }
  return ids;
}

TEST(Update, SweepsNothingWhenNothingChanged) {
  // The ranges swept are counted, not timed: all nodes at first, none after that.
  Scene scene;
  std::mt19937_64 random{11};
  plant(scene, random, 100);
  scene.update();
  EXPECT_EQ(swept(scene), 100U);
  const std::vector<Matrix34> before{scene.worlds().begin(), scene.worlds().end()};
  for (int k = 0; k < 1000; ++k) scene.update();
  EXPECT_TRUE(scene.changed().empty());
  EXPECT_TRUE(std::equal(before.begin(), before.end(), scene.worlds().begin(), scene.worlds().end()));
}

TEST(Update, SweepsExactlyTheDirtySubtree) {
  // In one run a subtree is one range, from the node's position, as long as the subtree has nodes.
  Scene scene;
  std::mt19937_64 random{12};
  const std::vector<NodeId> ids = plant(scene, random, 300);
  scene.update();
  for (const NodeId id : ids) {
    scene.set_local(id, test::random_affine(random));
    scene.set_local(id, test::random_affine(random));
    scene.update();
    ASSERT_EQ(scene.changed().size(), 1U);
    EXPECT_EQ(scene.changed()[0].begin, scene.index_of(id));
    EXPECT_EQ(swept(scene), scene.subtree(id).size());
  }
}

TEST(Update, NestedAndTouchingRangesAreSweptOnce) {
  // A dirty node below a dirty one adds nothing; ranges that touch are reported as one.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  const NodeId a1 = scene.create(a, "a1");
  const NodeId b = scene.create(scene.root(), "b");
  const NodeId c = scene.create(scene.root(), "c");
  scene.update();
  for (const NodeId id : {a1, b, a}) scene.set_local(id, Affine::Identity());
  scene.update();
  ASSERT_EQ(scene.changed().size(), 1U);
  EXPECT_EQ(scene.changed()[0].begin, scene.index_of(a));
  EXPECT_EQ(scene.changed()[0].end, scene.index_of(c));
}

TEST(Update, ReachesTailsBelowADirtyNodeOnly) {
  // x hangs under a in a tail, z under b: a dirty a takes x along, not z.
  Scene scene;
  const Affine step{Eigen::Translation3d{1, 0, 0}};
  const NodeId a = scene.create(scene.root(), "a", step);
  const NodeId b = scene.create(scene.root(), "b", step);
  scene.create(scene.root(), "c", step);
  const NodeId z = scene.create(b, "z", step);
  const NodeId x = scene.create(a, "x", step);
  scene.update();
  scene.set_local(a, Affine{Eigen::Translation3d{10, 0, 0}});
  scene.update();
  EXPECT_EQ(swept(scene), 2U);
  EXPECT_EQ(scene.worlds()[scene.index_of(x)].m[3], 11);
  EXPECT_EQ(scene.worlds()[scene.index_of(z)].m[3], 2);
}

TEST(Update, PutsNodesBackIntoOneRun) {
  // A tree built breadth-first has a tail for almost every node; past the threshold the update orders it
  // depth-first, after which order() is the depth-first walk, with no hole, and everything counts as changed.
  Scene scene;
  std::vector<NodeId> ids{scene.root()};
  for (std::size_t i = 1; i < 1000; ++i) ids.push_back(scene.create(ids[(i - 1) / 2], "n"));
  for (std::size_t i = 500; i < 600; ++i) scene.remove(ids[i]);
  scene.update();
  const std::vector<NodeId> walk = scene.subtree(scene.root());
  EXPECT_TRUE(std::equal(walk.begin(), walk.end(), scene.order().begin(), scene.order().end()));
  EXPECT_EQ(swept(scene), scene.size());
  EXPECT_EQ(scene.worlds().size(), 900U);
}

TEST(Update, ASmallRemovalLeavesHoles) {
  // Below the threshold nothing moves: the place of the removed node stays, its id is null, and nothing is
  // swept.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  const NodeId b = scene.create(scene.root(), "b");
  scene.update();
  const std::size_t place = scene.index_of(a);
  scene.remove(a);
  scene.update();
  EXPECT_TRUE(scene.changed().empty());
  EXPECT_EQ(scene.order().size(), 3U);
  EXPECT_FALSE(scene.order()[place]);
  EXPECT_EQ(scene.order()[scene.index_of(b)], b);
}

TEST(World, ReadsThroughWithTheBitsOfTheUpdate) {
  // Before an update, world() multiplies the changed locals itself, in the order the update does: equal bits.
  // Reading changes nothing, so worlds() is still as it was.
  Scene scene;
  std::mt19937_64 random{13};
  const std::vector<NodeId> ids = plant(scene, random, 500);
  scene.update();
  for (int k = 0; k < 30; ++k) {
    const std::vector<Matrix34> before{scene.worlds().begin(), scene.worlds().end()};
    for (int j = 0; j < 5; ++j)
      scene.set_local(ids[test::pick(random, ids.size())], test::random_affine(random));
    std::vector<Affine> read;
    for (const NodeId id : ids) read.push_back(scene.world(id));
    ASSERT_TRUE(std::equal(before.begin(), before.end(), scene.worlds().begin()));
    scene.update();
    for (std::size_t i = 0; i < ids.size(); ++i)
      ASSERT_EQ(scene.worlds()[scene.index_of(ids[i])], Matrix34::from(read[i]));
  }
}

TEST(World, IsReadByManyThreadsAtOnce) {
  // Const members share no scratch: four threads read dirty worlds and get what one thread got.
  Scene scene;
  std::mt19937_64 random{14};
  const std::vector<NodeId> ids = plant(scene, random, 2000);
  scene.update();
  for (std::size_t i = 0; i < ids.size(); i += 7) scene.set_local(ids[i], test::random_affine(random));
  std::vector<Affine> expected;
  for (const NodeId id : ids) expected.push_back(scene.world(id));
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (std::size_t i = 0; i < ids.size(); ++i) {
        if (scene.world(ids[i]).matrix() != expected[i].matrix()) ++wrong;
        if (scene.find(scene.path(ids[i])) != ids[i]) ++wrong;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace pantin
