#include <pantin/physics/particles/ties.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <pantin/physics/deflectors/plane.hpp>
#include <pantin/physics/deflectors/sphere.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/forces/linear_drag.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <support/allocation_guard.hpp>
#include <support/expect_contract.hpp>

#include "support/mechanisms.hpp"
#include "support/rope.hpp"

namespace pantin {
namespace {

using test::expect_contract;
using test::Rope;
using test::run;

constexpr double kG = 9.81;

/// Quarter period of a pendulum of length 1 let go at the horizontal: where x changes sign, by the straight
/// line between the steps around it.
double quarter_period(int substeps) {
  Rope rope{2, {0, 0, 0}, {1, 0, 0}, 1, substeps};
  rope.physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
  rope.pin(0);
  const double h = 0.02;
  for (double before = 1;; before = rope.p(1).x()) {
    if (!rope.physics.step(h).ok()) return 0;
    const double x = rope.p(1).x();
    if (x < 0) return rope.physics.time() - h * x / (x - before);
  }
}

TEST(ParticleTies, SwingWithThePeriodOfAPendulum) {
  // From the horizontal the quarter period is K(1/2) sqrt(l / g) with the elliptic integral K(m = 1/2) =
  // 1.85407467730137. The error falls with the square of the substep; the crossing is read off a straight
  // piece, whose own error is common to all and below 1e-6 (x is odd about the crossing but for its third
  // derivative).
  const double exact = 1.85407467730137 * std::sqrt(1 / kG);
  const double coarse = std::abs(quarter_period(2) - exact), fine = std::abs(quarter_period(4) - exact);
  EXPECT_LT(std::abs(quarter_period(32) - exact), 2e-5);
  EXPECT_GT(coarse / fine, 3) << coarse << " " << fine;
}

TEST(ParticleTies, KeepLengthsAndEnergyOfAFallingChain) {
  // Rigid ties do no work, and gravity is uniform: the method keeps the energy to the tolerance of its
  // solves, through the whip of a chain that falls from the horizontal; lengths stay to 1e-10.
  Rope rope{21, {0, 0, 0}, {0.05, 0, 0}};
  rope.physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
  rope.pin(0);
  const double start = rope.physics.particles().energy().total(), scale = 0.2 * kG * 0.5;
  for (int i = 0; i < 300; ++i) {
    const StepReport report = rope.physics.step(1.0 / 240);
    ASSERT_TRUE(report.ok());
    EXPECT_TRUE(report.particles.converged) << i;
    EXPECT_LT(report.particles.constraint_error, 1e-8);
    EXPECT_NEAR(report.particles.energy.total(), start, 1e-6 * scale) << i;
  }
}

TEST(ParticleTies, KeepMomenta) {
  // A free rope with bending in space: no force from outside, so linear and angular momentum and energy stay.
  Rope rope{12, {0, 0, 0}, {0.1, 0, 0}};
  for (std::size_t i = 2; i < rope.ids.size(); ++i) {
    rope.physics.particles().add(
        BendTie{.a = rope.ids[i - 2], .b = rope.ids[i - 1], .c = rope.ids[i], .stiffness = 1e-3});
  }
  for (std::size_t i = 0; i < rope.ids.size(); ++i) {
    const double s = static_cast<double>(i);
    rope.physics.particles().set_velocity(rope.ids[i], {0, std::sin(s), 0.3 * s});
  }
  ASSERT_TRUE(
      run(rope.physics, 0.005, 20));  // velocities that ties do not allow are mirrored; then all is smooth
  const auto momenta = [&] {
    test::Momenta sum;
    for (std::size_t i = 0; i < rope.ids.size(); ++i) {
      sum.linear += 0.01 * rope.v(i);
      sum.angular += rope.p(i).cross(0.01 * rope.v(i));
    }
    return sum;
  };
  const test::Momenta before = momenta();
  double energy = rope.physics.particles().energy().total();
  const double start = energy;
  for (int i = 0; i < 200; ++i) {
    const StepReport report = rope.physics.step(0.005);
    EXPECT_LE(report.particles.energy.total(),
              energy + 1e-9 * start);  // bending faster than a substep is damped
    energy = report.particles.energy.total();
  }
  EXPECT_LT((momenta().linear - before.linear).norm(), 1e-13);
  EXPECT_LT((momenta().angular - before.angular).norm(), 1e-8);  // to the tolerance of 800 solves
  EXPECT_GT(energy, 0.5 * start);
}

TEST(ParticleTies, StretchAsSpringsWithCompliance) {
  // One mass on a tie of compliance 1/k swings about m g / k below with sqrt(k / m); after a whole period it
  // is back, with an error of second order in the substep.
  const auto miss = [](int substeps) {
    Rope rope{2, {0, 0, 0}, {0, 0, -1}, 0.5, substeps};
    rope.physics.particles().remove(rope.ties[0]);
    rope.physics.particles().add(DistanceTie{.a = rope.ids[0], .b = rope.ids[1], .compliance = 1.0 / 50});
    rope.physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
    rope.pin(0);
    const double period = 2 * std::numbers::pi * std::sqrt(0.5 / 50);
    EXPECT_TRUE(run(rope.physics, period / 40, 50));  // a quarter more: there velocity is the greatest
    return std::abs(rope.p(1).z() - (-1 - 0.5 * kG / 50));
  };
  const double coarse = miss(1), fine = miss(2);
  EXPECT_GT(coarse / fine, 3.5);
  EXPECT_LT(fine, 2e-3);
}

TEST(ParticleTies, PullAtTheBodyThatHoldsThem) {
  // A rope pinned to a free body in space: what ties give to the pinned end goes to the body, so the momentum
  // of the body and of the loose particles together stays to rounding.
  Rope rope{6, {0.3, 0, 0}, {0.1, 0, 0}, 0.02};
  const BodyId body = rope.physics.add(
      RigidBodySettings{.w_WB = {0, 0, 3}, .mass = mass_of({BoxShape{{0.6, 0.4, 0.2}}, Pose{}}, 50)});
  rope.physics.particles().pin(rope.ids[0], {body, {0.3, 0, 0}});
  ASSERT_TRUE(run(rope.physics, 0.002, 50));
  const auto linear = [&] {
    Vector3 sum = rope.physics.body(body).linear_momentum();
    for (std::size_t i = 1; i < rope.ids.size(); ++i) sum += 0.02 * rope.v(i);
    return sum;
  };
  const Vector3 before = linear();
  ASSERT_TRUE(run(rope.physics, 0.002, 200));
  EXPECT_LT((linear() - before).norm(), 1e-13);
  EXPECT_GT((rope.physics.body(body).v_WBcm()).norm(), 1e-3);
  EXPECT_LT((rope.p(0) - rope.physics.body(body).X_WB() * Vector3{0.3, 0, 0}).norm(), 1e-12);
}

TEST(ParticleTies, LieOnDeflectors) {
  // A rope dropped over a ball and the ground comes to lie: nothing below the surfaces, lengths held, no
  // energy won.
  Rope rope{31, {-0.75, 0.02, 1}, {0.05, 0, 0}, 0.01, 8};
  rope.physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
  rope.physics.deflectors().add(PlaneDeflector{.surface = {.restitution = 0, .friction = 0.8}});
  rope.physics.deflectors().add(SphereDeflector{
      .on = {.X_BD = {{0, 0, 0.3}}}, .radius = 0.3, .surface = {.restitution = 0, .friction = 0.8}});
  const double start = rope.physics.particles().energy().total();
  std::uint64_t hits = 0;
  for (int i = 0; i < 600; ++i) {
    const StepReport report = rope.physics.step(1.0 / 120);
    ASSERT_TRUE(report.ok());
    hits += report.particles.deflections;
    EXPECT_LT(report.particles.energy.total(), start * 1.001) << i;
    EXPECT_LT(report.particles.constraint_error, 0.02) << i;
  }
  EXPECT_GT(hits, 100u);
  for (std::size_t i = 0; i < rope.ids.size(); ++i) {
    EXPECT_GT(rope.p(i).z(), -0.003);
    EXPECT_GT((rope.p(i) - Vector3{0, 0, 0.3}).norm(), 0.297);
  }
}

TEST(ParticleTies, GoOnBitForBitAfterARestoreAndAllocateNothing) {
  // All that a rope remembers is its particles; steady steps use the work space of the first.
  Rope rope{30, {0, 0, 0}, {0.05, 0.01, 0}};
  rope.physics.forces().add(Gravity{});
  rope.pin(0);
  ASSERT_TRUE(run(rope.physics, 0.01, 10));
  const State middle = rope.physics.snapshot();
  ASSERT_TRUE(run(rope.physics, 0.01, 20));
  const State end = rope.physics.snapshot();
  rope.physics.restore(middle);
  ASSERT_TRUE(run(rope.physics, 0.01, 1));
  const test::AllocationGuard guard;
  ASSERT_TRUE(run(rope.physics, 0.01, 19));
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_TRUE(rope.physics.snapshot() == end);
}

TEST(ParticleTies, LetGoWhereAParticleOrTieIsGone) {
  // A rope cut in the middle falls below the cut: free fall from there, while the upper part hangs.
  for (const bool by_particle : {false, true}) {
    Rope rope{5, {0, 0, 0}, {0, 0, -0.1}};
    rope.physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
    rope.pin(0);
    ASSERT_TRUE(run(rope.physics, 0.01, 5));
    const double before = rope.p(4).z();
    if (by_particle) {
      rope.physics.particles().remove(rope.ids[2]);
    } else {
      rope.physics.particles().remove(rope.ties[1]);
    }
    ASSERT_TRUE(run(rope.physics, 0.01, 10));
    const ParticleSystem now = rope.physics.particles().system(rope.system);
    EXPECT_NEAR(now.p_WP(now.position_of(rope.ids[4])).z(), before - 0.5 * kG * 0.01, 1e-9);
    EXPECT_NEAR(now.p_WP(now.position_of(rope.ids[1])).z(), -0.1, 1e-9);
  }
}

TEST(ParticleTies, SayWhatIsWrongWithTheirSettings) {
  // One text a rule.
  Rope rope{4, {0, 0, 0}, {1, 0, 0}};
  ParticleManager& p = rope.physics.particles();
  const ParticleId a = rope.ids[0], b = rope.ids[1], c = rope.ids[2], d = rope.ids[3];
  expect_contract([&] { p.add(DistanceTie{.a = a, .b = a}); }, "distance tie: a particle is named twice");
  expect_contract([&] { p.add(DistanceTie{.a = a}); },
                  "distance tie: a particle is null, or of another system");
  expect_contract([&] { p.add(DistanceTie{.a = a, .b = b, .compliance = -1}); }, "compliance is -1 m/N");
  expect_contract([&] { p.add(DistanceTie{.a = a, .b = b, .damping_time = -1}); }, "damping time is -1 s");
  expect_contract([&] { p.add(BendTie{.a = a, .b = b, .c = c}); }, "bend tie: stiffness is 0 N m^2");
  expect_contract([&] { p.add(HingeTie{.a = a, .b = b, .c = c, .d = d}); }, "hinge tie: stiffness is 0 N m");
  expect_contract([&] { p.add(HingeTie{.a = a, .b = b, .c = c, .d = d, .stiffness = 1}); },
                  "stand at one place");
  expect_contract([&] { p.remove(ParticleConstraintId{}); }, "tie 0 is null or was removed");
}

}  // namespace
}  // namespace pantin
