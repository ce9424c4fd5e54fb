// What particles give to the bodies that deflectors stand on, and deflectors that move.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <pantin/physics/deflectors/box.hpp>
#include <pantin/physics/deflectors/plane.hpp>
#include <pantin/physics/deflectors/sphere.hpp>
#include <pantin/physics/physics_manager.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::run;

struct Gallery {
  PhysicsManager physics{};
  ParticleSystemId system{};
  test::Momenta momenta() const {
    test::Momenta sum = test::momenta_of(physics);
    const ParticleSystem now = physics.particles().system(system);
    for (std::size_t i = 0; i < now.size(); ++i) {
      sum.linear += now.mass(i) * now.v_WP(i);
      sum.angular += now.p_WP(i).cross(now.mass(i) * now.v_WP(i));
    }
    return sum;
  }
};

TEST(DeflectorMomentum, IsGivenBackAsInAnElasticCollision) {
  // A ball of m = 1 hits a resting body of M = 3 at its centre with e = 1: v' = (m - M) / (m + M) v and
  // V' = 2 m / (m + M) v; energy and momentum stay.
  Gallery range;
  range.system = range.physics.particles().add(ParticleSystemSettings{.mass = 1});
  const BodyId body = range.physics.add(RigidBodySettings{.mass = mass_of({BoxShape{{1, 1, 1}}, Pose{}}, 3)});
  range.physics.deflectors().add(
      BoxDeflector{.on = {.body = body}, .size = {1, 1, 1}, .surface = {.restitution = 1}});
  range.physics.particles().add_particle(range.system, {.p_WP = {-2, 0, 0}, .v_WP = {4, 0, 0}});
  ASSERT_TRUE(run(range.physics, 0.1, 10));
  EXPECT_NEAR(range.physics.particles().system(range.system).v_WP(0).x(), -2, 1e-12);
  EXPECT_NEAR(range.physics.body(body).v_WBcm().x(), 2, 1e-12);
}

TEST(DeflectorMomentum, StaysWithFrictionSpinAndStickiness) {
  // Whatever the surface does, impulses are equal and opposite at one point: the linear and angular momentum
  // of particles and body together stay to rounding, through bounces off a turning, lopsided body, sliding
  // and sticking.
  for (const SurfaceSettings surface : {SurfaceSettings{.restitution = 0.6, .friction = 0.4},
                                        SurfaceSettings{.restitution = 0.2, .stickiness = 1}}) {
    Gallery range;
    range.system = range.physics.particles().add(ParticleSystemSettings{.mass = 0.02, .radius = 0.05});
    RigidBodySettings settings = test::thrown_body();
    settings.v_WBcm.setZero();
    const BodyId body = range.physics.add(std::move(settings));
    const Vector3 centre = range.physics.body(body).p_WBcm();
    range.physics.deflectors().add(
        BoxDeflector{.on = {.body = body}, .size = {0.6, 0.4, 0.8}, .surface = surface});
    std::mt19937 random{7};
    std::normal_distribution<double> normal;
    for (int i = 0; i < 200; ++i) {
      const Vector3 way = Vector3{normal(random), normal(random), normal(random)}.normalized();
      const Vector3 aside = 0.2 * Vector3{normal(random), normal(random), normal(random)};
      range.physics.particles().add_particle(range.system,
                                             {.p_WP = centre + 2 * way + aside, .v_WP = -3 * way});
    }
    const test::Momenta before = range.momenta();
    std::uint64_t deflections = 0;
    for (int i = 0; i < 60; ++i) deflections += range.physics.step(0.02).particles.deflections;
    EXPECT_GT(deflections, 100u);
    EXPECT_LT((range.momenta().linear - before.linear).norm(), 1e-12);
    // The body's own free rotation by RK4 keeps L exactly; r x P of each is kept along straight ways.
    EXPECT_LT((range.momenta().angular - before.angular).norm(), 1e-11);
  }
}

TEST(DeflectorMomentum, NeverGrowsEnergyWithoutDrive) {
  // Restitution up to one and friction only take energy: kinetic energy of all never rises beyond rounding,
  // though many particles strike one free body within a step.
  Gallery range;
  range.system = range.physics.particles().add(ParticleSystemSettings{.mass = 0.05});
  const BodyId body = range.physics.add(RigidBodySettings{.mass = mass_of({SphereShape{0.5}, Pose{}}, 1000)});
  range.physics.deflectors().add(
      SphereDeflector{.on = {.body = body}, .radius = 0.5, .surface = {.restitution = 1, .friction = 0.3}});
  for (int i = 0; i < 500; ++i) {
    const double a = 0.1 * i;
    range.physics.particles().add_particle(
        range.system, {.p_WP = {2 + 0.001 * i, 0.3 * std::cos(a), 0.3 * std::sin(a)}, .v_WP = {-5, 0, 0}});
  }
  StepReport report = range.physics.step(0.01);
  double energy = report.energy.total() + report.particles.energy.total();
  std::uint64_t hits = 0;
  for (int i = 0; i < 60; ++i) {
    report = range.physics.step(0.01);
    hits += report.particles.deflections;
    const double now = report.energy.total() + report.particles.energy.total();
    EXPECT_LE(now, energy * (1 + 1e-9));
    energy = now;
  }
  EXPECT_GT(hits, 400u);
}

TEST(DeflectorMotion, IsMetWhereItIsAtThatInstant) {
  // A piston comes at u towards a resting particle: with e = 1 the particle leaves at 2 u, from where the
  // piston was when it reached it, in one step of any length.
  for (const int steps : {1, 3, 40}) {
    Gallery range;
    range.system = range.physics.particles().add(ParticleSystemSettings{});
    const Vector3 u{7, 0, 0};
    const BodyId piston = range.physics.add(RigidBodySettings{
        .kind = BodyKind::Animated, .driver = std::make_unique<test::FunctionDriver>([&](double t, Side) {
                                      return RigidMotion{{t * u, Quaternion::Identity()}, u};
                                    })});
    const Quaternion facing = Quaternion::FromTwoVectors(Vector3::UnitZ(), Vector3::UnitX());
    range.physics.deflectors().add(
        PlaneDeflector{.on = {.body = piston, .X_BD = {{0, 0, 0}, facing}}, .surface = {.restitution = 1}});
    range.physics.particles().add_particle(range.system, {.p_WP = {3.5, 0, 0}});
    ASSERT_TRUE(run(range.physics, 1.0 / steps, steps));
    const ParticleSystem now = range.physics.particles().system(range.system);
    EXPECT_NEAR(now.v_WP(0).x(), 14, 1e-9) << steps;
    EXPECT_NEAR(now.p_WP(0).x(), 3.5 + 0.5 * 14, 1e-9) << steps;
  }
}

TEST(DeflectorMotion, SweepsThroughWholeTurns) {
  // A thin blade turns ten times a step. A resting particle within its reach must be struck, though at both
  // ends of the step the blade stands where it stood; one beyond its reach must not.
  Gallery range;
  range.system = range.physics.particles().add(ParticleSystemSettings{.radius = 0.01});
  const double w = 2 * std::numbers::pi * 10;
  const BodyId rotor = range.physics.add(RigidBodySettings{
      .kind = BodyKind::Animated,
      .driver = std::make_unique<test::FunctionDriver>([=](double t, Side) {
        return RigidMotion{{Vector3::Zero(), Quaternion{Eigen::AngleAxisd{w * t, Vector3::UnitZ()}}},
                           Vector3::Zero(),
                           {0, 0, w}};
      })});
  range.physics.deflectors().add(
      BoxDeflector{.on = {.body = rotor}, .size = {2, 0.01, 0.1}, .surface = {.restitution = 0}});
  range.physics.particles().add_particle(range.system, {.p_WP = {0, 0.8, 0}});
  range.physics.particles().add_particle(range.system, {.p_WP = {0, 1.05, 0}});
  range.physics.particles().add_particle(range.system, {.p_WP = {0, 0.8, 0.1}});
  ASSERT_TRUE(range.physics.step(1).ok());
  const ParticleSystem now = range.physics.particles().system(range.system);
  EXPECT_GT(now.v_WP(0).norm(), 0.5 * w * 0.8);
  EXPECT_EQ(now.v_WP(1).norm(), 0);
  EXPECT_EQ(now.v_WP(2).norm(), 0);
}

TEST(DeflectorMotion, CarriesWhatLiesOnIt) {
  // On a lift that starts from rest with 2 m/s^2 a particle without gravity is pressed to the floor and goes
  // with it.
  Gallery range;
  range.system = range.physics.particles().add(ParticleSystemSettings{});
  const BodyId lift = range.physics.add(RigidBodySettings{
      .kind = BodyKind::Animated,
      .driver = std::make_unique<test::FunctionDriver>([](double t, Side) {
        return RigidMotion{
            {{0, 0, t * t}, Quaternion::Identity()}, {0, 0, 2 * t}, Vector3::Zero(), {0, 0, 2}};
      })});
  range.physics.deflectors().add(PlaneDeflector{.on = {.body = lift}, .surface = {.restitution = 0}});
  range.physics.particles().add_particle(range.system, {});
  ASSERT_TRUE(run(range.physics, 0.01, 100));
  EXPECT_NEAR(range.physics.particles().system(range.system).p_WP(0).z(), 1, 1e-3);
  EXPECT_NEAR(range.physics.particles().system(range.system).v_WP(0).z(), 2, 0.021);
}

TEST(DeflectorMotion, GoesWithItsBody) {
  // A removed body takes its deflectors along; the others stay.
  Gallery range;
  const BodyId body = range.physics.add(test::thrown_body());
  const DeflectorId on_body = range.physics.deflectors().add(SphereDeflector{.on = {.body = body}});
  const DeflectorId on_world = range.physics.deflectors().add(SphereDeflector{});
  EXPECT_EQ(range.physics.deflectors().deflectors_of(body), std::vector{on_body});
  range.physics.remove(body);
  EXPECT_FALSE(range.physics.deflectors().contains(on_body));
  EXPECT_TRUE(range.physics.deflectors().contains(on_world));
}

}  // namespace
}  // namespace pantin
