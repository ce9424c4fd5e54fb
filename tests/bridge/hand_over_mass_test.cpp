// Scene -> Physics: which mass a body gets, and which masses are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::box_mass;
using test::moved;
using test::says;
using test::Stage;

TEST(HandOver, ListsTheMassOfUnboundNodesAndGivesItBackWithThem) {
  // The child's mass rides on the parent's body until the child gets a body, and again when it is released.
  Stage s;
  const NodeId parent = box(s, s.scene.root(), "parent", Affine::Identity(), 3);
  const NodeId child = box(s, parent, "child", moved({1, 0, 0}), 2);
  const std::vector<Diagnostic> notes = s.bridge.hand_over(parent);
  EXPECT_TRUE(says(notes, "parent", "carries 2 kg of nodes below that have no body of their own: 'child'"));
  const auto mass = [&](NodeId id) { return s.physics.body(s.bridge.body_of(id)).mass(); };
  EXPECT_DOUBLE_EQ(mass(parent), 5);
  static_cast<void>(s.bridge.hand_over(child));
  EXPECT_DOUBLE_EQ(mass(parent), 3);
  EXPECT_DOUBLE_EQ(mass(child), 2);
  s.bridge.release(child);
  EXPECT_DOUBLE_EQ(mass(parent), 5);
}

TEST(HandOver, WeighsABoundNodeAnewWhenItsMassIsSet) {
  // The new mass counts at once, on the node's own body or on the one that carries it.
  Stage s;
  const NodeId parent = box(s, s.scene.root(), "parent", Affine::Identity(), 3);
  const NodeId child = s.scene.create(parent, "child");
  ASSERT_FALSE(has_error(s.bridge.hand_over(parent)));
  s.bridge.set_node_body(child, {.mass = box_mass(4, {1, 1, 1})});
  EXPECT_DOUBLE_EQ(s.physics.body(s.bridge.body_of(parent)).mass(), 7);
  s.bridge.set_node_body(parent, {.mass = box_mass(5, {1, 1, 1})});
  EXPECT_DOUBLE_EQ(s.physics.body(s.bridge.body_of(parent)).mass(), 9);
}

TEST(HandOver, DerivesAMassFromGeometryAndSaysSo) {
  // A cube of 1 m at 500 kg/m^3.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "crate");
  s.bridge.set_node_body(id, {.shapes = {Shape{BoxShape{{1, 1, 1}}, Pose{}}}});
  const std::vector<Diagnostic> notes = s.bridge.hand_over(id, Scope::Node, {.density = 500});
  EXPECT_TRUE(says(notes, "crate", "500 kg were derived from 1 shape(s)")) << test::text_of(notes);
  EXPECT_DOUBLE_EQ(s.physics.body(s.bridge.body_of(id)).mass(), 500);
}

TEST(HandOver, RefusesANodeWithoutMassAndGeometry) {
  // Nothing is invented: the error names the node and the two remedies, and nothing is bound.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "empty");
  const std::vector<Diagnostic> notes = s.bridge.hand_over(id);
  ASSERT_TRUE(has_error(notes));
  EXPECT_TRUE(says(notes, "empty", "it has no mass, and neither shapes nor meshes"));
  EXPECT_NE(notes[0].remedy.find("declare a mass"), std::string::npos);
  EXPECT_TRUE(s.physics.bodies().empty());
  EXPECT_TRUE(says(s.bridge.hand_over(s.scene.root()), "/", "there is nothing to simulate"));
}

TEST(HandOver, RefusesNumbersThatOverflow) {
  // Each number is finite, their sum is not: the centre of gravity of this mesh is beyond the greatest
  // double.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "huge");
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = {{0, 0, 0}, {1e160, 0, 0}, {0, 1e160, 0}, {0, 0, 1e160}};
  mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  s.bridge.set_node_body(id, {.meshes = {{"m", mesh, Affine::Identity()}}});
  const std::vector<Diagnostic> notes = s.bridge.hand_over(id);
  EXPECT_TRUE(has_error(notes));
  EXPECT_FALSE(s.bridge.body_of(id));
}

TEST(HandOver, RefusesAMassWithoutInertiaOnAFreeBody) {
  // A point mass cannot turn; on a joint that holds its turning it may be sound.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "point");
  s.bridge.set_node_body(id, {.mass = MassProperties{2, Vector3::Zero(), Matrix3::Zero()}});
  EXPECT_TRUE(says(s.bridge.hand_over(id), "point", "declares a mass but no inertia"));
  EXPECT_TRUE(s.physics.bodies().empty());
  s.scene.set_link(id, test::slider_link("rail", Affine::Identity(), {1, 0, 0}));
  EXPECT_FALSE(has_error(s.bridge.hand_over(id)));
}

TEST(HandOver, KeepsAnImpossibleInertiaWithAWarning) {
  // Principal moments 1, 1, 3 belong to no body, but equations of motion take them: kept as declared, and
  // said.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "odd");
  s.bridge.set_node_body(id, {.mass = MassProperties{2, Vector3::Zero(), Vector3(1, 1, 3).asDiagonal()}});
  const std::vector<Diagnostic> notes = s.bridge.hand_over(id);
  ASSERT_FALSE(has_error(notes));
  EXPECT_TRUE(says(notes, "odd", "exceeds the sum of the others"));
  EXPECT_EQ(s.physics.body(s.bridge.body_of(id)).I_BBcm_B(), Matrix3{Vector3(1, 1, 3).asDiagonal()});
}

TEST(HandOver, JudgesFixedBodiesAsOneComposite) {
  // A member with a negative moment alone is refused; fixed to a body that outweighs it, the sum is sound and
  // is given to the top one: total mass and inertia are those of the sum.
  Stage s;
  const NodeId top = box(s, s.scene.root(), "top", Affine::Identity(), 10);
  const NodeId bad = s.scene.create(top, "bad", moved({0.1, 0, 0}));
  const MassProperties mass{1, Vector3::Zero(), Vector3(0.01, 0.01, -0.01).asDiagonal()};
  s.bridge.set_node_body(bad, {.mass = mass});
  EXPECT_TRUE(says(s.bridge.hand_over(bad), "top/bad", "none may be negative"));
  EXPECT_TRUE(s.physics.bodies().empty());
  Link fixed{.kind = LinkKind::Fixed, .name = "weld", .M_PJ = moved({0.1, 0, 0})};
  s.scene.set_link(bad, fixed);
  const std::vector<Diagnostic> notes = s.bridge.hand_over(top, Scope::Subtree);
  ASSERT_FALSE(has_error(notes)) << test::text_of(notes);
  EXPECT_NE(test::text_of(notes).find("the mass of all that is fixed together was given to 'top'"),
            std::string::npos);
  const MassProperties parts[] = {box_mass(10, {0.3, 0.2, 0.4}), in_frame({.p = {0.1, 0, 0}}, mass)};
  const MassProperties& got = s.physics.body(s.bridge.body_of(top)).mass_properties();
  EXPECT_DOUBLE_EQ(got.mass, 11);
  EXPECT_LT((got.I_BBcm_B - combined(parts).I_BBcm_B).norm(), 1e-14);
  EXPECT_EQ(s.physics.body(s.bridge.body_of(bad)).mass(), 0);
}

TEST(HandOver, RefusesAJointThatMovesNothingAndUndoesEverything) {
  // A massless link on a pivot with nothing behind it has no equation of motion: refused by the path of its
  // node, and everything is as before, the followed one followed.
  Stage s;
  const NodeId base = box(s, s.scene.root(), "base", Affine::Identity());
  const NodeId tip = s.scene.create(base, "tip");
  s.scene.set_link(tip, test::pivot_link("wrist", Affine::Identity(), {0, 0, 1}));
  ASSERT_TRUE(s.bridge.follow(base).empty());
  const std::vector<Affine> before = test::locals(s.scene);
  const std::vector<Diagnostic> notes = s.bridge.hand_over(base, Scope::Subtree);
  ASSERT_TRUE(has_error(notes));
  EXPECT_TRUE(says(notes, "base/tip", "joint 'wrist' moves nothing that resists")) << test::text_of(notes);
  EXPECT_EQ(s.bridge.drive_of(base), Drive::Scene);
  EXPECT_FALSE(s.bridge.drive_of(tip).has_value());
  EXPECT_TRUE(s.physics.joints().empty());
  EXPECT_EQ(s.physics.bodies().size(), 1U);
  EXPECT_TRUE(test::same_bits(before, test::locals(s.scene)));
  EXPECT_TRUE(s.bridge.advance(0.1).last.ok());
}

TEST(HandOver, TakesMasslessLinksThatCarryMass) {
  // A massless link between two masses is sound: its joint moves what is behind it.
  Stage s;
  s.physics.forces().add(Gravity{});
  const NodeId base = box(s, s.scene.root(), "base", Affine::Identity());
  const NodeId elbow = s.scene.create(base, "elbow");
  s.scene.set_link(elbow, test::pivot_link("x", Affine::Identity(), {1, 0, 0}));
  const NodeId tip = box(s, elbow, "tip", Affine::Identity());
  s.scene.set_link(tip, test::pivot_link("y", moved({0, 0, -1}), {0, 1, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(base, Scope::Subtree)));
  EXPECT_EQ(s.physics.joints().size(), 2U);
  EXPECT_TRUE(s.bridge.advance(0.1).last.ok());
}

}  // namespace
}  // namespace pantin
