// Couplings as things that come and go: turns, edits, removal, snapshots, and those that cannot be held.
#include <pantin/physics/constraints/couplings.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "support/allocation_guard.hpp"
#include "support/expect_contract.hpp"
#include "support/four_bar.hpp"
#include "support/gears.hpp"

namespace pantin {
namespace {

using test::FourBar;
using test::Pendulums;
using test::run;
using test::Wheels;

TEST(Couplings, KeepTheirOrderWhenOthersGo) {
  // A list of three without its second is the first and the third; the freed id is not alive again when its
  // slot is used anew.
  const JointId a{0, 1}, b{1, 1}, c{2, 1};
  Couplings list;
  const CouplingId first = list.add({.name = "first", .a = a, .b = b});
  const CouplingId second = list.add({.name = "second", .a = b, .b = c});
  const CouplingId third = list.add({.name = "third", .a = a, .b = c});
  list.remove(second);
  const CouplingId fourth = list.add({.name = "fourth", .a = a, .b = b});
  EXPECT_EQ(list.ids(), (std::vector<CouplingId>{first, third, fourth}));
  EXPECT_EQ(list[list.at(third)].name, "third");
  EXPECT_FALSE(list.contains(second));
  list.remove_of(c);
  EXPECT_EQ(list.ids(), (std::vector<CouplingId>{first, fourth}));
  EXPECT_TRUE(list.has(a));
  EXPECT_FALSE(list.has(c));
  test::expect_contract([&] { static_cast<void>(list.at(third)); }, "does not exist");
}

TEST(Couplings, BringJointsTogetherByTheWayOfLeastInertia) {
  // Off by g, the least I1 d1^2 + I2 d2^2 with d2 - r d1 = -g turns the first by r g / (r^2 + I1 / I2).
  Wheels w{{0.3, 0.05}};
  const double ratio = 1.5, off = -0.2;
  w.gear(0, 1, ratio, 0.2);
  static_cast<void>(w.physics.snapshot());
  const double first = ratio * off / (ratio * ratio + 0.3 / 0.05);
  EXPECT_NEAR(w.angle(0), first, 1e-13);
  EXPECT_NEAR(w.angle(1), ratio * first + 0.2, 1e-13);
  EXPECT_NEAR(w.physics.joint_drift().angle, 0, 1e-13);
}

TEST(Couplings, CountTheTurnsThatAPivotCannotShow) {
  // The first wheel stands at 3 turns, and the second where the ratio wants it but for turns that no pose
  // shows: nothing moves when they are geared, and the second is counted to be where the ratio says.
  Wheels w{{0.3, 0.05}};
  w.physics.set_joint_value(w.joints[0], 6 * M_PI + 0.1);
  w.physics.set_joint_value(w.joints[1], 0.2 - 2 * M_PI);
  const Pose before = w.physics.body(w.bodies[1]).X_WB();
  w.gear(0, 1, 2);
  static_cast<void>(w.physics.snapshot());
  EXPECT_NEAR(w.angle(1), 12 * M_PI + 0.2, 1e-12);
  EXPECT_NEAR(w.angle(0), 6 * M_PI + 0.1, 1e-12);
  EXPECT_LT(w.physics.body(w.bodies[1]).X_WB().q.angularDistance(before.q), 1e-12);
  w.physics.set_joint_value(w.joints[0], 0.1);
  EXPECT_NEAR(w.angle(1), 0.2, 1e-12) << "all the way back";
  EXPECT_LT(w.physics.body(w.bodies[1]).X_WB().q.angularDistance(before.q), 1e-12);
}

TEST(Couplings, MoveTheOtherJointAlong) {
  // Values and rates set on either side hold on both, over many turns; the rest of the world stays.
  Wheels w{{0.3, 0.05, 1}};
  w.gear(0, 1, -4, 0.5);
  w.physics.set_joint_value(w.joints[2], 0.7);
  w.physics.set_joint_value(w.joints[0], 5);
  EXPECT_NEAR(w.angle(0), 5, 1e-13);
  EXPECT_NEAR(w.angle(1), -19.5, 1e-12);
  w.physics.set_joint_value(w.joints[1], 0.5);
  EXPECT_NEAR(w.angle(0), 0, 1e-13);
  w.physics.set_joint_rate(w.joints[1], 8);
  EXPECT_NEAR(w.physics.joint_rate(w.joints[0]), -2, 1e-13);
  w.physics.set_joint_rate(w.joints[0], 1);
  EXPECT_NEAR(w.physics.joint_rate(w.joints[1]), -4, 1e-13);
  EXPECT_EQ(w.angle(2), 0.7);
}

TEST(Couplings, ShareAnImpulseAsTheReducedInertiaDoes) {
  // An angular impulse on the first of two geared wheels leaves it with J / (I1 + r^2 I2).
  Wheels w{{0.3, 0.05}};
  w.gear(0, 1, -2);
  w.physics.apply_angular_impulse(w.bodies[0], {0, 0, 2});
  ASSERT_TRUE(w.physics.step(0.01).ok());
  EXPECT_NEAR(w.physics.joint_rate(w.joints[0]), 2 / (0.3 + 4 * 0.05), 1e-13);
  EXPECT_NEAR(w.physics.joint_rate(w.joints[1]), -2 * w.physics.joint_rate(w.joints[0]), 1e-13);
}

TEST(Couplings, ContinueFromASnapshotBitForBit) {
  // The state holds all that decides the future; one that was taken without the gear does not fit.
  Pendulums p{-1.7, 0.3};
  ASSERT_TRUE(run(p.physics, 0.01, 20));
  const State middle = p.physics.snapshot();
  ASSERT_TRUE(run(p.physics, 0.01, 20));
  const State end = p.physics.snapshot();
  p.physics.restore(middle);
  ASSERT_TRUE(run(p.physics, 0.01, 20));
  EXPECT_EQ(hash(p.physics.snapshot()), hash(end));
  EXPECT_EQ(p.physics.snapshot(), end);
  p.physics.remove(p.gear);
  test::expect_contract([&] { p.physics.restore(middle); }, "other bodies, joints or kinds");
}

TEST(Couplings, GoInAnyOrder) {
  // With a joint or a body of it a gear goes too; what is left moves on by itself, at the rate it had.
  for (const int what : {0, 1, 2, 3}) {
    Wheels w{{0.3, 0.05, 1}};
    const CouplingId one = w.gear(0, 1, -2), other = w.gear(1, 2, 0.5);
    w.physics.set_joint_rate(w.joints[0], 1);
    ASSERT_TRUE(run(w.physics, 0.01, 10));
    if (what == 0) w.physics.remove(one);
    if (what == 1) w.physics.remove(w.joints[0]);
    if (what == 2) w.physics.remove(w.bodies[0]);
    if (what == 3) w.physics.make_static(w.bodies[0]);
    EXPECT_EQ(w.physics.contains(one), what == 3);
    EXPECT_TRUE(w.physics.contains(other));
    if (what < 3) {
      EXPECT_EQ(w.physics.couplings(), std::vector<CouplingId>{other});
    } else {
      EXPECT_EQ(w.physics.coupling_effort(one), 0) << "its first joint moves nothing";
    }
    w.physics.apply_torque(w.bodies[1], {0, 0, 1});
    ASSERT_TRUE(run(w.physics, 0.01, 10));
    const double rate = -2 + 0.1 / (0.05 + 0.25 * 1);
    EXPECT_NEAR(w.physics.joint_rate(w.joints[1]), rate, 1e-12) << what;
    EXPECT_NEAR(w.physics.joint_rate(w.joints[2]), 0.5 * rate, 1e-12) << what;
  }
}

TEST(Couplings, ThatContradictEachOtherAreNamed) {
  // Twice the same wheels with offsets half a radian apart: a quarter is left to each at best.
  Wheels w{{0.3, 0.05}};
  w.gear(0, 1, 1);
  w.gear(0, 1, 1, 0.5);
  const auto problems = w.physics.singular_joints();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].first, w.joints[1]);
  EXPECT_NE(problems[0].second.text.find("gear 'gear' between pivot 'wheel 0' and pivot 'wheel 1'"),
            std::string::npos)
      << problems[0].second.text;
  const StepReport report = w.physics.step(0.01);
  EXPECT_EQ(report.status, StepStatus::LoopOpen);
  EXPECT_NE(report.message.find("cannot be met"), std::string::npos) << report.message;
}

TEST(Couplings, OfAllJointsOfALoopAreRefused) {
  // Of a four-bar one pivot is cut; it must not be a coupled one, and that is impossible where all are.
  FourBar bar;
  static_cast<void>(bar.physics.add(GearSettings{.name = "two", .a = bar.joints[0], .b = bar.joints[1]}));
  const CouplingId last =
      bar.physics.add(GearSettings{.name = "three", .a = bar.joints[2], .b = bar.joints[3]});
  const StepReport report = bar.physics.step(1e-3);
  EXPECT_EQ(report.status, StepStatus::LoopOpen);
  EXPECT_NE(report.message.find("all joints of a closed loop are coupled"), std::string::npos)
      << report.message;
  bar.physics.remove(last);
  for (const auto& [joint, problem] : bar.physics.singular_joints()) {
    EXPECT_EQ(problem.text.find("coupled"), std::string::npos) << problem.text;
  }
}

TEST(Couplings, AllocateNothingInASteadyStep) {
  // After the first steps all room is there.
  Pendulums p{-1.7, 0.3};
  ASSERT_TRUE(run(p.physics, 0.01, 3));
  const test::AllocationGuard guard;
  for (int i = 0; i < 20; ++i) static_cast<void>(p.physics.step(0.01));
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace pantin
