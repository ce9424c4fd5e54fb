// Playing clips, looking things up, and what the bridge says to callers who are wrong.
#include <pantin/bridge/bridge.hpp>

#include <gtest/gtest.h>

#include <pantin/pantin.hpp>

#include "support/contracts.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::moved;
using test::Stage;
using test::turned;

bool says(const std::vector<Diagnostic>& notes, const std::string& problem) {
  for (const Diagnostic& note : notes) {
    if (note.problem.find(problem) != std::string::npos) return true;
  }
  return false;
}

TEST(Bridge, RunsTheProgramOfTheReadme) {
  // The twenty lines that say how Pantin feels, with a model made here instead of a file: an arm on a fixed
  // base swings for two seconds and is animated again exactly where it is; its energy is that of the start.
  Model arm;
  arm.nodes.push_back({.name = "base", .mass = test::box_mass(5, {1, 1, 1})});
  ModelNode elbow{.name = "elbow", .parent = 0, .mass = test::box_mass(1, {0.1, 0.1, 1}, {0, 0, -0.5})};
  elbow.link = test::pivot_link("elbow", Affine::Identity(), {0, 1, 0}, 1.0);
  elbow.M_PN = local_matrix(*elbow.link, elbow.link->value);
  arm.nodes.push_back(elbow);

  Scene scene;
  PhysicsManager physics;
  Bridge bridge{scene, physics};

  NodeId root = bridge.instantiate(arm, scene.root()).root;
  physics.forces().add(Gravity{.g_W = {0, 0, -9.81}});
  ASSERT_FALSE(has_error(bridge.hand_over(root, Scope::Subtree)));
  const double energy = physics.energy().total();
  for (int frame = 0; frame < 120; ++frame) static_cast<void>(bridge.advance(1.0 / 60));
  const double angle = physics.joint_value(bridge.joint_of(scene.find("base/elbow")));
  EXPECT_NEAR(physics.energy().total(), energy, 1e-6);
  ASSERT_FALSE(has_error(bridge.take_back(root, Scope::Subtree)));
  EXPECT_DOUBLE_EQ(scene.link(scene.find("base/elbow"))->value[0], angle);
}

TEST(Bridge, FindsBodiesJointsAndNodesOfEachOther) {
  // Each look-up is the inverse of the other; what is not bound gives null, not a guess.
  Stage s;
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId b = box(s, a, "b", Affine::Identity());
  const NodeId c = s.scene.create(b, "c");
  s.scene.set_link(b, test::pivot_link("j", Affine::Identity(), {0, 0, 1}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(a, Scope::Subtree)));
  EXPECT_EQ(s.bridge.node_of(s.bridge.body_of(b)), b);
  EXPECT_EQ(s.physics.joint(s.bridge.joint_of(b)).name, "j");
  EXPECT_FALSE(s.bridge.joint_of(a));
  EXPECT_FALSE(s.bridge.body_of(c));
  EXPECT_FALSE(s.bridge.joint_of(c));
  EXPECT_FALSE(s.bridge.drive_of(c).has_value());
  EXPECT_FALSE(s.bridge.node_of(s.physics.add(RigidBodySettings{})));
  EXPECT_EQ(s.bridge.node_body(c), nullptr);
  EXPECT_EQ(s.bridge.bound(), (std::vector<NodeId>{a, b}));
}

TEST(Bridge, PlaysAClipAtOnceAndLetsItGo) {
  // With play() the node is where the clip begins; stopped, it stays where the clip has brought it.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  PlayerSettings settings{.offset = 1};
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}, settings).empty());
  EXPECT_TRUE(s.bridge.is_played(id));
  EXPECT_LT((s.scene.local(id).translation() - Vector3{1, 0.5, 0.2}).norm(), 1e-15);
  static_cast<void>(s.bridge.advance(0.5));
  const Affine there = s.scene.local(id);
  s.bridge.stop_playing(id);
  EXPECT_FALSE(s.bridge.is_played(id));
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_EQ(s.scene.local(id).matrix(), there.matrix());
  EXPECT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
}

TEST(Bridge, StopsAFollowedBodyWithItsClip) {
  // When the clip is stopped the body stands; when one begins, the body jumps to it and has its velocity at
  // once.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_TRUE(s.bridge.follow(id).empty());
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}, {.offset = 1}).empty());
  const auto body = [&] { return s.physics.body(s.bridge.body_of(id)); };
  EXPECT_LT((body().X_WB().p - Vector3{1, 0.5, 0.2}).norm(), 1e-15);
  EXPECT_LT((body().v_WB() - Vector3{0, 1, -1}).norm(), 1e-14);
  static_cast<void>(s.bridge.advance(0.3));
  EXPECT_GT(body().v_WB().norm(), 0.1);
  s.bridge.stop_playing(id);
  EXPECT_EQ(body().v_WB(), Vector3::Zero());
  EXPECT_LT(test::relative_difference(test::by_body(s, id), s.scene.world(id)), 1e-15);
}

TEST(Bridge, RefusesASecondClipOnANode) {
  // One writer: the error names both clips, and the other nodes of the refused clip are not played either.
  Stage s;
  const NodeId a = s.scene.create(s.scene.root(), "a");
  const NodeId b = s.scene.create(s.scene.root(), "b");
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {a}).empty());
  Clip two = test::swinging_clip(0);
  two.name = "two";
  for (const Track& track : test::swinging_clip(1).tracks) two.tracks.push_back(track);
  const std::vector<Diagnostic> notes = s.bridge.play(two, {b, a});
  EXPECT_TRUE(says(notes, "clip 'two' would animate it, but clip 'swing' does already"));
  EXPECT_FALSE(s.bridge.is_played(b));
}

TEST(Bridge, RefusesAClipThatDoesNotFit) {
  // What the scene graph says against a clip or its settings comes back as a diagnostic that names the clip.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "a");
  std::vector<Diagnostic> notes = s.bridge.play(test::link_clip(0, 1, 1), {id});
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].subject, "clip 'link'");
  EXPECT_TRUE(says(notes, "has no link whose value could be animated"));
  notes = s.bridge.play(test::swinging_clip(), {id}, {.offset = 5});
  EXPECT_TRUE(says(notes, "offset"));
  EXPECT_TRUE(s.bridge.play(test::swinging_clip(), {NodeId{}}).empty());  // null targets are left out
}

TEST(Bridge, SetsLinkValuesByWhoeverOwnsTheNode) {
  // Unbound or animated by the local matrix, simulated by the joint, static by a teleport: the value is read
  // back.
  for (const int drive : {0, 1, 2, 3}) {
    Stage s;
    const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
    s.scene.set_link(id, test::pivot_link("j", moved({0, 0, 1}), {0, 1, 0}));
    if (drive == 1) static_cast<void>(s.bridge.follow(id));
    if (drive == 2) static_cast<void>(s.bridge.hand_over(id));
    if (drive == 3) static_cast<void>(s.bridge.fix(id));
    s.bridge.set_link_value(id, 0.8);
    EXPECT_NEAR(s.scene.link(id)->value[0], 0.8, 1e-15);
    EXPECT_LT(test::relative_difference(s.scene.local(id), local_matrix(*s.scene.link(id), 0.8)), 1e-15);
    static_cast<void>(s.bridge.advance(0.1));
    if (drive > 0) {
      EXPECT_LT(test::relative_difference(test::by_body(s, id), s.scene.world(id)), 1e-14) << drive;
    }
  }
}

TEST(Bridge, SetsAFreeLinkOfASimulatedNodeByTeleport) {
  // A free link has no joint: its seven numbers are the pose under the parent, velocity kept.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  s.scene.set_link(
      id, Link{.kind = LinkKind::Free, .M_PJ = moved({0, 0, 2}), .value = zero_value(LinkKind::Free)});
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  s.physics.set_velocity(s.bridge.body_of(id), {1, 0, 0}, {0, 0, 0});
  s.bridge.set_link_value(id, {5, 0, 0, 1, 0, 0, 0});
  EXPECT_LT((s.scene.world(id).translation() - Vector3{5, 0, 2}).norm(), 1e-15);
  static_cast<void>(s.bridge.advance(0.1));
  EXPECT_NEAR(s.scene.link(id)->value[0], 5.1, 1e-13);
}

TEST(Bridge, LetsTheUserTakeOverANodeOnItsWayBack) {
  // Moving a node that is being led back to rest ends the way back: it goes to where the user says.
  Stage s{0.01};
  const NodeId parent = s.scene.create(s.scene.root(), "p");
  const NodeId id = box(s, parent, "a", Affine::Identity());
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {parent}).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  static_cast<void>(s.bridge.advance(0.3));
  ASSERT_TRUE(s.bridge.take_back(id).empty());
  static_cast<void>(s.bridge.advance(0.1));
  s.bridge.set_local(id, moved({0, 0, 4}));
  static_cast<void>(s.bridge.advance(0.1));
  EXPECT_EQ(s.scene.local(id).translation(), (Vector3{0, 0, 4}));
  EXPECT_LT(test::relative_difference(test::by_body(s, id), s.scene.world(id)), 1e-14);
}

TEST(Bridge, BreaksTheContractForIdsThatAreGone) {
  // A stale or null node is a caller's mistake in every verb, said with the verb's name.
  const test::ThrowOnContract guard;
  Stage s;
  const NodeId gone = s.scene.create(s.scene.root(), "gone");
  s.scene.remove(gone);
  const auto message = [](auto call) -> std::string {
    try {
      call();
    } catch (const test::ContractError& error) {
      return error.what();
    }
    return "no contract broken";
  };
  const auto starts = [](const std::string& text, const std::string& with) {
    return text.rfind(with, 0) == 0;
  };
  EXPECT_TRUE(starts(message([&] { static_cast<void>(s.bridge.hand_over(gone)); }), "hand_over: node id"));
  EXPECT_TRUE(starts(message([&] { static_cast<void>(s.bridge.take_back(gone)); }), "take_back: node id"));
  EXPECT_TRUE(starts(message([&] { static_cast<void>(s.bridge.follow(gone)); }), "follow: node id"));
  EXPECT_TRUE(starts(message([&] { static_cast<void>(s.bridge.fix(gone)); }), "fix: node id"));
  EXPECT_TRUE(starts(message([&] { s.bridge.release(gone); }), "release: node id"));
  EXPECT_TRUE(starts(message([&] { s.bridge.remove(gone); }), "remove: node id"));
  EXPECT_TRUE(starts(message([&] { static_cast<void>(s.bridge.teleport(gone, Affine::Identity())); }),
                     "teleport: node id"));
  EXPECT_TRUE(starts(message([&] { static_cast<void>(s.bridge.reparent(gone, s.scene.root())); }),
                     "reparent: node id"));
  EXPECT_TRUE(starts(message([&] { s.bridge.set_local(gone, Affine::Identity()); }), "set_local: node id"));
  EXPECT_TRUE(starts(message([&] { s.bridge.set_node_body(gone, {}); }), "set_node_body: node id"));
  EXPECT_TRUE(starts(message([&] { s.bridge.stop_playing(gone); }), "stop_playing: node id"));
  EXPECT_TRUE(starts(message([&] { static_cast<void>(s.bridge.presented(gone, 0)); }), "presented: node id"));
  EXPECT_TRUE(
      starts(message([&] { s.bridge.set_link_value(s.scene.root(), 1.0); }), "set_link_value: node ''"));
  EXPECT_TRUE(starts(message([&] { static_cast<void>(s.bridge.residual(s.scene.root())); }),
                     "residual: the node is not"));
}

}  // namespace
}  // namespace pantin
