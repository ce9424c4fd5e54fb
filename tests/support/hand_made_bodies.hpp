#pragma once
// A few bodies in any state, as force laws see them, without a PhysicsManager. Ids deliberately differ from
// positions.
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <support/near.hpp>

#include <pantin/physics/bodies_at.hpp>
#include <pantin/physics/forces/force_law.hpp>

namespace pantin::test {

class HandMadeBodies {
 public:
  BodyId add(const MassProperties& mass, const BodyKinematics& kinematics,
             BodyKind kind = BodyKind::Simulated) {
    masses.push_back(mass);
    bodies.push_back(kinematics);
    kinds.push_back(kind);
    constexpr std::uint32_t kFirst = 5;
    positions_.resize(kFirst + 2 * bodies.size(), 0xffffffffU);
    const std::uint32_t position = static_cast<std::uint32_t>(bodies.size() - 1);
    const BodyId id{.index = kFirst + 2 * position, .generation = 3};
    positions_[id.index] = position;
    return id;
  }
  BodyId add_random(std::mt19937_64& random, BodyKind kind = BodyKind::Simulated) {
    const MassProperties mass = random_mass(random);
    BodyKinematics k;
    k.p_WBcm = random_vector(random, 3);
    k.R_WB = random_rotation(random).toRotationMatrix();
    k.v_WBcm = random_vector(random, 2);
    k.w_WB = random_vector(random, 2);
    return add(mass, k, kind);
  }
  [[nodiscard]] BodiesAt at(double t = 0) const {
    return {t, Side::After, bodies, masses, kinds, positions_};
  }

  std::vector<BodyKinematics> bodies{};
  std::vector<MassProperties> masses{};
  std::vector<BodyKind> kinds{};

 private:
  std::vector<std::uint32_t> positions_{};
};

/// The wrenches of one law alone.
inline std::vector<Wrench> wrenches_of(const ForceLaw& law, const HandMadeBodies& bodies) {
  std::vector<Wrench> wrenches(bodies.bodies.size());
  law.add_wrenches(bodies.at(), wrenches);
  return wrenches;
}

/// Force and torque are minus the derivatives of the potential along displacements and small rotations of
/// each simulated body: central differences, whose error is of the order of (step^2 + epsilon / step) * size.
inline void expect_minus_gradient(const ForceLaw& law, HandMadeBodies bodies, double size) {
  constexpr double kStep = 1e-5;
  const std::vector<Wrench> wrenches = wrenches_of(law, bodies);
  for (std::size_t i = 0; i < bodies.bodies.size(); ++i) {
    if (bodies.kinds[i] != BodyKind::Simulated) continue;
    const BodyKinematics start = bodies.bodies[i];
    const auto difference = [&](const auto& displace) {
      displace(bodies.bodies[i], kStep);
      const double ahead = law.potential_energy(bodies.at());
      bodies.bodies[i] = start;
      displace(bodies.bodies[i], -kStep);
      const double behind = law.potential_energy(bodies.at());
      bodies.bodies[i] = start;
      return (ahead - behind) / (2 * kStep);
    };
    Vector3 force, torque;
    for (int k = 0; k < 3; ++k) {
      force[k] = -difference([k](BodyKinematics& body, double step) { body.p_WBcm[k] += step; });
      torque[k] = -difference([k](BodyKinematics& body, double step) {
        body.R_WB = Eigen::AngleAxisd{step, Vector3::Unit(k)} * body.R_WB;
      });
    }
    EXPECT_TRUE(near(wrenches[i].force, force, 1e-8, size)) << "body " << i;
    EXPECT_TRUE(near(wrenches[i].torque, torque, 1e-8, size)) << "body " << i;
  }
}

}  // namespace pantin::test
