#include <gtest/gtest.h>

#include <support/expect_contract.hpp>
#include <support/random_affine.hpp>

#include <pantin/scenegraph/scene.hpp>

namespace pantin {
namespace {

Link pivot(double angle) {
  Link link;
  link.kind = LinkKind::Pivot;
  link.M_PJ.translation() = Vector3{0, 0, 1};
  link.value = angle;
  return link;
}

TEST(SceneLink, SetsTheLocalMatrix) {
  // Giving a link or a value places the node where the link says; noting a value does not.
  Scene scene;
  const NodeId arm = scene.create(scene.root(), "arm");
  EXPECT_EQ(scene.link(arm), nullptr);
  scene.set_link(arm, pivot(0.5));
  EXPECT_EQ(scene.local(arm).matrix(), local_matrix(pivot(0), 0.5).matrix());
  scene.set_link_value(arm, -1.5);
  EXPECT_EQ(scene.local(arm).matrix(), local_matrix(pivot(0), -1.5).matrix());
  EXPECT_EQ(scene.link(arm)->value, LinkValue{-1.5});
  scene.note_link_value(arm, 2.5);
  EXPECT_EQ(scene.local(arm).matrix(), local_matrix(pivot(0), -1.5).matrix());
  EXPECT_EQ(scene.link(arm)->value, LinkValue{2.5});
}

TEST(SceneLink, MarksTheSubtree) {
  // A link's value moves all below it.
  Scene scene;
  const NodeId arm = scene.create(scene.root(), "arm");
  const NodeId hand = scene.create(arm, "hand", Affine{Eigen::Translation3d{1, 0, 0}});
  scene.set_link(arm, pivot(0));
  scene.update();
  scene.set_link_value(arm, 1.0);
  scene.update();
  EXPECT_NEAR(scene.worlds()[scene.index_of(hand)].m[7], std::sin(1.0), 1e-15);
}

TEST(SceneLink, GoesWithItsNodeOnly) {
  // Clearing leaves the matrix; removing the node removes the link, also from the slot that a new node gets;
  // moving the node or others does not touch it.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  const NodeId b = scene.create(scene.root(), "b");
  scene.set_link(b, pivot(1));
  scene.set_parent(b, a, Keep::Local);
  ASSERT_NE(scene.link(b), nullptr);
  scene.clear_link(b);
  EXPECT_EQ(scene.link(b), nullptr);
  EXPECT_EQ(scene.local(b).matrix(), local_matrix(pivot(0), 1.0).matrix());
  scene.set_link(b, pivot(1));
  scene.remove(a);
  EXPECT_EQ(scene.link(scene.create(scene.root(), "c")), nullptr);
  EXPECT_EQ(scene.link(scene.create(scene.root(), "d")), nullptr);
}

TEST(SceneLink, RefusesWhatDoesNotFit) {
  // The text names the node and what is wrong; nothing is stored.
  Scene scene;
  const NodeId arm = scene.create(scene.create(scene.root(), "base"), "arm");
  Link bad = pivot(0);
  bad.axis *= 3;
  test::expect_contract([&] { scene.set_link(arm, bad); }, "link of node 'base/arm': axis has length 3");
  EXPECT_EQ(scene.link(arm), nullptr);
  test::expect_contract([&] { scene.set_link_value(arm, 1.0); },
                        "node 'base/arm' has no link to give a value to");
  scene.set_link(arm, pivot(0));
  test::expect_contract(
      [&] {
        scene.note_link_value(arm, {1, 2});
      },
      "value for the link of node 'base/arm': a pivot link's value has 1 numbers, not 2");
  EXPECT_EQ(scene.link(arm)->value, LinkValue{0.0});
  test::expect_contract([&] { scene.set_link(scene.root(), pivot(0)); },
                        "the root has no parent to be linked to");
}

}  // namespace
}  // namespace pantin
