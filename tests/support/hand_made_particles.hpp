#pragma once
// A batch of particles in any state, as force laws see it, without a ParticleManager.
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <support/near.hpp>

#include <pantin/physics/forces/force_law.hpp>

namespace pantin::test {

class HandMadeParticles {
 public:
  explicit HandMadeParticles(ParticleSystemId system = {.index = 3, .generation = 1}) : system_{system} {}
  void add(const Vector3& p, const Vector3& v, double mass) {
    for (std::size_t k = 0; k < 3; ++k) {
      p_[k].push_back(p[static_cast<Eigen::Index>(k)]);
      v_[k].push_back(v[static_cast<Eigen::Index>(k)]);
    }
    masses_.push_back(mass);
  }
  void add_random(std::mt19937_64& random, int count) {
    for (int i = 0; i < count; ++i) add(random_vector(random, 3), random_vector(random, 2), 0.5 + 0.1 * i);
  }
  void displace(std::size_t i, std::size_t axis, double step) { p_[axis][i] += step; }

  [[nodiscard]] ParticleSystemId system() const { return system_; }
  [[nodiscard]] ParticlesAt at(double t = 0) const {
    return {t, Side::After, system_, p_[0], p_[1], p_[2], v_[0], v_[1], v_[2], masses_};
  }

 private:
  ParticleSystemId system_;
  std::vector<double> p_[3], v_[3], masses_;
};

/// The forces of one law that acts on each by itself.
inline std::vector<Vector3> forces_of(const ForceLaw& law, const HandMadeParticles& particles, double t = 0) {
  EXPECT_EQ(law.acts_on(particles.system()), ParticleAction::Each);
  const ParticlesAt at = particles.at(t);
  std::vector<double> x(at.size()), y(at.size()), z(at.size());
  law.add_particle_forces(at, {x, y, z});
  std::vector<Vector3> out;
  for (std::size_t i = 0; i < at.size(); ++i) out.emplace_back(x[i], y[i], z[i]);
  return out;
}

/// As for bodies (hand_made_bodies.hpp): central differences of the energy.
inline void expect_minus_gradient(const ForceLaw& law, HandMadeParticles particles, double size) {
  constexpr double kStep = 1e-5;
  const std::vector<Vector3> forces = forces_of(law, particles);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    Vector3 force;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      particles.displace(i, axis, kStep);
      const double ahead = law.particle_energy(particles.at());
      particles.displace(i, axis, -2 * kStep);
      const double behind = law.particle_energy(particles.at());
      particles.displace(i, axis, kStep);
      force[static_cast<Eigen::Index>(axis)] = -(ahead - behind) / (2 * kStep);
    }
    EXPECT_TRUE(near(forces[i], force, 1e-8, size)) << "particle " << i;
  }
}

}  // namespace pantin::test
