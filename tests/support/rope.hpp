#pragma once
// Particles tied in a row.
#include <vector>

#include <pantin/physics/particles/ties.hpp>
#include <pantin/physics/physics_manager.hpp>

namespace pantin::test {

/// Particles in a row, tied one to the next.
struct Rope {
  Rope(int count, const Vector3& from, const Vector3& step, double mass = 0.01, int substeps = 4) {
    system = physics.particles().add(
        ParticleSystemSettings{.name = "rope", .mass = mass, .capacity = 2000, .substeps = substeps});
    for (int i = 0; i < count; ++i)
      ids.push_back(physics.particles().add_particle(system, {.p_WP = from + i * step}));
    for (std::size_t i = 1; i < ids.size(); ++i) {
      ties.push_back(physics.particles().add(DistanceTie{.a = ids[i - 1], .b = ids[i]}));
    }
  }
  void pin(std::size_t i) { physics.particles().pin(ids[i], {{}, p(i)}); }
  Vector3 p(std::size_t i) const { return physics.particles().system(system).p_WP(i); }
  Vector3 v(std::size_t i) const { return physics.particles().system(system).v_WP(i); }
  PhysicsManager physics{};
  ParticleSystemId system{};
  std::vector<ParticleId> ids{};
  std::vector<ParticleConstraintId> ties{};
};

}  // namespace pantin::test
