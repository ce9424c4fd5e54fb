// Links that mimic others while simulated: geared by physics as long as both are.
#include <gtest/gtest.h>

#include <cmath>

#include "support/stage.hpp"

namespace pantin {
namespace {

using test::says;
using test::Stage;

/// A gripper on the ground: a palm's crank "drive" about y, and two fingers along x that mimic it, by 0.1 and
/// -0.1 m/rad, from 0.02 and -0.02 m on; the second one over the first: -first.
struct Gripper {
  static constexpr double kCrank = 0.02, kFinger = 0.5;  ///< [kg m^2], [kg]

  explicit Gripper(double scale = 1) {
    Model model{.name = "gripper"};
    model.nodes.push_back({.name = "palm"});
    const auto add = [&](Link link, std::optional<LinkMimic> rule, const MassProperties& mass) {
      link.mimic = std::move(rule);
      model.nodes.push_back({.name = link.name, .parent = 0, .link = link, .mass = mass});
    };
    MassProperties crank;
    crank.mass = 1;
    crank.I_BBcm_B = Vector3{kCrank, kCrank, kCrank}.asDiagonal();
    const auto finger = [](const char* name) {
      return test::slider_link(name, Affine::Identity(), Vector3::UnitX());
    };
    // The second finger comes first, so that nothing depends on the order of leaders and followers.
    add(finger("right"), LinkMimic{"left", -1, 0}, test::box_mass(kFinger, {0.1, 0.1, 0.1}));
    add(test::pivot_link("drive", Affine::Identity(), Vector3::UnitY()), std::nullopt, crank);
    add(finger("left"), LinkMimic{"drive", 0.1, 0.02}, test::box_mass(kFinger, {0.1, 0.1, 0.1}));
    const InstantiateSettings settings{.prefix = "g", .M_PM = test::scaled({scale, scale, scale})};
    nodes = s.bridge.instantiate(model, s.scene.root(), settings).nodes;
    right = nodes[1], drive = nodes[2], left = nodes[3];
    s.bridge.set_link_value(drive, 0);
  }
  [[nodiscard]] double joint(NodeId id) const { return s.physics.joint_value(s.bridge.joint_of(id)); }
  [[nodiscard]] std::string path(NodeId id) const { return s.scene.path(id); }
  [[nodiscard]] double value(NodeId id) const { return s.scene.link(id)->value[0]; }
  /// A second under a torque about y on the crank.
  void squeeze(double torque) {
    for (int i = 0; i < 10; ++i) {
      s.physics.apply_torque(s.bridge.body_of(drive), {0, torque, 0});
      ASSERT_TRUE(s.bridge.advance(0.1).last.ok());
    }
  }

  Stage s{1.0 / 100};
  std::vector<NodeId> nodes{};
  NodeId right{}, drive{}, left{};
};

TEST(MimicGears, CloseAGripperEvenly) {
  // All three move as one of the reduced inertia I + 2 m 0.1^2, both fingers by the same way; the
  // acceleration is constant, so that rk4 is exact. Nothing is said that the user need know.
  Gripper g;
  const std::vector<Diagnostic> notes = g.s.bridge.hand_over(g.nodes[0], Scope::Subtree);
  EXPECT_TRUE(notes.empty()) << to_string(notes.front());
  EXPECT_EQ(g.s.physics.couplings().size(), 2u);
  g.squeeze(0.06);
  const double rate = 0.06 / (Gripper::kCrank + 2 * Gripper::kFinger * 0.01);
  EXPECT_NEAR(g.value(g.drive), rate / 2, 1e-12);
  EXPECT_NEAR(g.value(g.left), 0.1 * rate / 2 + 0.02, 1e-12);
  EXPECT_NEAR(g.value(g.right), -g.value(g.left), 1e-14);
  EXPECT_NEAR(g.s.scene.world(g.right).translation().x(), -g.value(g.left), 1e-14);
}

TEST(MimicGears, SpeakInTheUnitsOfTheLinks) {
  // Under a scale of 2 a finger moves two metres for one unit of its value; the rule is one of values.
  Gripper g{2};
  ASSERT_FALSE(has_error(g.s.bridge.hand_over(g.nodes[0], Scope::Subtree)));
  g.squeeze(0.06);
  EXPECT_GT(g.value(g.drive), 0.1);
  EXPECT_NEAR(g.value(g.left), 0.1 * g.value(g.drive) + 0.02, 1e-13);
  EXPECT_NEAR(g.joint(g.left), 2 * g.value(g.left), 1e-13);
  EXPECT_NEAR(g.value(g.right), -g.value(g.left), 1e-13);
}

TEST(MimicGears, ComeAndGoWithHandOver) {
  // In whatever order nodes are handed over and taken back, those of which both are simulated are geared;
  // over an animated finger in between, which follows, the other one is geared to the crank. What loses its
  // leader says so, and so does what never had one.
  const auto lost = "what it mimics is not simulated any more";
  const auto alone = "1 joint(s) here mimic another, which is not held";
  Gripper g;
  Bridge& bridge = g.s.bridge;
  EXPECT_TRUE(says(bridge.hand_over(g.right), g.path(g.right), alone));
  EXPECT_EQ(g.s.physics.couplings().size(), 0u);
  EXPECT_TRUE(bridge.hand_over(g.drive).empty());
  ASSERT_EQ(g.s.physics.couplings().size(), 1u) << "over the animated one";
  g.squeeze(0.06);
  EXPECT_NEAR(g.value(g.right), -0.1 * g.value(g.drive) - 0.02, 1e-13);
  EXPECT_NEAR(g.value(g.left), -g.value(g.right), 1e-13) << "follows";
  EXPECT_TRUE(bridge.hand_over(g.left).empty());
  EXPECT_EQ(g.s.physics.couplings().size(), 2u);
  g.squeeze(-0.06);
  EXPECT_NEAR(g.value(g.right), -0.1 * g.value(g.drive) - 0.02, 1e-13);
  EXPECT_TRUE(says(bridge.take_back(g.drive), g.path(g.left), lost));
  EXPECT_EQ(g.s.physics.couplings().size(), 1u) << "of the fingers";
  ASSERT_TRUE(bridge.advance(0.1).last.ok());
  EXPECT_NEAR(g.joint(g.right), -g.joint(g.left), 1e-14);
  EXPECT_TRUE(bridge.take_back(g.left).size() == 1);
  EXPECT_EQ(g.s.physics.couplings().size(), 0u);
  bridge.take_back(g.right);
  g.s.bridge.set_link_value(g.drive, 0.3);
  EXPECT_TRUE(bridge.hand_over(g.nodes[0], Scope::Subtree).empty());
  EXPECT_EQ(g.s.physics.couplings().size(), 2u);
  bridge.remove(g.left);
  EXPECT_EQ(g.s.physics.couplings().size(), 0u);
  ASSERT_TRUE(bridge.advance(0.1).last.ok());
}

TEST(MimicGears, LetEachMoveTheOther) {
  // Set on the leader or on a follower, the rule holds on all, joints and links.
  Gripper g;
  ASSERT_FALSE(has_error(g.s.bridge.hand_over(g.nodes[0], Scope::Subtree)));
  EXPECT_TRUE(g.s.bridge.set_link_value(g.drive, 0.5).empty());
  EXPECT_NEAR(g.value(g.left), 0.07, 1e-14);
  EXPECT_NEAR(g.value(g.right), -0.07, 1e-14);
  EXPECT_TRUE(g.s.bridge.set_link_value(g.right, -0.12).empty());
  EXPECT_NEAR(g.value(g.drive), 1, 1e-13);
  EXPECT_NEAR(g.joint(g.left), 0.12, 1e-14);
}

TEST(MimicGears, SayThatTheyBringJointsTogether) {
  // A finger that was set itself stands 0.1 m off when both are handed over: it is said, and the rule holds.
  Gripper g;
  g.s.bridge.set_link_value(g.right, 0.08);
  const std::vector<Diagnostic> notes = g.s.bridge.hand_over(g.nodes[0], Scope::Subtree);
  EXPECT_TRUE(says(notes, g.path(g.right), "it stands 0.100000 (rad or m) off what it mimics"));
  ASSERT_TRUE(g.s.bridge.advance(0.1).last.ok());
  EXPECT_NEAR(g.value(g.right), -g.value(g.left), 1e-13);
}

TEST(MimicGears, LeaveOutARuleThatContradictsAnother) {
  // Two that mimic each other by x = y and y = x + 1 cannot both be held: the one that cannot is named, and
  // the model is simulated without it.
  Stage s;
  Model model{.name = "m"};
  model.nodes.push_back({.name = "base"});
  for (const auto& [name, other, offset] : {std::tuple{"x", "y", 0.0}, {"y", "x", 1.0}}) {
    Link link = test::slider_link(name, Affine::Identity(), Vector3::UnitX());
    link.mimic = LinkMimic{other, 1, offset};
    model.nodes.push_back(
        {.name = name, .parent = 0, .link = link, .mass = test::box_mass(1, {0.1, 0.1, 0.1})});
  }
  const Instance m = s.bridge.instantiate(model, s.scene.root());
  const std::vector<Diagnostic> notes = s.bridge.hand_over(m.nodes[0], Scope::Subtree);
  EXPECT_FALSE(has_error(notes));
  EXPECT_TRUE(says(notes, s.scene.path(m.nodes[1]), "cannot be met") ||
              says(notes, s.scene.path(m.nodes[2]), "cannot be met"))
      << test::text_of(notes);
  EXPECT_EQ(s.physics.couplings().size(), 1u);
  EXPECT_TRUE(s.bridge.advance(0.1).last.ok());
  EXPECT_LT(s.physics.joint_drift().distance, 1e-13);
}

}  // namespace
}  // namespace pantin
