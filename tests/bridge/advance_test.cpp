// Time: updates, toggles, players at physics time, failing steps, forces of one call.
#include <gtest/gtest.h>

#include "support/contracts.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::moved;
using test::Stage;

TEST(Advance, TakesWholeStepsAndCarriesTheRest) {
  // 0.25 s in steps of 0.1 s: two updates; the next 0.05 s complete a third.
  Stage s{0.1};
  AdvanceReport report = s.bridge.advance(0.25);
  EXPECT_EQ(report.updates, 2);
  EXPECT_DOUBLE_EQ(report.time, 0.2);
  EXPECT_NEAR(s.bridge.clock().rest(), 0.05, 1e-15);
  report = s.bridge.advance(0.05);
  EXPECT_EQ(report.updates, 1);
  EXPECT_DOUBLE_EQ(s.physics.time(), 3 * 0.1);
}

TEST(Advance, ReportsWhatTheCapDropped) {
  // One second in steps of 0.1 s with at most 4 updates drops 0.6 s, in this report only.
  Scene scene;
  PhysicsManager physics;
  Bridge bridge{scene, physics, {.step = 0.1, .max_updates = 4}};
  EXPECT_NEAR(bridge.advance(1.0).dropped, 0.6, 1e-12);
  EXPECT_EQ(bridge.advance(0.1).dropped, 0);
}

TEST(Advance, StridesWhereTheIntegratorChoosesItsSteps) {
  // A body at rest and one that flies straight need one evaluation after another of nothing: with a
  // tolerance, 1,000 steps that are due go as one update that is cut only as the first guess grows; a toggle
  // still cuts it. The straight line is the oracle.
  Stage s{0.001};
  s.physics.set_integrator(make_integrator("gauss8", 1e-9));
  s.bridge.set_stepping(Stepping::Adaptive);
  const NodeId rests = box(s, s.scene.root(), "rests", moved({5, 0, 0}));
  const NodeId flies = box(s, s.scene.root(), "flies", Affine::Identity());
  ASSERT_TRUE(s.bridge.hand_over(rests).empty());
  ASSERT_TRUE(s.bridge.hand_over(flies).empty());
  s.physics.set_velocity(s.bridge.body_of(flies), {2, 0, 0}, {0, 0, 0});
  AdvanceReport report = s.bridge.advance(1.0005);
  EXPECT_EQ(report.updates, 1);
  EXPECT_DOUBLE_EQ(report.longest_update, 1.0);
  EXPECT_GE(report.inner_steps, 1);
  EXPECT_LT(report.inner_steps, 10);
  EXPECT_GT(report.shortest_step, 0.05);
  EXPECT_DOUBLE_EQ(report.time, 1.0);
  EXPECT_NEAR(s.bridge.clock().rest(), 0.0005, 1e-12);
  EXPECT_NEAR(s.scene.world(flies).translation().x(), 2.0, 1e-13);
  EXPECT_EQ(s.scene.world(rests).translation(), Vector3(5, 0, 0));
  s.bridge.schedule({.time = 1.25, .node = flies, .drive = Drive::Scene});
  report = s.bridge.advance(1.0);
  EXPECT_EQ(report.updates, 2);
  EXPECT_NEAR(s.scene.world(flies).translation().x(), 2.5, 1e-13);
}

TEST(Advance, StepsEvenlyWhereTheIntegratorKeepsToNoTolerance) {
  // Adaptive stepping asks the integrator; rk4 takes the steps it is given.
  Stage s{0.1};
  s.bridge.set_stepping(Stepping::Adaptive);
  const AdvanceReport report = s.bridge.advance(0.55);
  EXPECT_EQ(report.updates, 5);
  EXPECT_NEAR(report.longest_update, 0.1, 1e-15);
}

TEST(Advance, SamplesPlayersAtPhysicsTimeOnly) {
  // The rest that is carried over moves no node: after 0.25 s in steps of 0.1 s the clip stands at 0.2 s.
  Stage s{0.1};
  const NodeId id = s.scene.create(s.scene.root(), "a");
  Track track{.target = 0, .channel = Channel::Translation, .times = {0, 1}, .values = {0, 0, 0, 10, 0, 0}};
  ASSERT_TRUE(s.bridge.play({.name = "go", .duration = 1, .tracks = {track}}, {id}).empty());
  static_cast<void>(s.bridge.advance(0.25));
  EXPECT_NEAR(s.scene.local(id).translation().x(), 2, 1e-14);
}

TEST(Advance, PlaysAClipFromTheTimeItWasStarted) {
  // play() begins now, whatever the physics time: at 0.5 s a clip starts, at 0.7 s it stands at 0.2 s of it.
  Stage s{0.1};
  const NodeId id = s.scene.create(s.scene.root(), "a");
  static_cast<void>(s.bridge.advance(0.5));
  Track track{.target = 0, .channel = Channel::Translation, .times = {0, 1}, .values = {0, 0, 0, 10, 0, 0}};
  ASSERT_TRUE(s.bridge.play({.name = "go", .duration = 1, .tracks = {track}}, {id}).empty());
  static_cast<void>(s.bridge.advance(0.2));
  EXPECT_NEAR(s.scene.local(id).translation().x(), 2, 1e-13);
}

TEST(Advance, LandsOnTogglesExactly) {
  // A toggle at 0.123456 s: the node flies with the clip's velocity of that very time, and is taken back at
  // 0.3 s. The free flight between is a straight line: its closed form is the oracle.
  Stage s{0.1};
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  s.bridge.schedule({.time = 0.123456, .node = id, .scope = Scope::Node, .drive = Drive::Physics});
  s.bridge.schedule({.time = 0.3, .node = id, .scope = Scope::Node, .drive = Drive::Scene});
  const Player player{s.scene, test::swinging_clip(), {id}};
  const LocalMotion m = player.motion(id, 0.123456);
  const AdvanceReport first = s.bridge.advance_until(0.25);
  EXPECT_EQ(first.updates, 4);  // 0.1, the toggle, 0.2, 0.25
  EXPECT_EQ(s.bridge.drive_of(id), Drive::Physics);
  const Vector3 p = m.value.col(3) + (0.25 - 0.123456) * m.first.col(3);
  EXPECT_LT((s.scene.world(id).translation() - p).norm(), 1e-13);
  static_cast<void>(s.bridge.advance_until(0.3));
  EXPECT_EQ(s.bridge.drive_of(id), Drive::Scene);
}

TEST(Advance, ReportsTogglesThatCannotBeDone) {
  // The diagnostics of a verb that fell due are in the report; a toggle of a removed node is said to be void.
  Stage s{0.1};
  const NodeId empty = s.scene.create(s.scene.root(), "empty");
  const NodeId gone = s.scene.create(s.scene.root(), "gone");
  s.bridge.schedule({.time = 0.1, .node = empty, .drive = Drive::Physics});
  s.bridge.schedule({.time = 0.1, .node = gone, .drive = Drive::Physics});
  s.bridge.schedule({.time = 0.15, .node = empty, .scope = Scope::Node, .drive = Drive::Static});
  s.bridge.remove(gone);
  const AdvanceReport report = s.bridge.advance(0.2);
  ASSERT_EQ(report.notes.size(), 2U) << test::text_of(report.notes);
  EXPECT_EQ(report.notes[0].severity, Severity::Error);
  EXPECT_EQ(report.notes[0].place, "empty");
  EXPECT_NE(report.notes[1].problem.find("its node was removed from the scene"), std::string::npos);
  EXPECT_EQ(s.bridge.drive_of(empty), Drive::Static);
}

TEST(Advance, StopsAtAFailingStepAndLeavesTheSceneValid) {
  // A force that is too large for a double makes the step fail: it is reported with the path of the node, the
  // scene keeps finite matrices, and the next call may go on once the force is gone.
  Stage s{0.1};
  const NodeId id = box(s, s.scene.root(), "victim", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  s.physics.apply_force(s.bridge.body_of(id), {1e308, 0, 0});
  s.physics.apply_force(s.bridge.body_of(id), {1e308, 0, 0});
  const AdvanceReport report = s.bridge.advance(0.5);
  EXPECT_FALSE(report.last.ok());
  EXPECT_EQ(report.updates, 0);
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_EQ(report.notes[0].place, "victim");
  EXPECT_NE(report.notes[0].problem.find("no longer finite"), std::string::npos);
  EXPECT_TRUE(s.scene.world(id).matrix().allFinite());
  EXPECT_TRUE(s.bridge.advance(0.1).last.ok());
}

TEST(Advance, AppliesUserForcesToEveryUpdateOfOneCall) {
  // 2 N on 1 kg for 0.5 s: 1 m/s; in the next call nothing acts.
  Stage s{0.1};
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  s.physics.apply_force(s.bridge.body_of(id), {2, 0, 0});
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_NEAR(s.physics.body(s.bridge.body_of(id)).v_WBcm().x(), 1, 1e-14);
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_NEAR(s.physics.body(s.bridge.body_of(id)).v_WBcm().x(), 1, 1e-14);
}

TEST(Advance, SaysOnceThatAnAncestorHasBecomeSingular) {
  // A clip squeezes the parent flat while the child is simulated: the child keeps its last local matrix, said
  // once per call, and is written again when the parent is solid.
  Stage s{0.1};
  const NodeId parent = s.scene.create(s.scene.root(), "press");
  const NodeId id = box(s, parent, "a", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  s.physics.set_velocity(s.bridge.body_of(id), {1, 0, 0}, {0, 0, 0});
  static_cast<void>(s.bridge.advance(0.1));
  const Affine last = s.scene.local(id);
  s.scene.set_local(parent, test::scaled({1, 1, 0}));
  const AdvanceReport report = s.bridge.advance(0.3);
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_EQ(report.notes[0].place, "press/a");
  EXPECT_NE(report.notes[0].problem.find("has become singular"), std::string::npos);
  EXPECT_EQ(s.scene.local(id).matrix(), last.matrix());
  s.scene.set_local(parent, Affine::Identity());
  EXPECT_TRUE(s.bridge.advance(0.1).notes.empty());
  EXPECT_NEAR(s.scene.world(id).translation().x(), 0.5, 1e-14);
}

TEST(Advance, MeetsPhysicsThatWasSteppedOrSetBack) {
  // A snapshot is restored between two calls: the clock counts on from the state's time, bit for bit as
  // before.
  Stage s{0.1};
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  s.physics.forces().add(Gravity{});
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  static_cast<void>(s.bridge.advance(0.2));
  const State state = s.physics.snapshot();
  static_cast<void>(s.bridge.advance(0.3));
  const Affine later = s.scene.world(id);
  s.physics.restore(state);
  static_cast<void>(s.bridge.advance(0.3));
  EXPECT_EQ(s.scene.world(id).matrix(), later.matrix());
}

TEST(Advance, LeavesTheScenesWorldMatricesUpToDate) {
  // After the call the span of world matrices is current, without another update.
  Stage s{0.1};
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  s.physics.set_velocity(s.bridge.body_of(id), {1, 0, 0}, {0, 0, 0});
  static_cast<void>(s.bridge.advance(0.2));
  EXPECT_EQ(s.scene.worlds()[s.scene.index_of(id)].affine().matrix(), s.scene.world(id).matrix());
}

TEST(Advance, IsTheSameTwice) {
  // Same scene, same calls: the same bits, toggles and clips included.
  std::array<std::uint64_t, 2> hashes{};
  for (std::uint64_t& result : hashes) {
    Stage s{0.01};
    s.physics.forces().add(Gravity{});
    const NodeId base = box(s, s.scene.root(), "base", Affine::Identity());
    for (int k = 0; k < 5; ++k) {
      const NodeId arm = box(s, base, "arm" + std::to_string(k), Affine::Identity(), 1, {0.3, 0, 0});
      s.scene.set_link(arm, test::pivot_link("j" + std::to_string(k), moved({0.1 * k, 0, 0}), {0, 1, 0}));
    }
    ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {base}).empty());
    ASSERT_TRUE(s.bridge.follow(base).empty());
    ASSERT_FALSE(has_error(s.bridge.hand_over(base, Scope::Subtree)));
    ASSERT_TRUE(s.bridge.take_back(base).empty());
    static_cast<void>(s.bridge.advance(0.77));
    result = hash(s.physics.snapshot());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Advance, BreaksTheContractForTimesThatMeanNothing) {
  // Negative time, a past toggle, a stale node: one message each, through the replaceable handler.
  const test::ThrowOnContract guard;
  Stage s{0.1};
  const NodeId id = s.scene.create(s.scene.root(), "a");
  EXPECT_THROW(static_cast<void>(s.bridge.advance(-1)), test::ContractError);
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_THROW(static_cast<void>(s.bridge.advance_until(0.2)), test::ContractError);
  EXPECT_THROW(s.bridge.schedule({.time = 0.1, .node = id}), test::ContractError);
  EXPECT_THROW(s.bridge.schedule({.time = 0.9, .node = NodeId{}}), test::ContractError);
  EXPECT_THROW(s.bridge.set_step(0), test::ContractError);
}

}  // namespace
}  // namespace pantin
