// Dry friction in joints: sliding, sticking, and what breaks it loose.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <pantin/physics/forces/damped_spring.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::facing;
using test::joint_here;
using test::run;

/// A block of 2 kg on a level slider of the world, with dry friction.
struct BrakedBlock {
  explicit BrakedBlock(double friction, const char* integrator = "gauss16", double speed = 0) {
    physics.set_integrator(make_integrator(integrator));
    MassProperties mass;
    mass.mass = 2;
    block = physics.add(RigidBodySettings{.name = "block", .v_WBcm = {speed, 0, 0}, .mass = mass});
    SliderSettings settings =
        joint_here<SliderSettings>(physics, BodyId{}, block, {{0, 0, 0}, facing({1, 0, 0})});
    settings.axis = {.friction = friction};
    slider = physics.add(std::move(settings));
  }
  PhysicsManager physics{};
  BodyId block{};
  JointId slider{};
};

TEST(DryFriction, StopsABlockWhereAndWhenItShould) {
  // Constant deceleration F / m from v0: it stops at v0 m / F, after v0^2 m / (2 F), and stays there to the
  // bit.
  for (const char* integrator : {"gauss16", "rk4", "dormand-prince", "radau", "verlet"}) {
    BrakedBlock world{3, integrator, 1.7};
    double stopped = -1;
    for (int i = 0; i < 150; ++i) {
      const StepReport report = world.physics.step(0.01);
      ASSERT_TRUE(report.ok()) << report.message;
      for (const JointEvent& event : world.physics.joint_events()) {
        EXPECT_EQ(event.kind, JointEventKind::Stuck);
        stopped = event.time;
      }
    }
    EXPECT_NEAR(stopped, 1.7 * 2 / 3, 1e-10) << integrator;
    const double rest = world.physics.joint_value(world.slider);
    EXPECT_NEAR(rest, 1.7 * 1.7 * 2 / 6, 1e-10) << integrator;
    ASSERT_TRUE(run(world.physics, 0.01, 100));
    EXPECT_EQ(world.physics.joint_value(world.slider), rest) << integrator;
    EXPECT_EQ(world.physics.axis_mode(world.slider), AxisMode::Stuck);
  }
}

TEST(DryFriction, HoldsWhatItCanForEver) {
  // Below the limit nothing moves to the bit, and friction bears the load; above it the rest accelerates.
  BrakedBlock world{3};
  world.physics.apply_force(world.block, {2.999, 0, 0});
  ASSERT_TRUE(run(world.physics, 0.1, 200));
  EXPECT_EQ(world.physics.joint_value(world.slider), 0);
  EXPECT_NEAR(world.physics.axis_effort(world.slider), -2.999, 1e-14);
  world.physics.clear_accumulators();
  world.physics.apply_force(world.block, {4, 0, 0});
  ASSERT_TRUE(run(world.physics, 0.1, 10));
  EXPECT_NEAR(world.physics.joint_value(world.slider), 0.5 * (4 - 3) / 2, 1e-13);
  EXPECT_NEAR(world.physics.axis_effort(world.slider), -3, 1e-14);
}

/// Spring between the world and the block; stiff enough to swing in about a second.
struct BrakedSpring : BrakedBlock {
  static constexpr double kStiffness = 80, kFriction = 3;
  explicit BrakedSpring(const char* integrator, double begin) : BrakedBlock{kFriction, integrator} {
    physics.forces().add(DampedSpring{
        .a = {BodyId{}, {-3, 0, 0}}, .b = {block, {0, 0, 0}}, .stiffness = kStiffness, .rest_length = 3});
    physics.set_joint_value(slider, begin);
  }
};

TEST(DryFriction, TakesTwoFOverKFromEachHalfSwing) {
  // Between turns the motion is a cosine about +-F/k, so that each half swing, of pi sqrt(m / k), ends 2 F /
  // k nearer to the middle, until the spring no longer overcomes friction: there it sticks.
  const double step = 2 * BrakedSpring::kFriction / BrakedSpring::kStiffness, begin = 0.4;
  const double half = M_PI * std::sqrt(2 / BrakedSpring::kStiffness);
  BrakedSpring world{"gauss16", begin};
  for (int swing = 1; swing <= 5; ++swing) {
    ASSERT_TRUE(run(world.physics, half / 8, 8));
    const double expected = (swing % 2 == 0 ? 1 : -1) * (begin - swing * step);
    EXPECT_NEAR(world.physics.joint_value(world.slider), expected, 1e-9) << "half swing " << swing;
  }
  // 0.4 - 5 * 0.075 = 0.025 is less than F / k = 0.0375.
  ASSERT_TRUE(run(world.physics, half / 8, 1));
  const double rest = world.physics.joint_value(world.slider);
  EXPECT_EQ(world.physics.axis_mode(world.slider), AxisMode::Stuck);
  ASSERT_TRUE(run(world.physics, half / 8, 100));
  EXPECT_EQ(world.physics.joint_value(world.slider), rest);
}

TEST(DryFriction, KeepsTheOrderOfRk4BetweenEvents) {
  // The same swing by rk4: halving the step divides the error by 16 although the turns fall inside of steps.
  const double half = M_PI * std::sqrt(2 / BrakedSpring::kStiffness);
  const auto error = [&](int steps) {
    BrakedSpring world{"rk4", 0.4};
    EXPECT_TRUE(run(world.physics, 3.3 * half / steps, steps));
    const double t = 0.3 * half, w = M_PI / half, rest = BrakedSpring::kFriction / BrakedSpring::kStiffness;
    const double amplitude = 0.4 - 6 * rest - rest;
    return std::abs(double{world.physics.joint_value(world.slider)} - (-rest - amplitude * std::cos(w * t)));
  };
  const double coarse = error(40), fine = error(80);
  EXPECT_GT(coarse / fine, 12);
  EXPECT_LT(coarse / fine, 20);
}

TEST(DryFriction, BreaksLooseWhereTheLoadPassesIt) {
  // A force that grows as c t through a spring-less law: the block stays until c t = F, then moves by
  // integral of (c t - F) / m, c (t - t0)^3 / (6 m).
  BrakedBlock world{3};
  // A spring whose far end is drawn away evenly: load k u t while the block stands.
  RigidBodySettings hand{.name = "hand", .kind = BodyKind::Animated};
  hand.driver = std::make_unique<test::FunctionDriver>([](double t, Side) {
    RigidMotion m;
    m.X_AB.p = {1 + 0.2 * t, 0, 0};
    m.v_AB = {0.2, 0, 0};
    return m;
  });
  const BodyId far = world.physics.add(std::move(hand));
  const double k = 20, u = 0.2;
  world.physics.forces().add(
      DampedSpring{.a = {far, {0, 0, 0}}, .b = {world.block, {0, 0, 0}}, .stiffness = k, .rest_length = 1});
  const double loose = 3 / (k * u);
  double slipped = -1;
  while (world.physics.time() < loose + 0.1) {
    ASSERT_TRUE(world.physics.step(0.04).ok());
    for (const JointEvent& event : world.physics.joint_events()) {
      EXPECT_EQ(event.kind, JointEventKind::Slipped);
      slipped = event.time;
    }
  }
  EXPECT_NEAR(slipped, loose, 1e-9);
  // x'' = k (u tau - x) / m from rest: x = u tau - u sin(w tau) / w.
  const double tau = world.physics.time() - loose, w = std::sqrt(k / 2);
  EXPECT_NEAR(world.physics.joint_value(world.slider), u * (tau - std::sin(w * tau) / w), 1e-9);
}

TEST(DryFriction, EndsHoweverManyJointsChatter) {
  // 60 rods on random pivots with random friction and stops, in steps so long that some are crowded: every
  // step ends, and as stops without restitution and friction only take energy, none comes from anywhere (but
  // for 1e-2, the error of short steps).
  PhysicsManager physics;
  physics.set_integrator(make_integrator("gauss8"));
  physics.forces().add(Gravity{});
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> number{-1, 1};
  BodyId above;
  for (int i = 0; i < 60; ++i) {
    const Vector3 at{0.2 * i, 0, 0};
    const BodyId rod = physics.add(RigidBodySettings{
        .name = "rod", .X_WB = {at, Quaternion::Identity()}, .mass = test::lopsided_mass()});
    const Vector3 axis = Vector3{number(random), number(random), number(random)}.normalized();
    PivotSettings pivot = joint_here<PivotSettings>(physics, above, rod, {at, facing(axis)});
    pivot.axis = {.lower = -0.5, .upper = 0.5, .friction = std::exp(3 * number(random))};
    physics.add(std::move(pivot));
    above = rod;
  }
  double energy = physics.energy().total();
  int crowded = 0;
  for (int i = 0; i < 40; ++i) {
    const StepReport report = physics.step(0.1);
    ASSERT_TRUE(report.ok()) << report.message;
    EXPECT_LT(report.energy.total(), energy + 1e-2 * std::abs(energy));
    energy = report.energy.total();
    crowded += report.crowded;
  }
  EXPECT_GT(crowded, 0);
}

}  // namespace
}  // namespace pantin
