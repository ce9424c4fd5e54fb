#include <pantin/physics/constraints/gear.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pantin/physics/integrators/dormand_prince.hpp>
#include <pantin/physics/integrators/gauss.hpp>

#include "support/expect_contract.hpp"
#include "support/four_bar.hpp"
#include "support/gears.hpp"

namespace pantin {
namespace {

using test::FourBar;
using test::joint_here;
using test::Pendulums;
using test::run;
using test::Wheels;

TEST(Gear, TurnsTwoWheelsAsOneOfTheReducedInertia) {
  // A torque T on the first of two geared wheels turns it with T / (I1 + r^2 I2): constant, so that rk4 is
  // exact. The second one takes r I2 times that to follow, and gives -r times as much back to the first.
  Wheels w{{0.3, 0.05}};
  const double ratio = -2.5, torque = 1.7, rate = torque / (0.3 + ratio * ratio * 0.05);
  const CouplingId gear = w.gear(0, 1, ratio, 0.4);
  w.physics.set_joint_value(w.joints[0], 0.1);
  for (int i = 0; i < 100; ++i) {
    w.physics.apply_torque(w.bodies[0], {0, 0, torque});
    ASSERT_TRUE(w.physics.step(0.01).ok());
    if (i < 99) w.physics.clear_accumulators();
  }
  EXPECT_NEAR(w.angle(0), 0.1 + rate / 2, 1e-13);
  EXPECT_NEAR(w.angle(1), ratio * w.angle(0) + 0.4, 1e-14);
  EXPECT_NEAR(w.physics.joint_rate(w.joints[1]), ratio * rate, 1e-13);
  const double effort = ratio * rate * 0.05;
  EXPECT_NEAR(w.physics.coupling_effort(gear), effort, 1e-14);
  EXPECT_NEAR(w.physics.reaction(w.joints[1]).torque.z(), effort, 1e-13);
  EXPECT_NEAR(w.physics.reaction(w.joints[0]).torque.z(), -ratio * effort, 1e-13);
}

TEST(Gear, LowersARackOnItsPinion) {
  // A rack of mass m on a pinion of radius R falls with m g / (m + I / R^2). The rack is b once and a once.
  for (const bool rack_leads : {false, true}) {
    Wheels w{{0.02}};
    w.physics.forces().add(Gravity{.g_W = {0, 0, -9.81}});
    const double radius = 0.15, mass = 3;
    const BodyId rack = w.physics.add(RigidBodySettings{.name = "rack", .mass = test::lopsided_mass(mass)});
    const JointId slider =
        w.physics.add(joint_here<SliderSettings>(w.physics, BodyId{}, rack, Pose{}, "guide"));
    const CouplingId gear =
        rack_leads ? w.physics.add(GearSettings{.a = slider, .b = w.joints[0], .ratio = 1 / radius})
                   : w.physics.add(GearSettings{.a = w.joints[0], .b = slider, .ratio = radius});
    ASSERT_TRUE(run(w.physics, 0.01, 50));
    const double fall = mass * 9.81 / (mass + 0.02 / (radius * radius));
    EXPECT_NEAR(w.physics.joint_value(slider), -fall / 8, 1e-13);
    EXPECT_NEAR(w.angle(0), -fall / 8 / radius, 1e-12);
    const double effort = rack_leads ? -0.02 * fall / radius : mass * (9.81 - fall);
    EXPECT_NEAR(w.physics.coupling_effort(gear), effort, 1e-12) << "on the pinion, or on the rack";
  }
}

TEST(Gear, KeepsEnergyForTenSeconds) {
  // Two geared pendulums of one coordinate in all, which move as no linear thing does: the gear does no work,
  // and gauss with 8 stages leaves rounding, some 1e-15 of 20 J a step.
  Pendulums p{-1.7, 0.3};
  p.physics.set_integrator(make_gauss({.stages = 8}));
  const double start = p.physics.energy().total();
  ASSERT_TRUE(run(p.physics, 0.01, 1000));
  EXPECT_NEAR(p.physics.energy().total(), start, 1e-11);
  EXPECT_LT(p.physics.joint_drift().angle, 1e-13);
}

TEST(Gear, KeepsTheOrderOfAnIntegrator) {
  // Halving the step of rk4 divides the error by 16, against a solution to 1e-13; a projection that broke the
  // order would show as 4 or 2.
  Pendulums exact{-1.7, 0.3};
  exact.physics.set_integrator(make_dormand_prince({.tolerance = 1e-13}));
  ASSERT_TRUE(run(exact.physics, 0.1, 10));
  double error[2];
  for (const int k : {0, 1}) {
    Pendulums p{-1.7, 0.3};
    ASSERT_TRUE(run(p.physics, 0.01 / (1 << k), 100 << k));
    error[k] = std::abs(p.angle(0) - exact.angle(0));
    EXPECT_NEAR(p.angle(1), -1.7 * p.angle(0) + 0.3, 1e-13);
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 4, 0.4) << error[0] << " -> " << error[1];
}

TEST(Gear, MovesAsAReducedPendulumDoes) {
  // In the angle of the first, the two pendulums have the inertia I1 + r^2 I2 and the weight's torque of
  // both. Over a short time a step of rk4 shows the acceleration.
  Pendulums p{-1.7, 0.3};
  const double a = p.angle(0), b = p.angle(1), rate = p.physics.joint_rate(p.joints[0]);
  ASSERT_NEAR(b, -1.7 * a + 0.3, 1e-14);
  const double torque = p.weight(0) * std::sin(a) + -1.7 * p.weight(1) * std::sin(b);
  const double expected = -torque / (p.inertia(0) + 1.7 * 1.7 * p.inertia(1));
  ASSERT_TRUE(p.physics.step(1e-5).ok());
  EXPECT_NEAR((p.physics.joint_rate(p.joints[0]) - rate) / 1e-5, expected, 1e-3 * std::abs(expected));
}

TEST(Gear, KeepsMomentumInFreeSpace) {
  // Between wheels of two craft that fly apart: what the gear does, it does between the bodies of each joint,
  // so that both craft keep their linear and all together their angular momentum; energy is kept too.
  PhysicsManager physics;
  physics.set_integrator(make_gauss({.stages = 6}));
  std::vector<JointId> joints;
  for (const double side : {-1.0, 1.0}) {
    RigidBodySettings craft = test::thrown_body(), wheel = test::thrown_body();
    craft.X_WB.p.x() += 5 * side;
    wheel.X_WB = {craft.X_WB.p + Vector3{0.3, 0.2, 0.1}, Quaternion::Identity()};
    const BodyId a = physics.add(std::move(craft)), b = physics.add(std::move(wheel));
    const Pose X_WJ{physics.body(b).X_WB().p, test::facing(Vector3{1, side, 2}.normalized())};
    joints.push_back(physics.add(joint_here<PivotSettings>(physics, a, b, X_WJ)));
  }
  physics.set_joint_rate(joints[0], 3);
  static_cast<void>(physics.add(GearSettings{.a = joints[0], .b = joints[1], .ratio = 0.6}));
  static_cast<void>(physics.snapshot());  // the jerk of engaging is over
  const test::Momenta before = test::momenta_of(physics);
  const double energy = physics.energy().total();
  ASSERT_TRUE(run(physics, 0.01, 200));
  EXPECT_GT(std::abs(physics.joint_value(joints[0])), 0.5) << "it turns, or the test shows little";
  EXPECT_NEAR(physics.joint_rate(joints[1]), 0.6 * physics.joint_rate(joints[0]), 1e-12);
  EXPECT_LT((test::momenta_of(physics).linear - before.linear).norm(), 1e-11);
  EXPECT_LT((test::momenta_of(physics).angular - before.angular).norm(), 1e-10);
  EXPECT_NEAR(physics.energy().total(), energy, 1e-10);
}

TEST(Gear, WorksInChainsAlsoRedundantOnes) {
  // Three wheels in a chain have the inertia I1 + r1^2 I2 + (r1 r2)^2 I3; a gear between the first and the
  // last that says the same once more changes nothing but who carries how much.
  for (const bool redundant : {false, true}) {
    Wheels w{{0.3, 0.05, 0.1}};
    w.gear(0, 1, -2, 0.1);
    const CouplingId last = w.gear(1, 2, -0.7, 0.2);
    const CouplingId more = redundant ? w.gear(0, 2, 1.4, 0.13) : CouplingId{};
    w.physics.set_joint_value(w.joints[0], 0);
    w.physics.apply_torque(w.bodies[0], {0, 0, 2});
    EXPECT_TRUE(w.physics.singular_joints().empty());
    ASSERT_TRUE(run(w.physics, 0.01, 100));
    const double rate = 2 / (0.3 + 4 * 0.05 + 1.4 * 1.4 * 0.1);
    EXPECT_NEAR(w.angle(0), rate / 2, 2e-12);
    EXPECT_NEAR(w.angle(2), 1.4 * rate / 2 + 0.13, 2e-12);
    const double sum = w.physics.coupling_effort(last) + (redundant ? w.physics.coupling_effort(more) : 0);
    EXPECT_NEAR(sum, 0.1 * 1.4 * rate, 1e-11);
    EXPECT_LT(w.physics.joint_drift().angle, 1e-13);
  }
}

TEST(Gear, LoadsTheCrankOfAFourBar) {
  // A wheel J geared to the crank by r is r^2 J more inertia of the crank: the same as a body fixed to it
  // about its pivot; weight turns neither.
  const double ratio = 3, inertia = 0.02;
  const auto wheel = [](double about_z) {
    MassProperties m;
    m.mass = 1;
    m.I_BBcm_B = Vector3{about_z, about_z, about_z}.asDiagonal();
    return RigidBodySettings{.name = "wheel", .mass = m};
  };
  FourBar geared{{0, 1, 2, 3}, 0, false}, fixed{{0, 1, 2, 3}, 0, false};
  const BodyId turning = geared.physics.add(wheel(inertia));
  const JointId axle =
      geared.physics.add(joint_here<PivotSettings>(geared.physics, BodyId{}, turning, Pose{}, "axle"));
  geared.physics.set_joint_value(axle, 0.2);
  static_cast<void>(
      geared.physics.add(GearSettings{.a = geared.joints[0], .b = axle, .ratio = ratio, .offset = 0.2}));
  const BodyId more = fixed.physics.add(wheel(ratio * ratio * inertia));
  fixed.physics.add(joint_here<FixedSettings>(fixed.physics, fixed.rods[0], more, Pose{}));
  for (FourBar* bar : {&geared, &fixed}) {
    bar->physics.set_integrator(make_gauss({.stages = 8}));
    ASSERT_TRUE(run(bar->physics, 0.01, 150));
  }
  EXPECT_GT(std::abs(geared.crank_angle() - FourBar::kStart), 1) << "it has moved, or the test shows little";
  EXPECT_NEAR(geared.crank_angle(), fixed.crank_angle(), 1e-10);
  const double crank = geared.physics.joint_value(geared.joints[0]);
  EXPECT_NEAR(geared.physics.joint_value(axle), ratio * crank + 0.2, 1e-12);
}

TEST(Gear, SaysWhatIsWrongWithItsSettings) {
  // Each is refused by name, with a remedy, and by a contract where it is added all the same.
  Wheels w{{1, 1}};
  const BodyId ball = w.physics.add(RigidBodySettings{.name = "ball", .mass = test::lopsided_mass()});
  const JointId socket = w.physics.add(joint_here<BallSettings>(w.physics, BodyId{}, ball, Pose{}, "socket"));
  const GearSettings good{.name = "g", .a = w.joints[0], .b = w.joints[1]};
  const auto text = [&](GearSettings settings) {
    const auto problem = problem_with(settings, w.physics.joint(settings.a), w.physics.joint(settings.b));
    test::expect_contract([&] { w.physics.add(settings); }, problem ? problem->text : "no problem");
    return problem ? problem->text + "; " + problem->remedy : "";
  };
  EXPECT_FALSE(problem_with(good, w.physics.joint(good.a), w.physics.joint(good.b)));
  GearSettings bad = good;
  bad.ratio = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(text(bad).find("ratio"), std::string::npos);
  bad = good, bad.offset = std::numeric_limits<double>::infinity();
  EXPECT_NE(text(bad).find("offset"), std::string::npos);
  bad = good, bad.b = bad.a;
  EXPECT_NE(text(bad).find("same joint"), std::string::npos);
  bad = good, bad.axis_b = 1;
  EXPECT_NE(text(bad).find("axis_b is 1, but pivot 'wheel 1' has 1 number(s); give an axis from 0 to 0"),
            std::string::npos);
  bad = good, bad.axis_a = -1;
  EXPECT_NE(text(bad).find("axis_a is -1"), std::string::npos);
  bad = good, bad.a = socket;
  EXPECT_NE(text(bad).find("ball 'socket', which has no angle"), std::string::npos);
  bad = good, bad.a = {};
  EXPECT_EQ(problem_with(bad)->code, ProblemCode::UnknownEntity);
  test::expect_contract([&] { w.physics.add(bad); }, "a is null");
}

}  // namespace
}  // namespace pantin
