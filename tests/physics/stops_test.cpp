// Stops of joints: blows, rest, and what the stops bear.
#include <gtest/gtest.h>

#include <cmath>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::facing;
using test::joint_here;
using test::run;

constexpr double kG = 9.81;

/// A block of 2 kg on an upright slider of the world, 1 m above its lower stop.
struct FallingBlock {
  explicit FallingBlock(const JointAxis& axis, const char* integrator = "gauss16") {
    physics.set_integrator(make_integrator(integrator));
    physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
    MassProperties mass;
    mass.mass = 2;
    block = physics.add(RigidBodySettings{.name = "block", .mass = mass});
    SliderSettings settings =
        joint_here<SliderSettings>(physics, BodyId{}, block, {{0, 0, 0}, facing({0, 0, 1})});
    settings.axis = axis;
    slider = physics.add(std::move(settings));
  }
  PhysicsManager physics{};
  BodyId block{};
  JointId slider{};
};

/// Height above the stop and velocity of a ball that falls from rest at `height` and bounces with restitution
/// e, at time t; at rest once bounces are lower than 1e-13 m.
struct Bouncing {
  double height{0}, velocity{0};
};
Bouncing bouncing(double height, double e, double t) {
  double v = std::sqrt(2 * kG * height), hit = v / kG;
  if (t < hit) return {height - kG * t * t / 2, -kG * t};
  for (v *= e; v > 1e-6; v *= e) {
    const double flight = 2 * v / kG;
    if (t < hit + flight) return {v * (t - hit) - kG * (t - hit) * (t - hit) / 2, v - kG * (t - hit)};
    hit += flight;
  }
  return {};
}

TEST(Stops, BounceAsTheBouncingBall) {
  // Parabolas between blows at closed-form times, each e times as fast as the last. The integrator follows
  // parabolas exactly, so what is compared is the location of the blows: 1e-9 over a dozen of them.
  FallingBlock world{{.lower = -1, .restitution = 0.8}};
  double worst = 0, t = 0;
  int hits = 0;
  while (t < 3) {
    const StepReport report = world.physics.step(0.01);
    ASSERT_TRUE(report.ok()) << report.message;
    EXPECT_EQ(report.crowded, 0);
    t = report.time;
    const Bouncing exact = bouncing(1, 0.8, t);
    worst = std::max(worst, std::abs(world.physics.joint_value(world.slider) + 1 - exact.height));
    for (const JointEvent& event : world.physics.joint_events()) {
      EXPECT_EQ(event.kind, JointEventKind::StopHit);
      EXPECT_NEAR(event.value, -1, 1e-12);
      ++hits;
    }
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_GE(hits, 6);
}

TEST(Stops, EndTheBouncesOfZeno) {
  // With restitution 1/2 all bounces together take t0 (1 + e) / (1 - e) = 3 t0, t0 the time of the fall: a
  // finite time, after which the block rests on the stop to the bit.
  FallingBlock world{{.lower = -1, .restitution = 0.5}};
  const double end = 3 * std::sqrt(2 / kG);
  ASSERT_TRUE(run(world.physics, end / 100, 100));
  EXPECT_NEAR(world.physics.joint_value(world.slider), -1, 1e-12);
  ASSERT_TRUE(run(world.physics, end / 100, 2));
  const double rest = world.physics.joint_value(world.slider);
  EXPECT_EQ(world.physics.axis_mode(world.slider), AxisMode::HeldLower);
  ASSERT_TRUE(run(world.physics, end / 100, 100));
  EXPECT_EQ(world.physics.joint_value(world.slider), rest);
  EXPECT_EQ(world.physics.joint_rate(world.slider), 0);
}

TEST(Stops, BearTheWeight) {
  // At rest the stop carries m g, and no load but a greater one the other way takes the block off: a force F
  // from below leaves m g - F to the stop, and then lifts the block with (F - m g) / m.
  FallingBlock world{{.lower = 0}};
  PhysicsManager& physics = world.physics;
  ASSERT_TRUE(run(physics, 0.01, 3));
  EXPECT_EQ(physics.joint_value(world.slider), 0);
  EXPECT_NEAR(physics.axis_effort(world.slider), 2 * kG, 1e-12);
  EXPECT_NEAR(physics.reaction(world.slider).force.z(), 2 * kG, 1e-12);
  physics.apply_force(world.block, {0, 0, 15});
  ASSERT_TRUE(run(physics, 0.01, 3));
  EXPECT_EQ(physics.joint_value(world.slider), 0);
  EXPECT_NEAR(physics.axis_effort(world.slider), 2 * kG - 15, 1e-12);
  physics.clear_accumulators();
  physics.apply_force(world.block, {0, 0, 25});
  ASSERT_TRUE(run(physics, 0.01, 10));
  EXPECT_NEAR(physics.joint_value(world.slider), (25 - 2 * kG) / 2 * 0.1 * 0.1 / 2, 1e-13);
  EXPECT_EQ(physics.axis_mode(world.slider), AxisMode::Free);
}

TEST(Stops, LetGoWhereTheLoadTurns) {
  // A ground that accelerates as a = -A sin(W t) carries a block upright against gravity. The block leaves
  // the stop of its slider where the ground falls away faster than g, at sin(W t) = g / A, and flies freely.
  PhysicsManager physics;
  physics.set_integrator(make_integrator("gauss16"));
  physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
  const double A = 30, W = 5;
  RigidBodySettings table{.name = "table", .kind = BodyKind::Animated};
  table.driver = std::make_unique<test::FunctionDriver>([=](double t, Side) {
    RigidMotion m;
    m.X_AB.p = {0, 0, A / W / W * std::sin(W * t)};
    m.v_AB = {0, 0, A / W * std::cos(W * t)};
    m.a_AB = {0, 0, -A * std::sin(W * t)};
    return m;
  });
  const BodyId ground = physics.add(std::move(table));
  MassProperties mass;
  mass.mass = 2;
  const BodyId block = physics.add(RigidBodySettings{.name = "block", .v_WBcm = {0, 0, A / W}, .mass = mass});
  SliderSettings settings =
      joint_here<SliderSettings>(physics, ground, block, {{0, 0, 0}, facing({0, 0, 1})});
  settings.axis = {.lower = 0};
  const JointId slider = physics.add(std::move(settings));
  const double leaves = std::asin(kG / A) / W;
  double left = -1;
  while (physics.time() < 0.2 - 1e-9) {
    ASSERT_TRUE(physics.step(0.02).ok());
    for (const JointEvent& event : physics.joint_events()) {
      EXPECT_EQ(event.kind, JointEventKind::StopLeft);
      left = event.time;
    }
  }
  EXPECT_NEAR(left, leaves, 1e-9);
  const double t = physics.time(), flown = t - leaves;
  const double height =
      A / W / W * std::sin(W * leaves) + A / W * std::cos(W * leaves) * flown - kG / 2 * flown * flown;
  EXPECT_NEAR(physics.joint_value(slider), height - A / W / W * std::sin(W * t), 1e-9);
}

/// A chain of rods on pivots about y that swings from the horizontal, the second joint with stops.
struct SwingingChain {
  explicit SwingingChain(double restitution, int rods = 3) {
    physics.set_integrator(make_integrator("gauss16"));
    physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
    BodyId above;
    for (int i = 0; i < rods; ++i) {
      MassProperties mass = test::lopsided_mass(1 + 0.5 * i);
      const BodyId rod = physics.add(
          RigidBodySettings{.name = "rod", .X_WB = {{0.4 * i, 0, 0}, Quaternion::Identity()}, .mass = mass});
      const Vector3 axis = i == 2 ? Vector3{0, 0.6, 0.8} : Vector3{0, 1, 0};
      PivotSettings settings =
          joint_here<PivotSettings>(physics, above, rod, {{0.4 * i, 0, 0}, facing(axis)});
      if (i == 1) settings.axis = {.lower = -0.3, .upper = 0.3, .restitution = restitution};
      joints.push_back(physics.add(std::move(settings)));
      above = rod;
    }
  }
  PhysicsManager physics{};
  std::vector<JointId> joints{};
};

TEST(Stops, KeepTheEnergyOfAChainWithoutLoss) {
  // With restitution 1 a blow turns the relative rate round and does no work, however the chain is coupled:
  // the energy stays what it was, to the error of the integrator, and the joint within its stops.
  SwingingChain chain{1};
  const double before = chain.physics.energy().total();
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const StepReport report = chain.physics.step(0.01);
    ASSERT_TRUE(report.ok()) << report.message;
    hits += report.joint_events;
    EXPECT_LE(std::abs(double{chain.physics.joint_value(chain.joints[1])}), 0.3 + 1e-12);
  }
  EXPECT_GE(hits, 5);
  EXPECT_NEAR(chain.physics.energy().total(), before, 1e-8);
}

TEST(Stops, LoseTheEnergyThatTheBlowTakes) {
  // A blow without restitution takes (S v)^2 / (2 W) of energy, W = S M^-1 S^T what a unit impulse on the
  // joint does to its own rate: measured on an equal chain by a pair of opposite impulses.
  SwingingChain chain{0};
  PhysicsManager& physics = chain.physics;
  double loss = 0;
  for (int i = 0; i < 2000 && loss == 0; ++i) {
    const double before = physics.energy().total();
    ASSERT_TRUE(physics.step(0.001).ok());
    if (physics.joint_events().empty()) continue;
    loss = before - physics.energy().total();
    const JointEvent hit = physics.joint_events().front();
    ASSERT_EQ(hit.kind, JointEventKind::StopHit);
    // The shape at the blow, as near as the rest of the step; the torque pair is an angular impulse.
    SwingingChain other{0};
    for (std::size_t j = 0; j < 3; ++j) {
      other.physics.set_joint_value(other.joints[j], physics.joint_value(chain.joints[j]));
    }
    other.physics.set_joint_value(other.joints[1], 0.0);
    other.physics.set_joint_value(other.joints[1], 0.999999 * hit.value);
    const auto bodies = other.physics.bodies();
    const double sense = hit.value > 0 ? -1 : 1;
    other.physics.apply_angular_impulse(bodies[0], {0, -sense, 0});
    other.physics.apply_angular_impulse(bodies[1], {0, sense, 0});
    ASSERT_TRUE(other.physics.step(1e-9).ok());
    const double W = std::abs(double{other.physics.joint_rate(other.joints[1])});
    EXPECT_NEAR(loss, hit.rate * hit.rate / (2 * W), 1e-3 * loss);
  }
  EXPECT_GT(loss, 0.01);
}

}  // namespace
}  // namespace pantin
