// Loads on joints, gears, stops and the watch on stability where islands are integrated group by group.
#include <pantin/physics/step_group.hpp>

#include <array>
#include <utility>

#include <gtest/gtest.h>

#include <pantin/physics/constraints/gear.hpp>
#include <pantin/physics/forces/damped_spring.hpp>

#include "support/four_bar.hpp"

namespace pantin {
namespace {

/// Two small wheels that a gear and a stiff spring let swing at some 300 rad/s, far from anything else.
void add_fast_wheels(PhysicsManager& physics) {
  std::array<JointId, 2> axles{};
  for (std::size_t i = 0; i < 2; ++i) {
    const Vector3 p{5 + static_cast<double>(i), 0, 0};
    const MassProperties m{0.1, Vector3::Zero(), 1e-4 * Matrix3::Identity()};
    const BodyId wheel = physics.add({.name = "wheel", .X_WB = {p}, .mass = m});
    auto axle = test::joint_here<PivotSettings>(physics, {}, wheel, {p, test::facing({0, 1, 0})}, "axle");
    if (i == 0) axle.axis = {.stiffness = 20, .rest = 1};
    axles[i] = physics.add(axle);
  }
  physics.add(GearSettings{.name = "pair", .a = axles[0], .b = axles[1], .ratio = -1});
}

/// The four-bar of test::FourBar, among other things: springs, rotors and damping on all pivots, also on the
/// one between crank and coupler, which is cut and turns with the crank.
struct Crank {
  std::array<BodyId, 3> rods{};
  std::array<JointId, 4> pivots{};

  explicit Crank(PhysicsManager& physics) {
    using test::FourBar;
    const FourBar::Shape s = FourBar::shape(FourBar::kStart);
    const auto tip_of = [&](std::size_t i, double side) {
      const double h = side * FourBar::kLength[i] / 2;
      return Vector3{s.centre[i].x + h * std::cos(s.angle[i]), s.centre[i].y + h * std::sin(s.angle[i]), 0};
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 v{s.velocity[i].x, s.velocity[i].y, 0};
      rods[i] = physics.add({.name = "rod",
                             .X_WB = {{s.centre[i].x, s.centre[i].y, 0}, Quaternion::Identity()},
                             .v_WBcm = FourBar::kRate * v,
                             .w_WB = {0, 0, FourBar::kRate * s.rate[i]},
                             .mass = {FourBar::kMass[i], Vector3::Zero(), 0.05 * Matrix3::Identity()}});
    }
    const std::array<std::pair<BodyId, BodyId>, 4> ends{
        std::pair{BodyId{}, rods[0]}, {rods[0], rods[1]}, {rods[1], rods[2]}, {BodyId{}, rods[2]}};
    const std::array<Vector3, 4> place{tip_of(0, -1), tip_of(0, 1), tip_of(2, 1), tip_of(2, -1)};
    for (const std::size_t j : {0u, 2u, 3u, 1u}) {  // of equals the last one is cut
      auto pivot = test::joint_here<PivotSettings>(physics, ends[j].first, ends[j].second,
                                                   {place[j], Quaternion::Identity()}, "pivot");
      const auto k = static_cast<double>(j);
      pivot.axis = {.stiffness = 0.1 + 0.1 * k, .rest = 0.2 - 0.1 * k, .armature = 0.01 + 0.01 * k};
      pivot.damping = 0.01;
      pivots[j] = physics.add(pivot);
    }
  }
};

/// Two pendulums of which one is geared to the other, swinging about y.
struct GearedPendulums {
  std::array<BodyId, 2> bobs{};
  std::array<JointId, 2> pivots{};
  CouplingId gear{};

  explicit GearedPendulums(PhysicsManager& physics) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector3 p{0, 1.0 * static_cast<double>(i), 0};
      bobs[i] = physics.add({.name = "bob", .X_WB = {p}, .mass = test::lopsided_mass()});
      pivots[i] = physics.add(
          test::joint_here<PivotSettings>(physics, {}, bobs[i], {p, test::facing({0, 1, 0})}, "pivot"));
    }
    gear = physics.add(GearSettings{.a = pivots[0], .b = pivots[1], .ratio = -1.7, .offset = 0.3});
    physics.set_joint_value(pivots[0], 1);
  }
};

void expect_same_motion(const RigidBody& a, const RigidBody& b) {
  EXPECT_EQ(a.p_WBcm(), b.p_WBcm());
  EXPECT_EQ(a.q_WB().coeffs(), b.q_WB().coeffs());
  EXPECT_EQ(a.linear_momentum(), b.linear_momentum());
  EXPECT_EQ(a.angular_momentum(), b.angular_momentum());
}

constexpr std::array<std::pair<const char*, double>, 3> kControlled{
    std::pair{"dormand-prince", 1e-8}, {"gauss16", 1e-10}, {"radau", 1e-7}};

TEST(StepGroup, LoadsJointsAsIfTheirIslandWereAlone) {
  // Springs, rotors and motors act on links and cut joints that are numbered anew for a part: with islands
  // beside it every bit is as without, also after motors have come, changed and gone.
  for (const auto& [name, tolerance] : kControlled) {
    PhysicsManager alone, beside;
    add_fast_wheels(beside);
    const Crank expected{alone}, crank{beside}, other{beside};
    beside.set_motor(other.pivots[0], {.damping = 50});  // it stops, and so counts other turns
    for (PhysicsManager* physics : {&alone, &beside}) {
      physics->forces().add(Gravity{});
      physics->set_integrator(make_integrator(name, tolerance));
    }
    const auto each = [&](const auto& act) {
      act(alone, expected);
      act(beside, crank);
    };
    const auto go = [&] { ASSERT_TRUE(test::run(alone, 0.02, 10) && test::run(beside, 0.02, 10)) << name; };
    go();
    each([](PhysicsManager& physics, const Crank& c) {
      physics.set_motor(c.pivots[0], {.rate = 15, .damping = 2, .limit = 20});
      for (const std::size_t j : {1u, 2u, 3u}) physics.set_motor(c.pivots[j], {.effort = 0.3});
    });
    go();
    each([](PhysicsManager& physics, const Crank& c) {
      physics.set_motor(c.pivots[0], {.effort = -1});
      for (const std::size_t j : {1u, 2u, 3u}) physics.clear_motor(c.pivots[j]);
    });
    go();
    ASSERT_EQ(beside.islands().size(), 3u);
    EXPECT_GT(std::abs(beside.joint_value(crank.pivots[1])), 4) << "more than half a turn of the cut joint";
    for (std::size_t i = 0; i < 3; ++i) {
      expect_same_motion(beside.body(crank.rods[i]), alone.body(expected.rods[i]));
    }
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_EQ(double{beside.joint_value(crank.pivots[j])}, double{alone.joint_value(expected.pivots[j])});
    }
    EXPECT_LT(beside.joint_drift().distance, 1e-12);
  }
}

TEST(StepGroup, HoldsAGearAsIfItsIslandWereAlone) {
  // A gear is a row between links of its part, whatever rows, links and gears stand before them in the world:
  // every bit is as without, and the gear is met to rounding.
  for (const auto& [name, tolerance] : kControlled) {
    PhysicsManager alone, beside;
    add_fast_wheels(beside);
    const GearedPendulums expected{alone}, pendulums{beside};
    for (PhysicsManager* physics : {&alone, &beside}) {
      physics->forces().add(Gravity{});
      physics->set_integrator(make_integrator(name, tolerance));
      ASSERT_TRUE(test::run(*physics, 0.02, 20)) << name;
    }
    ASSERT_EQ(beside.islands().size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      expect_same_motion(beside.body(pendulums.bobs[i]), alone.body(expected.bobs[i]));
    }
    const double a = beside.joint_value(pendulums.pivots[0]), b = beside.joint_value(pendulums.pivots[1]);
    EXPECT_NEAR(b, -1.7 * a + 0.3, 1e-13);
    EXPECT_EQ(beside.coupling_effort(pendulums.gear), alone.coupling_effort(expected.gear));
  }
}

TEST(StepGroup, IsOneForAllWhereJointsHaveStops) {
  // A block of closed form falls 1 m onto a stop that gives back half the speed, beside an island of other
  // steps: all go together while there is a stop, each by itself once it is gone.
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  physics.set_integrator(make_integrator("gauss16", 1e-12));
  add_fast_wheels(physics);
  const BodyId block = physics.add({.name = "block", .mass = test::lopsided_mass()});
  auto guide = test::joint_here<SliderSettings>(physics, {}, block, {}, "guide");
  guide.axis = {.lower = -1, .restitution = 0.5};
  const JointId slider = physics.add(guide);
  ASSERT_EQ(physics.islands().size(), 1u);
  EXPECT_NE(physics.islands().front().reason.find("stops"), std::string::npos);
  ASSERT_TRUE(test::run(physics, 0.01, 60));
  const double fall = std::sqrt(0.2), since = 0.6 - fall;
  EXPECT_NEAR(physics.joint_value(slider), -1 + 0.5 * 10 * fall * since - 5 * since * since, 1e-11);
  const IslandGroup all = physics.islands().front();
  EXPECT_GT(all.inner_steps, 0);
  physics.remove(slider);
  EXPECT_EQ(physics.islands().size(), 2u);
  EXPECT_TRUE(physics.step(0.01).ok());
}

TEST(StepGroup, ObeysTheIntegratorSetLastWhereJointsHaveFriction) {
  // With dry friction all are one group, which one integrator has to take: that which was asked for last.
  PhysicsManager physics;
  add_fast_wheels(physics);
  const GearedPendulums pendulums{physics};
  EXPECT_EQ(physics.islands().size(), 1u) << "one integrator in steps of the length asked for";
  physics.set_integrator(pendulums.bobs[0], make_integrator("gauss8", 1e-8));
  physics.set_integrator(physics.bodies()[0], make_integrator("radau", 1e-8));
  EXPECT_EQ(physics.islands().size(), 2u);
  const BodyId block = physics.add({.name = "block", .mass = test::lopsided_mass()});
  auto guide = test::joint_here<SliderSettings>(physics, {}, block, {}, "guide");
  guide.axis = {.friction = 3};
  physics.add(guide);
  ASSERT_EQ(physics.islands().size(), 1u);
  EXPECT_EQ(physics.islands().front().integrator, "radau");
  EXPECT_TRUE(physics.step(0.01).ok());
}

TEST(StepGroup, IsWatchedByItself) {
  // A body on a spring of 1e6 N/m swings at 1000 rad/s, which rk4 does not bear in steps of 0.02 s: its own
  // group is cut, and named, while a body on a soft spring and pendulums, each a group, reach the bits that
  // they reach alone in whole steps. What is known goes with the state.
  PhysicsManager alone, beside;
  const BodyId stiff = beside.add({.name = "stiff", .mass = {1, Vector3::Zero(), Matrix3::Identity()}});
  beside.forces().add(DampedSpring{.a = {stiff}, .b = {{}, {1, 0, 0}}, .stiffness = 1e6, .damping = 1});
  const GearedPendulums expected{alone}, pendulums{beside};
  const auto add_soft = [](PhysicsManager& physics) {
    const BodyId soft = physics.add(test::thrown_body());
    physics.forces().add(DampedSpring{.a = {soft}, .stiffness = 5});
    physics.set_integrator(soft, make_integrator("rk4"));
    return soft;
  };
  const BodyId soft = add_soft(beside), expected_soft = add_soft(alone);
  beside.set_integrator(stiff, make_integrator("rk4"));
  beside.watch_stability(true);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(alone.step(0.02).ok());
    const StepReport report = beside.step(0.02);
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report.fast.body, stiff);
    EXPECT_GT(report.fast.parts, 1);
  }
  ASSERT_EQ(beside.islands().size(), 3u);
  expect_same_motion(beside.body(soft), alone.body(expected_soft));
  for (std::size_t i = 0; i < 2; ++i) {
    expect_same_motion(beside.body(pendulums.bobs[i]), alone.body(expected.bobs[i]));
  }
  const State there = beside.snapshot();
  ASSERT_TRUE(test::run(beside, 0.02, 10));
  const std::uint64_t once = hash(beside.snapshot());
  beside.restore(there);
  ASSERT_TRUE(test::run(beside, 0.02, 10));
  EXPECT_EQ(hash(beside.snapshot()), once);
}

}  // namespace
}  // namespace pantin
