// A million nodes in a chain and in a fan. None of this may recurse (a stack holds some hundred thousand
// calls) or be quadratic (10^12 steps would outlast the test's time limit), so that passing at all is the
// point.
#include <gtest/gtest.h>

#include <pantin/scenegraph/scene.hpp>

namespace pantin {
namespace {

constexpr std::size_t kMillion = 1'000'000;

struct Plant {
  Scene scene{};
  NodeId first{scene.create(scene.root(), "first", Affine{Eigen::Translation3d{0, 1, 0}})};
  NodeId second{scene.create(scene.root(), "second", Affine{Eigen::Translation3d{0, 0, 1}})};
  std::vector<NodeId> ids{};
};

const Affine kStep{Eigen::Translation3d{1, 0, 0}};

Plant chain() {
  Plant plant;
  NodeId at = plant.first;
  for (std::size_t k = 0; k < kMillion; ++k) plant.ids.push_back(at = plant.scene.create(at, "link", kStep));
  return plant;
}

Plant fan() {
  Plant plant;
  for (std::size_t k = 0; k < kMillion; ++k)
    plant.ids.push_back(plant.scene.create(plant.first, "leaf", kStep));
  return plant;
}

TEST(Million, ChainIsBuiltMovedAndRemoved) {
  // Link k of the chain stands at x = k + 1, exactly, as sums of ones are; y and z tell under which parent.
  Plant plant = chain();
  Scene& scene = plant.scene;
  EXPECT_EQ(scene.world(plant.ids.back()).translation(), Vector3(kMillion, 1, 0));
  scene.update();
  EXPECT_EQ(scene.world(plant.ids.back()).translation(), Vector3(kMillion, 1, 0));
  scene.set_parent(plant.ids.front(), plant.second, Keep::Local);
  EXPECT_EQ(scene.world(plant.ids.back()).translation(), Vector3(kMillion, 0, 1));
  scene.update();
  scene.set_parent(plant.ids.front(), plant.first, Keep::World);
  EXPECT_EQ(scene.world(plant.ids.back()).translation(), Vector3(kMillion, 0, 1));
  scene.update();
  EXPECT_EQ(scene.worlds()[scene.index_of(plant.ids[500])].m[3], 501);
  EXPECT_TRUE(scene.is_above(plant.first, plant.ids.back()));
  EXPECT_EQ(scene.subtree(plant.first).size(), kMillion + 1);
  scene.remove(plant.ids.front());
  EXPECT_EQ(scene.size(), 3U);
}

TEST(Million, ChainIsTakenApartLinkByLink) {
  // From the deepest up, each hung under the other parent keeping its world, with no update in between; then
  // removed.
  Plant plant = chain();
  Scene& scene = plant.scene;
  for (std::size_t k = kMillion; k-- > 0;) scene.set_parent(plant.ids[k], plant.second, Keep::World);
  EXPECT_EQ(scene.children(plant.second).size(), kMillion);
  scene.update();
  EXPECT_EQ(scene.world(plant.ids.back()).translation(), Vector3(kMillion, 1, 0));
  for (const NodeId id : plant.ids) scene.remove(id);
  EXPECT_EQ(scene.size(), 3U);
}

TEST(Million, ChainIsRemovedFromItsEnd) {
  // Each removal leaves a hole below the next one to go; none may walk over those before it.
  Plant plant = chain();
  for (std::size_t k = kMillion; k-- > 0;) plant.scene.remove(plant.ids[k]);
  EXPECT_EQ(plant.scene.size(), 3U);
  EXPECT_TRUE(plant.scene.children(plant.first).empty());
}

TEST(Million, FanIsBuiltMovedAndRemoved) {
  // All leaves stand at the same place, told apart by nothing but their ids.
  Plant plant = fan();
  Scene& scene = plant.scene;
  scene.update();
  EXPECT_EQ(scene.worlds()[scene.index_of(plant.ids.back())].m[3], 1);
  scene.set_parent(plant.first, plant.second, Keep::Local);
  EXPECT_EQ(scene.world(plant.ids.back()).translation(), Vector3(1, 1, 1));
  scene.update();
  scene.set_parent(plant.first, scene.root(), Keep::World);
  scene.update();
  EXPECT_EQ(scene.world(plant.ids[12345]).translation(), Vector3(1, 1, 1));
  EXPECT_EQ(scene.children(plant.first), plant.ids);
  EXPECT_EQ(scene.find("first/leaf[999999]"), plant.ids.back());
  EXPECT_EQ(scene.path(plant.ids.back()), "first/leaf[999999]");
  const std::vector<std::string> paths = scene.paths(plant.ids);
  for (std::size_t k = 0; k < kMillion; ++k) ASSERT_EQ(paths[k], "first/leaf[" + std::to_string(k) + "]");
  scene.remove(plant.first);
  EXPECT_EQ(scene.size(), 2U);
}

TEST(Million, FanIsTakenApartLeafByLeaf) {
  // In order of creation, with the leaf that moves last being the first child of what is left.
  Plant plant = fan();
  Scene& scene = plant.scene;
  scene.update();
  for (const NodeId id : plant.ids) scene.set_parent(id, plant.second, Keep::Local);
  EXPECT_TRUE(scene.children(plant.first).empty());
  EXPECT_EQ(scene.children(plant.second), plant.ids);
  for (const NodeId id : plant.ids) scene.remove(id);
  scene.update();
  EXPECT_EQ(scene.order().size(), 3U);
}

}  // namespace
}  // namespace pantin
