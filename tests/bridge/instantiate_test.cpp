#include <gtest/gtest.h>

#include "support/contracts.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::moved;
using test::Stage;
using test::turned;

/// A base with an arm on a pivot; the base stands 1 m up.
Model robot() {
  Model model{.name = "robot", .format = "urdf"};
  model.nodes.push_back({.name = "base", .M_PN = moved({0, 0, 1}), .mass = test::box_mass(5, {1, 1, 1})});
  ModelNode arm{.name = "arm", .parent = 0};
  arm.link = test::pivot_link("shoulder", moved({0, 0, 1}), {0, 1, 0}, 0.3);
  arm.M_PN = local_matrix(*arm.link, arm.link->value);
  arm.mass = test::box_mass(1, {0.1, 0.1, 1}, {0, 0, 0.5});
  arm.dynamics = LinkDynamics{.damping = 0.7};
  model.nodes.push_back(arm);
  return model;
}

TEST(Instantiate, MakesNodesWithLinksMassesAndDamping) {
  // What the model says of each node is found on the node: names, matrices, links, masses; damping reaches
  // the joint.
  Stage s;
  const Instance instance = s.bridge.instantiate(robot(), s.scene.root());
  ASSERT_EQ(instance.nodes.size(), 2U);
  EXPECT_EQ(instance.root, instance.nodes[0]);
  EXPECT_EQ(s.scene.find("base/arm"), instance.nodes[1]);
  EXPECT_EQ(s.scene.local(instance.nodes[0]).matrix(), moved({0, 0, 1}).matrix());
  EXPECT_EQ(s.scene.link(instance.nodes[1])->name, "shoulder");
  EXPECT_DOUBLE_EQ(s.bridge.node_body(instance.nodes[0])->mass->mass, 5);
  ASSERT_FALSE(has_error(s.bridge.hand_over(instance.root, Scope::Subtree)));
  EXPECT_DOUBLE_EQ(s.physics.joint(s.bridge.joint_of(instance.nodes[1])).damping[0], 0.7);
}

TEST(Instantiate, WeldsAFixedBaseToTheWorldAndLetsAFloatingOneFall) {
  // The same robot under gravity for 0.5 s: fixed it stands, floating it falls 1.25 m as one (its only joint
  // feels no gravity in free fall).
  for (const Base base : {Base::Fixed, Base::Floating}) {
    Stage s{0.01};
    s.physics.forces().add(Gravity{.g_W = {0, 0, -10}});
    const Instance instance = s.bridge.instantiate(robot(), s.scene.root(), {.base = base});
    ASSERT_FALSE(has_error(s.bridge.hand_over(instance.root, Scope::Subtree)));
    static_cast<void>(s.bridge.advance(0.5));
    const double fallen = base == Base::Fixed ? 0 : 1.25;
    EXPECT_NEAR(s.scene.world(instance.nodes[0]).translation().z(), 1 - fallen, 1e-12);
    EXPECT_EQ(static_cast<bool>(s.bridge.joint_of(instance.nodes[0])), base == Base::Fixed);
    if (base == Base::Floating) {
      EXPECT_NEAR(s.scene.link(instance.nodes[0])->value[2], -1.25, 1e-12);
    } else {
      EXPECT_GT(std::abs(s.scene.link(instance.nodes[1])->value[0] - 0.3), 0.1);
    }
  }
}

TEST(Instantiate, PutsAPrefixNodeAboveWithThePlacement) {
  // The prefix carries the rotation of another up axis; it is no body, and the fixed base is welded to the
  // world below it.
  Stage s;
  const Affine up = turned(std::acos(0.0), {1, 0, 0});
  const Instance instance = s.bridge.instantiate(robot(), s.scene.root(), {.prefix = "r1", .M_PM = up});
  EXPECT_EQ(s.scene.path(instance.root), "r1");
  EXPECT_EQ(s.scene.find("r1/base/arm"), instance.nodes[1]);
  EXPECT_EQ(s.scene.local(instance.root).matrix(), up.matrix());
  ASSERT_FALSE(has_error(s.bridge.hand_over(instance.root, Scope::Subtree)));
  EXPECT_EQ(s.bridge.bound(), instance.nodes);
  EXPECT_FALSE(s.physics.joint(s.bridge.joint_of(instance.nodes[0])).a);
}

TEST(Instantiate, OfAMasslessTopWithAFixedMassBelowFloatsAsOne) {
  // Many robots begin with an empty link that the base is fixed to: floating, the pair is one body of the
  // base's mass.
  Model model;
  model.nodes.push_back({.name = "footprint"});
  ModelNode base{.name = "base", .parent = 0, .mass = test::box_mass(2, {1, 1, 1})};
  base.link = Link{.kind = LinkKind::Fixed, .name = "weld", .M_PJ = moved({0, 0, 0.1})};
  base.M_PN = moved({0, 0, 0.1});
  model.nodes.push_back(base);
  Stage s{0.01};
  s.physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  const Instance instance = s.bridge.instantiate(model, s.scene.root(), {.base = Base::Floating});
  ASSERT_FALSE(has_error(s.bridge.hand_over(instance.root, Scope::Subtree)));
  static_cast<void>(s.bridge.advance(0.1));
  EXPECT_NEAR(s.scene.world(instance.nodes[0]).translation().z(), -0.05, 1e-13);
  EXPECT_NEAR(s.scene.world(instance.nodes[1]).translation().z(), 0.05, 1e-13);
}

TEST(Instantiate, OfSeveralTopNodesHasTheParentForRoot) {
  // Without a prefix there is no node that holds them all but the parent.
  Model model;
  model.nodes.push_back({.name = "a"});
  model.nodes.push_back({.name = "b"});
  Stage s;
  EXPECT_EQ(s.bridge.instantiate(model, s.scene.root()).root, s.scene.root());
  EXPECT_EQ(s.scene.link(s.scene.find("a")), nullptr);
}

TEST(Instantiate, NeedsAPrefixForAPlacement) {
  // The placement needs a node to be on; parents come before children.
  const test::ThrowOnContract guard;
  Stage s;
  EXPECT_THROW(static_cast<void>(s.bridge.instantiate(robot(), s.scene.root(), {.M_PM = moved({1, 0, 0})})),
               test::ContractError);
  Model model;
  model.nodes.push_back({.name = "a", .parent = 1});
  EXPECT_THROW(static_cast<void>(s.bridge.instantiate(model, s.scene.root())), test::ContractError);
}

}  // namespace
}  // namespace pantin
