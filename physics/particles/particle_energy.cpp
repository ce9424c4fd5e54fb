// Energies of particles at the state reached, on demand; a step sums them up on its way.
#include <algorithm>

#include <pantin/physics/particles/particle_world.hpp>

namespace pantin {

/// Of laws that couple, with the bodies they tie particles to.
double ParticleManager::Impl::coupled_energy() {
  bool any = false;
  for (std::size_t k = 0; k < systems.size(); ++k) {
    any = any || forces.action_on(state(k).id) == ParticleAction::Coupled;
  }
  if (!any) return 0;
  views.clear();
  std::size_t count = 0;
  for (std::size_t k = 0; k < systems.size(); ++k) count += state(k).size();
  masses.resize(count);
  std::span<double> left{masses};
  for (std::size_t k = 0; k < systems.size(); ++k) {
    const ParticleSystemState& now = state(k);
    const std::span<double> mass = left.first(now.size());
    left = left.subspan(now.size());
    if (now.mass.empty()) {
      std::fill(mass.begin(), mass.end(), systems[k].settings.mass);
    } else {
      std::copy(now.mass.begin(), now.mass.end(), mass.begin());
    }
    views.push_back({{.t = bodies.state.time,
                      .system = now.id,
                      .x = now.now.x,
                      .y = now.now.y,
                      .z = now.now.z,
                      .vx = now.now.vx,
                      .vy = now.now.vy,
                      .vz = now.now.vz,
                      .mass = mass},
                     {},
                     now.serial});
  }
  return forces.coupled_energy(bodies.now(), views);
}

Energy ParticleManager::energy() const {
  Impl& world = *impl_;
  Energy sum;
  for (std::size_t k = 0; k < world.systems.size(); ++k) {
    const ParticleSystemState& now = world.state(k);
    SystemData& data = world.systems[k];
    for (std::size_t i = 0; i < now.size(); i += ParticleBlock::kMost) {
      const std::size_t n = std::min(ParticleBlock::kMost, now.size() - i);
      world.block.load(now.id, now.now, i, n, now.mass, data.settings.mass);
      world.block.arrive(now.now, i);
      const Energy part = world.block.energy(world.bodies.state.time);
      sum.kinetic += part.kinetic;
      sum.potential += part.potential;
    }
    if (!data.is_tied()) continue;
    world.prepare_ties(k);
    for (std::size_t i = 0; i < now.size(); ++i) data.q1[i] = now.now.position(i);
    sum.potential += data.tied.energy(data.q1);
  }
  sum.potential += world.coupled_energy();
  return sum;
}

}  // namespace pantin
