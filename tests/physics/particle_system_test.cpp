#include <pantin/physics/particle_system.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pantin/physics/deflectors/plane.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/forces/linear_drag.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <support/allocation_guard.hpp>
#include <support/expect_contract.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::expect_contract;
using test::run;

constexpr double kInf = std::numeric_limits<double>::infinity();
const Vector3 kG{0, 0, -9.81};

ParticleSystemId a_system(PhysicsManager& physics, double mass = 0.01) {
  return physics.particles().add(ParticleSystemSettings{.name = "dust", .mass = mass});
}

TEST(ParticleSystem, FliesAlongAParabola) {
  // Under uniform gravity p = p0 + v t + g t^2 / 2 is what RK4 gives exactly, whatever the step; the
  // tolerance is rounding over 100 steps.
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = kG});
  const ParticleSystemId dust = a_system(physics);
  const Vector3 p0{1, 2, 3}, v0{4, -1, 6};
  physics.particles().add_particle(dust, {.p_WP = p0, .v_WP = v0});
  ASSERT_TRUE(run(physics, 0.01, 100));
  const ParticleSystem now = physics.particles().system(dust);
  EXPECT_LT((now.p_WP(0) - (p0 + v0 + 0.5 * kG)).norm(), 1e-13);
  EXPECT_LT((now.v_WP(0) - (v0 + kG)).norm(), 1e-13);
}

TEST(ParticleSystem, ReachesTerminalVelocity) {
  // With drag c the velocity tends to m g / c with time constant m / c: v = (m g / c) (1 - exp(-c t / m)).
  // RK4's error is (c h / m)^4 / 120 of it: 1e-10 here.
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = kG});
  const ParticleSystemId dust = a_system(physics, 0.02);
  physics.forces().add(LinearDrag{.coefficient = 0.1, .particles = dust});
  physics.particles().add_particle(dust, {});
  ASSERT_TRUE(run(physics, 0.002, 250));
  const double expected = -0.02 * 9.81 / 0.1 * (1 - std::exp(-0.1 * 0.5 / 0.02));
  EXPECT_NEAR(physics.particles().system(dust).v_WP(0).z(), expected, 1e-9);
}

/// Error of the velocity under drag after half a second in this many steps.
double drag_error(const char* integrator, int steps) {
  PhysicsManager physics;
  physics.set_integrator(make_integrator(integrator));
  const ParticleSystemId dust = a_system(physics, 0.1);
  physics.forces().add(LinearDrag{.coefficient = 0.3, .medium_velocity = {1, 0, 0}});
  physics.particles().add_particle(dust, {.v_WP = {3, 2, 0}});
  EXPECT_TRUE(run(physics, 0.5 / steps, steps));
  const double decay = std::exp(-3 * 0.5);
  return (physics.particles().system(dust).v_WP(0) - Vector3{1 + 2 * decay, 2 * decay, 0}).norm();
}

TEST(ParticleSystem, KeepsTheOrderOfEveryIntegrator) {
  // The exact solution under linear drag is an exponential; halving the step divides the error by 2^order.
  for (const std::string& name : integrator_names()) {
    const std::unique_ptr<Integrator> integrator = make_integrator(name);
    if (integrator->control() != nullptr) continue;  // its tolerance decides, not the step: below
    const int order = integrator->order();
    const double measured = std::log2(drag_error(name.c_str(), 20) / drag_error(name.c_str(), 40));
    EXPECT_NEAR(measured, order, 0.15) << name;
  }
}

TEST(ParticleSystem, HoldsTheToleranceOfAnAdaptiveIntegrator) {
  // Dormand and Prince's method cuts the step to its default of 1e-9 a second, whatever the step asked for.
  EXPECT_LT(drag_error("dormand-prince", 1), 1e-9);
}

TEST(ParticleSystem, GivesTheSameBitsInBatchesOfAnySize) {
  // Each particle goes by itself: among 1000 others it takes the same bits as alone.
  const auto last = [](std::size_t count) {
    PhysicsManager physics;
    physics.forces().add(Gravity{});
    physics.forces().add(LinearDrag{.coefficient = 0.01});
    physics.deflectors().add(PlaneDeflector{});
    const ParticleSystemId dust = a_system(physics);
    for (std::size_t i = count; i-- > 0;) {
      physics.particles().add_particle(dust,
                                       {.p_WP = {0.1 * static_cast<double>(i), 0, 0.5}, .v_WP = {1, 2, 0}});
    }
    EXPECT_TRUE(run(physics, 0.01, 100));
    return physics.particles().system(dust).p_WP(count - 1);
  };
  const Vector3 alone = last(1), among = last(1000);
  EXPECT_EQ(alone, among);
}

TEST(ParticleSystem, KeepsIdsWhenOthersGo) {
  // A serial names one particle for good: removal and age close gaps in the arrays, ids follow.
  PhysicsManager physics;
  const ParticleSystemId dust = a_system(physics);
  ParticleManager& particles = physics.particles();
  const ParticleId a = particles.add_particle(dust, {.p_WP = {1, 0, 0}});
  const ParticleId b = particles.add_particle(dust, {.p_WP = {2, 0, 0}, .lifetime = 0.05});
  const ParticleId c = particles.add_particle(dust, {.p_WP = {3, 0, 0}, .mass = 7});
  particles.remove(a);
  EXPECT_EQ(particles.system(dust).position_of(c), 1u);
  ASSERT_TRUE(run(physics, 0.02, 2));
  EXPECT_TRUE(particles.system(dust).contains(b));
  const StepReport report = physics.step(0.02);
  EXPECT_EQ(report.particles.died, 1u);
  EXPECT_EQ(report.particles.count, 1u);
  const ParticleSystem now = particles.system(dust);
  EXPECT_FALSE(now.contains(a));
  EXPECT_FALSE(now.contains(b));
  ASSERT_EQ(now.position_of(c), 0u);
  EXPECT_EQ(now.p_WP(0).x(), 3);
  EXPECT_EQ(now.mass(0), 7);
  const ParticleId d = particles.add_particle(dust, {});
  EXPECT_EQ(d.serial, 3u);
  EXPECT_TRUE(particles.system(dust).contains(d));
}

TEST(ParticleSystem, ReportsItsEnergy) {
  // Free fall turns potential into kinetic energy: the sum stays, and equals m (v^2 / 2 + g z).
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = kG});
  const ParticleSystemId dust = a_system(physics, 0.5);
  physics.particles().add_particle(dust, {.p_WP = {0, 0, 2}, .v_WP = {3, 0, 0}});
  const double start = physics.particles().energy().total();
  EXPECT_NEAR(start, 0.5 * (4.5 + 9.81 * 2), 1e-14);
  StepReport report;
  for (int i = 0; i < 50; ++i) report = physics.step(0.01);
  EXPECT_NEAR(report.particles.energy.total(), start, 1e-12);
  EXPECT_NEAR(physics.particles().energy().kinetic, report.particles.energy.kinetic, 1e-13);
  EXPECT_NEAR(report.particles.energy.kinetic, 0.25 * (9 + std::pow(9.81 * 0.5, 2)), 1e-12);
}

TEST(ParticleSystem, LeavesEverythingAsItWasWhenANumberGoesWrong) {
  // The step fails as a whole: bodies that went well go back too, and the report names the particle.
  class Explosive final : public ForceLaw {
    void add_wrenches(const BodiesAt&, std::span<Wrench>) const override {}
    ParticleAction acts_on(ParticleSystemId) const override { return ParticleAction::Each; }
    void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (at.x[i] > 1) forces.y[i] = kInf;
      }
    }
  };
  PhysicsManager physics;
  physics.forces().add_law(std::make_unique<Explosive>());
  physics.add(test::thrown_body());
  const ParticleSystemId dust = a_system(physics);
  for (int i = 0; i < 300; ++i) physics.particles().add_particle(dust, {.v_WP = {0.001 * i, 0, 0}});
  const ParticleId fast = physics.particles().add_particle(dust, {.p_WP = {0.995, 0, 0}, .v_WP = {1, 0, 0}});
  State before = physics.snapshot();
  StepReport report = physics.step(0.004);
  while (report.ok() && physics.time() < 1) {
    before = physics.snapshot();
    report = physics.step(0.004);
  }
  EXPECT_EQ(report.status, StepStatus::NotFinite);
  EXPECT_EQ(report.particle, fast);
  EXPECT_NE(report.message.find("particle 300 of system 'dust'"), std::string::npos) << report.message;
  EXPECT_TRUE(physics.snapshot() == before);
}

TEST(ParticleSystem, AllocatesNothingInSteadySteps) {
  // Work space and arrays are kept from step to step, contacts included.
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  physics.deflectors().add(PlaneDeflector{.surface = {.restitution = 0.9, .friction = 0.1}});
  const ParticleSystemId dust = a_system(physics);
  for (int i = 0; i < 1000; ++i)
    physics.particles().add_particle(dust, {.p_WP = {0, 0, 0.001 * i}, .v_WP = {1, 0, 0}});
  ASSERT_TRUE(run(physics, 0.01, 3));
  const test::AllocationGuard guard;
  std::uint64_t deflections = 0;
  for (int i = 0; i < 20; ++i) deflections += physics.step(0.01).particles.deflections;
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_GT(deflections, 100u);
}

TEST(ParticleSystem, SaysWhatIsWrongWithItsSettings) {
  // One text a rule.
  PhysicsManager physics;
  ParticleManager& particles = physics.particles();
  const auto add = [&](ParticleSystemSettings settings) {
    return [&, settings] { particles.add(settings); };
  };
  expect_contract(add({.name = "s", .mass = 0}), "particle system 's': mass is 0 kg");
  expect_contract(add({.name = "s", .radius = -1}), "particle system 's': radius is -1 m");
  expect_contract(add({.name = "s", .capacity = 0}), "capacity is 0");
  expect_contract(add({.name = "s", .substeps = 0}), "substeps is 0");
  const ParticleSystemId small = particles.add(ParticleSystemSettings{.name = "small", .capacity = 1});
  const ParticleId id = particles.add_particle(small, {});
  expect_contract([&] { particles.add_particle(small, {}); }, "particle system 'small' is full");
  expect_contract([&] { particles.add_particle(small, {.lifetime = 0}); }, "lifetime is 0 s");
  expect_contract(
      [&] {
        particles.add_particle(small, {.p_WP = {kInf, 0, 0}});
      },
      "particle: position is (inf, 0, 0)");
  expect_contract([&] { particles.add_particle(small, {.mass = -1}); }, "particle: mass is -1 kg");
  particles.remove(id);
  expect_contract([&] { particles.set_velocity(id, Vector3::Zero()); },
                  "particle 0 of particle system 1 is not there");
  particles.remove(small);
  expect_contract([&] { static_cast<void>(particles.system(small)); },
                  "particle system 1 is null or was removed");
}

TEST(ParticleSystem, RewindsBitForBit) {
  // Particles belong to the state: births, deaths and contacts come out the same from an equal state.
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  physics.deflectors().add(
      PlaneDeflector{.surface = {.restitution = 0.7, .friction = 0.2, .stickiness = 2.7}});
  const ParticleSystemId dust = a_system(physics);
  EmitterSettings fountain{.speed = {3, 4}, .spread = 0.4, .rate = 500, .lifetime = {0.3, 0.9}, .seed = 5};
  fountain.X_BE.p.z() = 0.3;
  physics.particles().add_emitter(dust, fountain);
  ASSERT_TRUE(run(physics, 0.01, 60));
  const State middle = physics.snapshot();
  ASSERT_TRUE(run(physics, 0.01, 60));
  const State first = physics.snapshot();
  EXPECT_GT(first.particles.at(0).size(), 100u);
  EXPECT_GT(first.particles.at(0).stuck.size(), 0u);
  physics.restore(middle);
  EXPECT_EQ(hash(physics.snapshot()), hash(middle));
  ASSERT_TRUE(run(physics, 0.01, 60));
  EXPECT_TRUE(physics.snapshot() == first);
  EXPECT_EQ(hash(physics.snapshot()), hash(first));
  EXPECT_NE(hash(middle), hash(first));
  PhysicsManager other;
  expect_contract([&] { other.restore(first); }, "the state was taken with other");
}

}  // namespace
}  // namespace pantin
