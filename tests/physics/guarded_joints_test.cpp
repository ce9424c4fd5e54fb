// Stops and dry friction in everything that joints take part in: loops, snapshots, lanes, adaptive steps.
#include <gtest/gtest.h>

#include <cmath>
#include <support/allocation_guard.hpp>

#include <pantin/physics/constraints/universal.hpp>

#include "support/four_bar.hpp"
#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::facing;
using test::joint_here;
using test::run;

/// Rods on pivots with stops and dry friction, some of which are always held, stuck or sliding.
struct BrakedChain {
  explicit BrakedChain(const char* integrator) {
    physics.set_integrator(make_integrator(integrator));
    physics.forces().add(Gravity{});
    BodyId above;
    for (int i = 0; i < 6; ++i) {
      const Vector3 at{0.3 * i, 0, 0};
      const BodyId rod = physics.add(RigidBodySettings{
          .name = "rod", .X_WB = {at, Quaternion::Identity()}, .mass = test::lopsided_mass(1 + 0.1 * i)});
      const Vector3 axis = Vector3{0.2 * i, 1, 0.1 * i * i}.normalized();
      if (i == 3) {
        UniversalSettings settings = joint_here<UniversalSettings>(physics, above, rod, {at, facing(axis)});
        settings.axes[0] = {.lower = -0.4, .upper = 0.4, .restitution = 0.5, .friction = 0.2};
        settings.axes[1] = {.friction = 0.1};
        joints.push_back(physics.add(std::move(settings)));
      } else {
        PivotSettings settings = joint_here<PivotSettings>(physics, above, rod, {at, facing(axis)});
        settings.axis = {.lower = -0.5, .upper = 0.6, .restitution = 0.3, .friction = i % 2 == 0 ? 0.4 : 0};
        joints.push_back(physics.add(std::move(settings)));
      }
      above = rod;
    }
  }
  [[nodiscard]] bool is_guarded(AxisMode mode) const {
    return std::any_of(joints.begin(), joints.end(),
                       [&](JointId id) { return physics.axis_mode(id) == mode; });
  }
  PhysicsManager physics{};
  std::vector<JointId> joints{};
};

TEST(GuardedJoints, GoOnFromASnapshotToTheBit) {
  // Modes are part of the state: a manager that goes back repeats every bit, and so does an equal one.
  for (const char* integrator : {"rk4", "gauss8"}) {
    BrakedChain chain{integrator}, other{integrator};
    ASSERT_TRUE(run(chain.physics, 0.01, 60));
    ASSERT_TRUE(run(other.physics, 0.01, 60));
    EXPECT_EQ(chain.physics.snapshot(), other.physics.snapshot());
    const State state = chain.physics.snapshot();
    ASSERT_TRUE(run(chain.physics, 0.01, 60));
    const State first = chain.physics.snapshot();
    chain.physics.restore(state);
    ASSERT_TRUE(run(chain.physics, 0.01, 60));
    EXPECT_EQ(chain.physics.snapshot(), first);
    EXPECT_EQ(hash(chain.physics.snapshot()), hash(first));
    EXPECT_NE(first.time, state.time);
  }
}

TEST(GuardedJoints, MoveAlikeWithEveryAccurateIntegrator) {
  // Gauss in lanes (with masks for what is locked), Gauss of other order and Dormand-Prince stage by stage
  // find the same events and the same motion, to their tolerances magnified by the blows.
  BrakedChain lanes{"gauss16"}, other{"dormand-prince"};
  other.physics.set_integrator(make_integrator("dormand-prince", 1e-11));
  int events = 0;
  for (int i = 0; i < 50; ++i) {
    const StepReport a = lanes.physics.step(0.01), b = other.physics.step(0.01);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(a.joint_events, b.joint_events) << "at " << a.time;
    events += a.joint_events;
  }
  EXPECT_GE(events, 5);
  for (std::size_t j = 0; j < lanes.joints.size(); ++j) {
    EXPECT_NEAR(lanes.physics.joint_value(lanes.joints[j])[0], other.physics.joint_value(other.joints[j])[0],
                1e-7);
  }
}

TEST(GuardedJoints, NeedNoShortSteps) {
  // In steps of 0.1 s an integrator that chooses its own finds the events, ten and more in a step, that short
  // steps find.
  BrakedChain coarse{"gauss16"}, fine{"gauss16"};
  int most = 0;
  for (int i = 0; i < 5; ++i) {
    const StepReport report = coarse.physics.step(0.1);
    ASSERT_TRUE(report.ok()) << report.message;
    EXPECT_EQ(report.crowded, 0);
    most = std::max(most, report.joint_events);
  }
  EXPECT_GE(most, 10);
  ASSERT_TRUE(run(fine.physics, 0.01, 50));
  for (std::size_t j = 0; j < coarse.joints.size(); ++j) {
    EXPECT_NEAR(coarse.physics.joint_value(coarse.joints[j])[0], fine.physics.joint_value(fine.joints[j])[0],
                1e-7);
  }
}

TEST(GuardedJoints, StopALoop) {
  // A four-bar whose crank meets a stop after 1 rad: until then it moves as without one, whose time is known
  // by quadrature, and bounces with restitution 1 so that it comes back to where it began in the same time.
  test::FourBar bar;
  PhysicsManager& physics = bar.physics;
  physics.set_integrator(make_integrator("gauss16"));
  const JointDefinition& base = physics.joint(bar.joints[0]);
  PivotSettings pivot{.name = "base", .a = base.a, .b = base.b, .X_AJ = base.X_AJ, .X_BJ = base.X_BJ};
  pivot.axis = {.upper = 1, .restitution = 1};
  physics.remove(bar.joints[0]);
  bar.joints[0] = physics.add(std::move(pivot));
  EXPECT_TRUE(physics.unguarded_axes().empty());
  const double there =
      test::FourBar::time(test::FourBar::kStart, test::FourBar::kRate, test::FourBar::kStart + 1);
  int hits = 0;
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(physics.step(2 * there / 10).ok());
    for (const JointEvent& event : physics.joint_events()) {
      EXPECT_NEAR(event.time, there, 1e-9);
      ++hits;
    }
  }
  EXPECT_EQ(hits, 1);
  EXPECT_NEAR(physics.joint_value(bar.joints[0]), 0, 1e-8);
  EXPECT_NEAR(physics.joint_rate(bar.joints[0]), -test::FourBar::kRate, 1e-7);
  EXPECT_LT(physics.joint_drift().distance, 1e-12);
}

TEST(GuardedJoints, AllocateNothingAtRestOnStops) {
  // Once everything that a chain has come to rest on is held or stuck, steps allocate nothing.
  for (const char* integrator : {"rk4", "gauss8"}) {
    BrakedChain chain{integrator};
    ASSERT_TRUE(run(chain.physics, 0.01, 1500));
    EXPECT_TRUE(chain.is_guarded(AxisMode::HeldUpper) || chain.is_guarded(AxisMode::HeldLower));
    const std::size_t before = test::allocations_so_far();
    ASSERT_TRUE(run(chain.physics, 0.01, 20));
    EXPECT_EQ(test::allocations_so_far(), before) << integrator;
  }
}

TEST(GuardedJoints, StayWhereTheyStartBeyondAStop) {
  // A slider that starts 0.2 m beyond its upper stop may not go on, but back; once it is inside, the stop is
  // the stop.
  PhysicsManager physics;
  physics.set_integrator(make_integrator("gauss16"));
  MassProperties mass;
  mass.mass = 1;
  const BodyId block = physics.add(RigidBodySettings{.name = "block", .mass = mass});
  SliderSettings settings =
      joint_here<SliderSettings>(physics, BodyId{}, block, {{0, 0, 0}, facing({1, 0, 0})});
  settings.axis = {.upper = 1};
  const JointId slider = physics.add(std::move(settings));
  physics.set_joint_value(slider, 1.2);
  physics.apply_force(block, {1, 0, 0});
  ASSERT_TRUE(run(physics, 0.1, 10));
  EXPECT_EQ(physics.joint_value(slider), 1.2);
  physics.clear_accumulators();
  physics.apply_force(block, {-1, 0, 0});
  ASSERT_TRUE(run(physics, 0.1, 10));
  EXPECT_NEAR(physics.joint_value(slider), 0.7, 1e-12);
  physics.clear_accumulators();
  physics.apply_force(block, {5, 0, 0});
  ASSERT_TRUE(run(physics, 0.1, 20));
  EXPECT_NEAR(physics.joint_value(slider), 1, 1e-12);
}

TEST(GuardedJoints, AnswerImpulsesAtOnce) {
  // A block that leans on a stop is struck into it: the stop takes all of the impulse, and the velocity is
  // zero when the step returns. Struck off it, it leaves with J / m.
  PhysicsManager physics;
  MassProperties mass;
  mass.mass = 2;
  const BodyId block = physics.add(RigidBodySettings{.name = "block", .mass = mass});
  SliderSettings settings =
      joint_here<SliderSettings>(physics, BodyId{}, block, {{0, 0, 0}, facing({1, 0, 0})});
  settings.axis = {.lower = 0, .restitution = 0.5};
  const JointId slider = physics.add(std::move(settings));
  physics.apply_force(block, {-1, 0, 0});
  ASSERT_TRUE(run(physics, 0.01, 2));
  physics.apply_impulse(block, {-3, 0, 0});
  ASSERT_TRUE(run(physics, 0.01, 1));
  EXPECT_EQ(physics.joint_rate(slider), 0);
  EXPECT_EQ(physics.body(block).linear_momentum(), Vector3::Zero());
  physics.apply_impulse(block, {3, 0, 0});
  ASSERT_TRUE(run(physics, 0.01, 1));
  EXPECT_NEAR(physics.joint_rate(slider), 1.5, 1e-14);
}

TEST(GuardedJoints, LockWhatHasNoRoom) {
  // Stops without room between them hold a number like a fixed joint: a rod on it is as rigid as if welded.
  PhysicsManager physics;
  physics.set_integrator(make_integrator("gauss16"));
  physics.forces().add(Gravity{});
  const BodyId upper = physics.add(RigidBodySettings{.name = "upper", .mass = test::lopsided_mass()});
  const BodyId lower = physics.add(RigidBodySettings{
      .name = "lower", .X_WB = {{0.5, 0, 0}, Quaternion::Identity()}, .mass = test::lopsided_mass()});
  physics.add(joint_here<PivotSettings>(physics, BodyId{}, upper, {{0, 0, 0}, facing({0, 1, 0})}));
  PivotSettings tip = joint_here<PivotSettings>(physics, upper, lower, {{0.5, 0, 0}, facing({1, 2, 0.5})});
  tip.axis = {.lower = 0, .upper = 0};
  const JointId locked = physics.add(std::move(tip));
  PhysicsManager welded;
  welded.set_integrator(make_integrator("gauss16"));
  welded.forces().add(Gravity{});
  const BodyId a = welded.add(RigidBodySettings{.name = "upper", .mass = test::lopsided_mass()});
  const BodyId b = welded.add(RigidBodySettings{
      .name = "lower", .X_WB = {{0.5, 0, 0}, Quaternion::Identity()}, .mass = test::lopsided_mass()});
  welded.add(joint_here<PivotSettings>(welded, BodyId{}, a, {{0, 0, 0}, facing({0, 1, 0})}));
  welded.add(joint_here<FixedSettings>(welded, a, b, {{0.5, 0, 0}, Quaternion::Identity()}));
  ASSERT_TRUE(run(physics, 0.02, 1));
  const double begin = physics.joint_value(locked);  // 0 but for the rounding of the poses
  ASSERT_TRUE(run(physics, 0.02, 49));
  ASSERT_TRUE(run(welded, 0.02, 50));
  EXPECT_EQ(physics.joint_value(locked), begin);
  EXPECT_LT((physics.body(lower).X_WB().p - welded.body(b).X_WB().p).norm(), 1e-9);
  // What the stops bear is what the weld bears about that axis.
  const JointDefinition& joint = physics.joint(locked);
  const Vector3 axis = (physics.body(lower).X_WB() * joint.X_BJ).q * Vector3::UnitZ();
  EXPECT_NEAR(physics.axis_effort(locked), physics.reaction(locked).torque.dot(axis), 1e-10);
  EXPECT_GT(std::abs(physics.axis_effort(locked)), 1e-3);
}

TEST(GuardedJoints, HoldWhatHasNoMassByFriction) {
  // A massless pointer at the end of a pendulum, on a pivot with dry friction, weighs nothing: it stays where
  // it is on the rod, which swings as without it. (Without friction it is a joint that moves nothing.)
  PhysicsManager physics, bare;
  const auto build = [](PhysicsManager& world, bool pointer) {
    world.forces().add(Gravity{});
    const BodyId rod = world.add(RigidBodySettings{.name = "rod", .mass = test::lopsided_mass()});
    world.add(joint_here<PivotSettings>(world, BodyId{}, rod, {{0, 0, 0}, facing({0, 1, 0})}));
    if (!pointer) return rod;
    MassProperties nothing;
    nothing.mass = 0;
    nothing.I_BBcm_B.setZero();
    const BodyId tip = world.add(
        RigidBodySettings{.name = "tip", .X_WB = {{0.3, 0, 0}, Quaternion::Identity()}, .mass = nothing});
    PivotSettings pivot = joint_here<PivotSettings>(world, rod, tip, {{0.3, 0, 0}, facing({1, 1, 0})});
    pivot.axis.friction = 0.1;
    world.add(std::move(pivot));
    return rod;
  };
  const BodyId rod = build(physics, true), alone = build(bare, false);
  ASSERT_TRUE(run(physics, 0.01, 100));
  ASSERT_TRUE(run(bare, 0.01, 100));
  EXPECT_LT((physics.body(rod).p_WBcm() - bare.body(alone).p_WBcm()).norm(), 1e-12);
}

TEST(GuardedJoints, SayWhichWayNumbersAreGuarded) {
  // In a loop in which every joint has stops, one is cut and says so.
  test::FourBar bar;
  PhysicsManager& physics = bar.physics;
  for (JointId& id : bar.joints) {
    const JointDefinition& old = physics.joint(id);
    PivotSettings pivot{.name = old.name, .a = old.a, .b = old.b, .X_AJ = old.X_AJ, .X_BJ = old.X_BJ};
    pivot.axis = {.lower = -1, .upper = 1};
    physics.remove(id);
    id = physics.add(std::move(pivot));
  }
  EXPECT_EQ(physics.unguarded_axes().size(), 1u);
}

}  // namespace
}  // namespace pantin
