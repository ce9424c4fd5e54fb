#include <pantin/physics/step_group.hpp>

#include <gtest/gtest.h>

#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/forces/particle_springs.hpp>
#include <pantin/physics/integrators/dormand_prince.hpp>
#include <pantin/physics/integrators/gauss.hpp>
#include <pantin/physics/integrators/radau.hpp>
#include <support/allocation_guard.hpp>

#include "support/four_bar.hpp"
#include "support/mechanisms.hpp"
#include "support/order_of_convergence.hpp"

namespace pantin {
namespace {

constexpr double kStep = 0.1;

/// A pendulum a tenth of a millimetre long: it swings at some 300 rad/s.
BodyId add_fast_pendulum(PhysicsManager& physics) {
  MassProperties m{1, {0, 0, -1e-4}, 1e-9 * Matrix3::Identity()};
  const Quaternion turned{Eigen::AngleAxisd{1, Vector3::UnitX()}};
  const BodyId id = physics.add({.name = "fast", .X_WB = {{5, 0, 0}, turned}, .mass = m});
  physics.add(test::joint_here<PivotSettings>(physics, {}, id, {{5, 0, 0}, test::facing({1, 0, 0})}));
  return id;
}

/// Three lopsided links, hanging askew.
std::vector<BodyId> add_slow_chain(PhysicsManager& physics) {
  std::vector<BodyId> links;
  for (int i = 0; i < 3; ++i) {
    const Vector3 p{0.6 * i, 0, 0};
    links.push_back(physics.add({.name = "slow", .X_WB = {p}, .mass = test::lopsided_mass()}));
    physics.add(test::joint_here<PivotSettings>(physics, i == 0 ? BodyId{} : links[links.size() - 2],
                                                links.back(), {p, test::facing({0, 1, 0.3})}));
  }
  return links;
}

/// The group of a body.
IslandGroup group_of(PhysicsManager& physics, BodyId body) {
  for (const IslandGroup& group : physics.islands()) {
    if (std::find(group.bodies.begin(), group.bodies.end(), body) != group.bodies.end()) return group;
  }
  return {};
}

bool same_motion(const RigidBody& a, const RigidBody& b) {
  return a.p_WBcm() == b.p_WBcm() && a.q_WB().coeffs() == b.q_WB().coeffs() &&
         a.linear_momentum() == b.linear_momentum() && a.angular_momentum() == b.angular_momentum();
}

using MakeIntegrator = std::function<std::unique_ptr<Integrator>()>;
const std::vector<MakeIntegrator>& controlled() {
  static const std::vector<MakeIntegrator> all{[] { return make_dormand_prince({.tolerance = 1e-8}); },
                                               [] { return make_integrator("gauss16", 1e-10); },
                                               [] { return make_integrator("radau", 1e-7); }};
  return all;
}

TEST(StepGroup, LeavesTheStepsOfASlowIslandAlone) {
  // Nothing couples the two: the slow chain must take the steps, and reach the bits, that it takes and
  // reaches where there is nothing else, while the fast pendulum needs many more.
  for (const MakeIntegrator& make : controlled()) {
    PhysicsManager both, alone;
    for (PhysicsManager* physics : {&both, &alone}) {
      physics->forces().add(Gravity{});
      physics->set_integrator(make());
    }
    const BodyId fast = add_fast_pendulum(both);
    const std::vector<BodyId> slow = add_slow_chain(both), expected = add_slow_chain(alone);
    for (int i = 0; i < 10; ++i) {
      const StepReport of_both = both.step(kStep), of_slow = alone.step(kStep);
      ASSERT_TRUE(of_both.ok() && of_slow.ok());
      const IslandGroup hurried = group_of(both, fast), calm = group_of(both, slow[0]);
      EXPECT_EQ(calm.evaluations, of_slow.evaluations);
      EXPECT_EQ(calm.inner_steps, of_slow.inner_steps);
      EXPECT_EQ(calm.refused_steps, of_slow.refused_steps);
      EXPECT_EQ(calm.shortest_step, of_slow.shortest_step);
      EXPECT_GT(hurried.evaluations, 2 * calm.evaluations) << both.integrator().name();
      EXPECT_EQ(of_both.evaluations, calm.evaluations + hurried.evaluations);
      EXPECT_EQ(of_both.inner_steps, calm.inner_steps + hurried.inner_steps);
      EXPECT_EQ(of_both.shortest_step, hurried.shortest_step);
    }
    for (std::size_t i = 0; i < slow.size(); ++i) {
      EXPECT_TRUE(same_motion(both.body(slow[i]), alone.body(expected[i]))) << both.integrator().name();
    }
  }
}

TEST(StepGroup, MovesALoopAsIfItWereAlone) {
  // Cut joints and paths of a loop are numbered anew for its part: with an island before it, every bit is as
  // without.
  for (const MakeIntegrator& make : controlled()) {
    test::FourBar alone, beside;
    alone.physics.set_integrator(make());
    beside.physics.set_integrator(make());
    add_fast_pendulum(beside.physics);
    const BodyId moved = beside.physics.add(test::thrown_body());
    beside.physics.forces().add(DampedSpring{.a = {moved}, .stiffness = 500});
    for (int i = 0; i < 5; ++i) {
      const StepReport report = beside.physics.step(0.02);
      ASSERT_TRUE(report.ok()) << report.message;
      const StepReport of_alone = alone.physics.step(0.02);
      EXPECT_EQ(group_of(beside.physics, beside.rods[0]).evaluations, of_alone.evaluations);
      EXPECT_EQ(report.loop_margin, of_alone.loop_margin);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(same_motion(beside.physics.body(beside.rods[i]), alone.physics.body(alone.rods[i])));
    }
    EXPECT_LT(beside.physics.joint_drift().distance, 1e-9);
  }
}

TEST(StepGroup, DoesNotTellAnExplicitIntegratorInPartsFromOneForAll) {
  // Explicit formulas act on each number by itself: islands stepped one by one, each by an integrator of its
  // own, reach the bits of one integrator over all of them.
  PhysicsManager together, parts;
  for (PhysicsManager* physics : {&together, &parts}) {
    physics->forces().add(Gravity{});
    const BodyId fast = add_fast_pendulum(*physics);
    physics->add(test::thrown_body());
    const std::vector<BodyId> slow = add_slow_chain(*physics);
    if (physics == &together) continue;
    physics->set_integrator(fast, make_integrator("rk4"));
    physics->set_integrator(slow[1], make_integrator("rk4"));
    EXPECT_EQ(physics->islands().size(), 3u);
  }
  EXPECT_EQ(together.islands().size(), 1u);
  ASSERT_TRUE(test::run(together, 1e-3, 100) && test::run(parts, 1e-3, 100));
  EXPECT_EQ(hash(together.snapshot()), hash(parts.snapshot()));
}

TEST(StepGroup, KeepsTheOrderOfEachIntegrator) {
  // Two free oscillators of their own beside each other, x = cos(10 t), each by another method: the error of
  // each falls at the order of its method.
  const auto errors = [](int steps) {
    PhysicsManager physics;
    std::array<BodyId, 2> ids;
    for (const std::size_t i : {0u, 1u}) {
      MassProperties m{1, Vector3::Zero(), Matrix3::Identity()};
      const Vector3 at{0, 3.0 * static_cast<double>(i), 0};
      ids[i] = physics.add({.X_WB = {at + Vector3::UnitX()}, .mass = m});
      // It moves along the line of the spring, which never turns.
      physics.forces().add(DampedSpring{
          .a = {{}, at - Vector3{1e3, 0, 0}}, .b = {ids[i]}, .stiffness = 100, .rest_length = 1e3});
    }
    physics.set_integrator(ids[0], make_integrator("verlet"));
    physics.set_integrator(ids[1], make_integrator("rk4"));
    EXPECT_TRUE(test::run(physics, 1.0 / steps, steps));
    return std::array{std::abs(physics.body(ids[0]).p_WBcm().x() - std::cos(10)),
                      std::abs(physics.body(ids[1]).p_WBcm().x() - std::cos(10))};
  };
  const auto coarse = errors(200), fine = errors(400);
  EXPECT_NEAR(std::log2(coarse[0] / fine[0]), 2, 0.1);
  EXPECT_NEAR(std::log2(coarse[1] / fine[1]), 4, 0.1);
}

/// The islands of all kinds: two trees, a free body, one on a spring, particles that springs couple.
struct Mixed {
  Mixed() {
    physics.forces().add(Gravity{});
    fast = add_fast_pendulum(physics);
    slow = add_slow_chain(physics);
    free = physics.add(test::thrown_body());
    sprung = physics.add(test::thrown_body());
    physics.forces().add(DampedSpring{.a = {sprung}, .stiffness = 2000, .damping = 5});
    ParticleManager& particles = physics.particles();
    system = particles.add(ParticleSystemSettings{.mass = 0.1});
    const ParticleId a = particles.add_particle(system, {.p_WP = {0, 2, 0}}),
                     b = particles.add_particle(system, {.p_WP = {0, 2.5, 0}});
    ParticleSprings springs;
    springs.springs.push_back({.a = a, .b = b, .stiffness = 40, .rest_length = 0.3});
    springs.springs.push_back({.a = a, .anchor = {slow[2]}, .stiffness = 10, .rest_length = 0.3});
    physics.forces().add(springs);
    physics.set_integrator(make_integrator("gauss16", 1e-9));
    physics.set_integrator(sprung, make_integrator("radau", 1e-6));
    physics.set_integrator(fast, make_dormand_prince({.tolerance = 1e-8}));
  }
  PhysicsManager physics;
  BodyId fast{}, free{}, sprung{};
  std::vector<BodyId> slow{};
  ParticleSystemId system{};
};

TEST(StepGroup, ContinuesBitForBitFromASnapshot) {
  // Each island's memory is part of the state, also for another manager that was built alike.
  Mixed mixed, other;
  EXPECT_EQ(mixed.physics.islands().size(), 4u);
  ASSERT_TRUE(test::run(mixed.physics, kStep, 3));
  const State here = mixed.physics.snapshot();
  ASSERT_TRUE(test::run(mixed.physics, kStep, 3));
  const State there = mixed.physics.snapshot();
  for (PhysicsManager* physics : {&mixed.physics, &other.physics}) {
    physics->restore(here);
    ASSERT_TRUE(test::run(*physics, kStep, 3));
    const State again = physics->snapshot();
    EXPECT_EQ(hash(again), hash(there));
    ASSERT_EQ(again.memories.size(), 4u);
    for (std::size_t g = 0; g < 4; ++g) {
      EXPECT_EQ(again.memories[g].next, there.memories[g].next);
      EXPECT_EQ(again.memories[g].slopes, there.memories[g].slopes);
    }
  }
}

TEST(StepGroup, AllocatesNothingInASteadyStep) {
  // Groups are made where bodies, joints, laws or integrators change, and only there. (Radau factors matrices
  // anew, which allocates by itself.)
  Mixed mixed;
  mixed.physics.set_integrator(mixed.sprung, make_integrator("gauss8", 1e-6));
  ASSERT_TRUE(test::run(mixed.physics, 1e-2, 5));
  const test::AllocationGuard guard;
  const bool went_well = test::run(mixed.physics, 1e-2, 5);
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_TRUE(went_well);
}

TEST(StepGroup, KeepsTheMotionInsideAStep) {
  // Islands cut a step into parts of their own; asked inside the step, each is where a manager is that was
  // stopped there, within what interpolants (fourth order and more) and tolerances leave.
  Mixed whole, part;
  whole.physics.keep_motion(true);
  ASSERT_TRUE(whole.physics.step(kStep).ok());
  for (const double t : {0.25 * kStep, 0.6 * kStep, kStep}) {
    ASSERT_TRUE(part.physics.step(t - part.physics.time()).ok());
    const std::vector<BodyKinematics> inside = whole.physics.motion_at(t);
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const RigidBody body = part.physics.body(part.physics.bodies()[i]);
      EXPECT_LT((inside[i].p_WBcm - body.p_WBcm()).norm(), 1e-6) << i << ' ' << t;
      EXPECT_LT((inside[i].v_WBcm - body.v_WBcm()).norm(), 2e-5) << i << ' ' << t;
    }
  }
}

TEST(StepGroup, ChangesNothingWhereOneIslandFails) {
  // One island whose numbers overflow takes the step back for all; the report names its body.
  class Poison final : public ForceLaw {
   public:
    explicit Poison(BodyId body) : body_{body} {}
    void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
      if (at.t > 0.15) wrenches[at.index(body_)].force.x() = std::numeric_limits<double>::infinity();
    }
    Coupling coupling() const override { return {.reach = Coupling::Reach::Named, .bodies = {body_}}; }

   private:
    BodyId body_;
  };
  for (const bool is_first : {true, false}) {
    Mixed mixed;
    const BodyId culprit = is_first ? mixed.fast : mixed.sprung;
    mixed.physics.forces().add_law(std::make_unique<Poison>(culprit));
    ASSERT_TRUE(mixed.physics.step(kStep).ok());
    const std::uint64_t before = hash(mixed.physics.snapshot());
    const StepReport report = mixed.physics.step(kStep);
    EXPECT_EQ(report.status, StepStatus::NotFinite);
    EXPECT_EQ(report.body, culprit);
    EXPECT_GT(report.evaluations, 0);
    EXPECT_EQ(hash(mixed.physics.snapshot()), before);
  }
}

TEST(StepGroup, GivesParticlesThatNoBodyIsCoupledWithTheirOwnIntegrator) {
  // Particles are a kind of their own: those that springs tie only to each other go by the particles'
  // integrator, and those tied to a body by the body's.
  Mixed mixed;
  mixed.physics.particles().set_integrator(make_integrator("verlet"));
  EXPECT_EQ(group_of(mixed.physics, mixed.slow[2]).integrator, "gauss16");
  EXPECT_TRUE(group_of(mixed.physics, mixed.slow[2]).has_particles);

  mixed.physics.make_static(mixed.slow[2]);
  const std::vector<IslandGroup> groups = mixed.physics.islands();
  const IslandGroup& last = groups.back();
  EXPECT_TRUE(last.bodies.empty() && last.has_particles);
  EXPECT_EQ(last.integrator, "verlet");
  ASSERT_TRUE(mixed.physics.step(1e-3).ok());
  EXPECT_EQ(mixed.physics.islands().back().inner_steps, 0);
  mixed.physics.particles().set_integrator(nullptr);
  EXPECT_EQ(mixed.physics.islands().back().integrator, "gauss16");
  EXPECT_TRUE(mixed.physics.step(1e-3).ok());
}

}  // namespace
}  // namespace pantin
