#include <gtest/gtest.h>

#include <support/expect_contract.hpp>
#include <support/random_affine.hpp>

#include <pantin/scenegraph/scene.hpp>

namespace pantin {
namespace {

TEST(SetParent, KeepLocalLeavesTheLocalMatrix) {
  // Nothing is computed, so the bits stay and the world follows the new parent.
  Scene scene;
  std::mt19937_64 random{8};
  const Affine M = test::random_affine(random);
  const Affine M_WB = test::random_affine(random);
  const NodeId a = scene.create(scene.root(), "a", test::random_affine(random));
  const NodeId b = scene.create(scene.root(), "b", M_WB);
  const NodeId c = scene.create(a, "c", M);
  scene.set_parent(c, b, Keep::Local);
  EXPECT_EQ(scene.local(c).matrix(), M.matrix());
  EXPECT_EQ(scene.parent(c), b);
  EXPECT_LT(test::relative_error(scene.world(c), M_WB * M), 1e-14);
}

TEST(SetParent, KeepWorldIsExactUnderScaleShearAndMirror) {
  // The world matrix must not move however the old and new ancestors deform; the worlds are compared with
  // those from before. Conditions of chains of five such matrices reach 1e4, but the residual of a backward
  // stable solution does not grow with them: round-off of the products remains.
  std::mt19937_64 random{9};
  for (int k = 0; k < 2000; ++k) {
    Scene scene;
    NodeId left = scene.root();
    NodeId right = scene.root();
    for (int depth = 0; depth < 5; ++depth) left = scene.create(left, "l", test::random_affine(random));
    for (int depth = 0; depth < 5; ++depth) right = scene.create(right, "r", test::random_affine(random));
    const NodeId child = scene.create(left, "child", test::random_affine(random));
    const NodeId grandchild = scene.create(child, "grandchild", test::random_affine(random));
    const Affine before = scene.world(child);
    const Affine before_below = scene.world(grandchild);
    scene.set_parent(child, right, Keep::World);
    ASSERT_LT(test::relative_error(scene.world(child), before), 1e-13);
    ASSERT_LT(test::relative_error(scene.world(grandchild), before_below), 1e-13);
    scene.update();
    ASSERT_LT(test::relative_error(scene.world(child), before), 1e-13);
  }
}

TEST(SetParent, KeepWorldStandsVeryDifferentScales) {
  // A parent scaled by 1e-9, 1 and 1e9 along its axes is not singular; relative to each axis nothing is lost.
  Scene scene;
  std::mt19937_64 random{10};
  Affine M = Affine::Identity();
  M.linear() = test::random_rotation(random).toRotationMatrix() * Vector3{1e-9, 1, 1e9}.asDiagonal();
  const NodeId parent = scene.create(scene.root(), "parent", M);
  const NodeId child = scene.create(scene.root(), "child", test::random_affine(random));
  const Affine before = scene.world(child);
  scene.set_parent(child, parent, Keep::World);
  EXPECT_LT(test::relative_error(scene.world(child), before), 1e-13);
}

TEST(SetParent, RefusesToKeepTheWorldUnderASingularParent) {
  // A parent flattened along one axis has no inverse; both nodes are named, nothing has changed.
  Scene scene;
  Affine flat = Affine::Identity();
  flat.linear() = Vector3{1, 1, 0}.asDiagonal();
  const NodeId shadow = scene.create(scene.root(), "shadow", flat);
  const NodeId arm = scene.create(scene.root(), "arm");
  const NodeId hand = scene.create(arm, "hand");
  test::expect_contract([&] { scene.set_parent(hand, shadow, Keep::World); },
                        "world matrix of node 'shadow' is singular, so node 'arm/hand' cannot keep");
  EXPECT_EQ(scene.parent(hand), arm);
  flat.linear() << 1, 2, 3, 2, 4, 6, 0, 0, 1;
  scene.set_local(shadow, flat);
  test::expect_contract([&] { scene.set_parent(hand, shadow, Keep::World); }, "is singular");
  scene.set_parent(hand, shadow, Keep::Local);
  EXPECT_EQ(scene.parent(hand), shadow);
}

TEST(SetParent, RefusesCycles) {
  // A node can hang neither under itself nor under what hangs below it, in whichever run that lies.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  const NodeId b = scene.create(a, "b");
  scene.create(scene.root(), "c");
  const NodeId d = scene.create(b, "d");
  test::expect_contract([&] { scene.set_parent(a, a, Keep::Local); },
                        "cycle: node 'a' is node 'a' or below it");
  test::expect_contract([&] { scene.set_parent(a, b, Keep::Local); },
                        "cycle: node 'a/b' is node 'a' or below it");
  test::expect_contract([&] { scene.set_parent(a, d, Keep::World); }, "cycle: node 'a/b/d' is node 'a'");
  test::expect_contract([&] { scene.set_parent(scene.root(), a, Keep::Local); },
                        "the root cannot be hung under");
  EXPECT_EQ(scene.parent(a), scene.root());
}

TEST(SetParent, MakesTheLastChild) {
  // Also when the parent is the one it has already.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  const NodeId b = scene.create(scene.root(), "b");
  const NodeId c = scene.create(scene.root(), "c");
  const NodeId a1 = scene.create(a, "a1");
  scene.set_parent(a, scene.root(), Keep::Local);
  EXPECT_EQ(scene.children(scene.root()), (std::vector<NodeId>{b, c, a}));
  scene.set_parent(c, a, Keep::Local);
  EXPECT_EQ(scene.children(a), (std::vector<NodeId>{a1, c}));
  scene.set_parent(b, a, Keep::Local);
  EXPECT_EQ(scene.children(a), (std::vector<NodeId>{a1, c, b}));
  EXPECT_EQ(scene.children(scene.root()), std::vector<NodeId>{a});
}

TEST(SetParent, TailsBelowAMovedSubtreeComeAlong) {
  // x hangs below a in a run of its own, y below x in a third: moving a takes both, and worlds follow.
  Scene scene;
  const Affine step{Eigen::Translation3d{1, 0, 0}};
  const NodeId a = scene.create(scene.root(), "a", step);
  const NodeId b = scene.create(scene.root(), "b", step);
  const NodeId x = scene.create(a, "x", step);
  scene.create(b, "b1", step);
  const NodeId y = scene.create(x, "y", step);
  scene.update();
  EXPECT_EQ(scene.world(y).translation().x(), 3);
  scene.set_parent(a, b, Keep::Local);
  EXPECT_EQ(scene.world(y).translation().x(), 4);
  scene.update();
  EXPECT_EQ(scene.worlds()[scene.index_of(y)].m[3], 4);
  EXPECT_TRUE(scene.is_above(b, y));
}

TEST(IsAbove, HoldsAlongPathsOnly) {
  // True for the node itself and its ancestors, false for siblings and for what is below.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  const NodeId b = scene.create(scene.root(), "b");
  const NodeId a1 = scene.create(a, "a1");
  EXPECT_TRUE(scene.is_above(a, a));
  EXPECT_TRUE(scene.is_above(a, a1));
  EXPECT_TRUE(scene.is_above(scene.root(), a1));
  EXPECT_FALSE(scene.is_above(a1, a));
  EXPECT_FALSE(scene.is_above(b, a1));
  EXPECT_FALSE(scene.is_above(a, b));
}

}  // namespace
}  // namespace pantin
