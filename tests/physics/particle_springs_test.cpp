#include <pantin/physics/forces/particle_springs.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include <pantin/physics/physics_manager.hpp>
#include <support/allocation_guard.hpp>
#include <support/expect_contract.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::expect_contract;
using test::run;

/// A thrown body, three particles, springs between all of them.
struct Net {
  explicit Net(double damping = 0) {
    body = physics.add(test::thrown_body());
    system = physics.particles().add(ParticleSystemSettings{.mass = 0.4});
    for (int i = 0; i < 3; ++i) {
      ids[i] = physics.particles().add_particle(
          system,
          {.p_WP = {1.5 + i, 2.5, 3.0 - 0.3 * i}, .v_WP = {0.1 * i, 0.5, -0.2}, .mass = 0.2 + 0.1 * i});
    }
    ParticleSprings net;
    for (int i = 0; i < 3; ++i) {
      const double k = 20 + 5 * i;
      net.springs.push_back({.a = ids[i],
                             .anchor = {body, {0.2, 0.1 * i, -0.1}},
                             .stiffness = k,
                             .damping = damping,
                             .rest_length = 0.4});
      net.springs.push_back(
          {.a = ids[i], .b = ids[(i + 1) % 3], .stiffness = k, .damping = damping, .rest_length = 0.8});
    }
    physics.forces().add(net);
  }
  test::Momenta momenta() const {
    test::Momenta sum = test::momenta_of(physics);
    const ParticleSystem now = physics.particles().system(system);
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Vector3 P = now.mass(i) * now.v_WP(i);
      sum.linear += P;
      sum.angular += now.p_WP(i).cross(P);
    }
    return sum;
  }
  Eigen::VectorXd state() const {
    Eigen::VectorXd out(24);
    const ParticleSystem now = physics.particles().system(system);
    for (std::size_t i = 0; i < 3; ++i) {
      out.segment<3>(static_cast<Eigen::Index>(6 * i)) = now.p_WP(i);
      out.segment<3>(static_cast<Eigen::Index>(6 * i + 3)) = now.v_WP(i);
    }
    out.segment<3>(18) = physics.body(body).p_WBcm();
    out.segment<3>(21) = physics.body(body).angular_momentum();
    return out;
  }
  PhysicsManager physics{};
  BodyId body{};
  ParticleSystemId system{};
  ParticleId ids[3]{};
};

Eigen::VectorXd after(const std::string& integrator, double damping, int steps) {
  Net net{damping};
  net.physics.set_integrator(make_integrator(integrator));
  EXPECT_TRUE(run(net.physics, 0.5 / steps, steps));
  return net.state();
}

TEST(ParticleSprings, KeepTheOrderOfTheIntegratorAcrossBodiesAndParticles) {
  // Bodies and coupled particles are one system of equations: against a solution with 16 times the steps the
  // error falls by 2^order when the step is halved. The reference is RK4's, whose own error is negligible
  // beside it.
  for (const std::string name : {"euler", "semi-implicit-euler", "verlet", "implicit-midpoint", "rk4"}) {
    const int order = make_integrator(name)->order(), steps = order == 1 ? 800 : 50;
    const Eigen::VectorXd exact = after("rk4", 0.5, 1600);
    const double coarse = (after(name, 0.5, steps) - exact).norm(),
                 fine = (after(name, 0.5, 2 * steps) - exact).norm();
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.35) << name;
  }
}

TEST(ParticleSprings, KeepMomentumAndEnergy) {
  // Inner forces on one line: linear and angular momentum of bodies and particles together stay to rounding
  // (angular momentum to the integrator's error), and without damping so does the energy. Two particles pass
  // each other at 2 cm, where springs turn fast: hence the small step (energy errs by 2e-4, 2e-6, 3e-8 J at
  // 1, 1/2, 1/4 ms).
  Net net;
  const test::Momenta before = net.momenta();
  StepReport report = net.physics.step(2.5e-4);
  const double energy = report.energy.total() + report.particles.energy.total();
  for (int i = 0; i < 2000; ++i) report = net.physics.step(2.5e-4);
  EXPECT_LT((net.momenta().linear - before.linear).norm(), 1e-12);
  EXPECT_LT((net.momenta().angular - before.angular).norm(), 1e-8);
  EXPECT_NEAR(report.energy.total() + report.particles.energy.total(), energy, 1e-8 * std::abs(energy));
}

TEST(ParticleSprings, PullNoMoreWhereAParticleIsGone) {
  // Removing all three particles leaves a free body: its momentum then stays to the bit.
  Net net;
  ASSERT_TRUE(run(net.physics, 0.01, 5));
  for (const ParticleId id : net.ids) net.physics.particles().remove(id);
  const Vector3 P = net.physics.body(net.body).linear_momentum();
  ASSERT_TRUE(run(net.physics, 0.01, 5));
  EXPECT_EQ(net.physics.body(net.body).linear_momentum(), P);
}

TEST(ParticleSprings, AllocateNothingInSteadySteps) {
  // The coupled equations keep their work space.
  Net net;
  ASSERT_TRUE(run(net.physics, 0.01, 3));
  const test::AllocationGuard guard;
  ASSERT_TRUE(run(net.physics, 0.01, 10));
  EXPECT_EQ(guard.count(), 0u);
}

TEST(ParticleSprings, SayWhatIsWrongWithTheirSettings) {
  // One text a rule.
  Net net;
  const auto add = [&](ParticleSpring spring) {
    return [&net, spring] { net.physics.forces().add(ParticleSprings{.springs = {spring}}); };
  };
  expect_contract([&] { net.physics.forces().add(ParticleSprings{}); },
                  "particle springs: there is no spring");
  expect_contract(add({.a = net.ids[0], .b = net.ids[0]}), "particle spring 0: both ends are one particle");
  expect_contract(add({.a = {}}), "particle spring 0: end a is no particle");
  expect_contract(add({.a = net.ids[0], .stiffness = -1}), "particle spring 0: stiffness is -1 N/m");
}

}  // namespace
}  // namespace pantin
