#pragma once
// A thrown body and a particle under one law: does rk4 keep its order?
#include <cmath>

#include <gtest/gtest.h>

#include <pantin/physics/physics_manager.hpp>

#include "support/mechanisms.hpp"

namespace pantin::test {

/// Momenta, place of the body, place and velocity of the particle after `duration` in `steps` equal steps.
template <class Settings>
Eigen::VectorXd state_under(const Settings& law, double duration, int steps) {
  PhysicsManager physics;
  const BodyId body = physics.add(thrown_body());
  const ParticleSystemId system = physics.particles().add(ParticleSystemSettings{.mass = 0.5});
  physics.particles().add_particle(system, {.p_WP = {1, 0.5, -2}, .v_WP = {-1, 2, 0.5}});
  physics.forces().add(law);
  EXPECT_TRUE(run(physics, duration / steps, steps));
  Eigen::VectorXd out(15);
  out << physics.body(body).p_WBcm(), physics.body(body).linear_momentum(),
      physics.body(body).angular_momentum(), physics.particles().system(system).p_WP(0),
      physics.particles().system(system).v_WP(0);
  return out;
}

/// Halving the step divides the error of rk4 by 16 where the law is a smooth function of time and state and
/// is evaluated at the stages. The reference has 16 times the steps, so its own error is 1e-4 of the finer's.
template <class Settings>
void expect_order_4(const Settings& law, double duration = 1, int steps = 40) {
  const Eigen::VectorXd exact = state_under(law, duration, 16 * steps);
  const double coarse = (state_under(law, duration, steps) - exact).norm(),
               fine = (state_under(law, duration, 2 * steps) - exact).norm();
  EXPECT_GT(fine, 1e-12);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.3) << coarse << " -> " << fine;
}

}  // namespace pantin::test
