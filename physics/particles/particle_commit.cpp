// The end of an update: what arrived becomes the state, births get their serials, the dead leave.
#include <algorithm>
#include <cmath>
#include <limits>

#include <pantin/physics/particles/particle_world.hpp>

namespace pantin {

void ParticleManager::Impl::commit(std::size_t k, double t_end) {
  SystemData& data = systems[k];
  ParticleSystemState& now = state(k);
  const std::size_t old = now.size();
  std::swap(now.now, data.next);
  std::swap(now.emitters, data.emitters_next);
  for (const DueBirth& birth : data.due) {
    const std::size_t i = old + static_cast<std::size_t>(&birth - data.due.data());
    if (!now.mass.empty()) now.mass.push_back(data.settings.mass);
    if (!now.death.empty() || std::isfinite(birth.death)) {
      now.death.resize(i, std::numeric_limits<double>::infinity());
      now.death.push_back(birth.death);
    }
    if (!now.serial.empty() || now.next_serial != i) now.serial.push_back(now.next_serial);
    ++now.next_serial;
  }
  if (!data.due.empty()) ++now.population;
  for (const NewlyStuck& stuck : data.newly_stuck) {
    const StuckParticle entry{now.serial_of(stuck.position), stuck.deflector, stuck.p_DP};
    now.stuck.insert(
        std::upper_bound(now.stuck.begin(), now.stuck.end(), entry.serial,
                         [](std::uint64_t serial, const StuckParticle& s) { return serial < s.serial; }),
        entry);
  }
  std::erase_if(now.stuck,
                [&](const StuckParticle& stuck) { return deflectors.find(stuck.deflector) == nullptr; });
  remove_dead(k, t_end);
}

void ParticleManager::Impl::remove_dead(std::size_t k, double t_end) {
  ParticleSystemState& now = state(k);
  const auto dies = [t_end](double death) { return death <= t_end; };
  const auto first = std::find_if(now.death.begin(), now.death.end(), dies);
  if (first == now.death.end()) return;
  if (now.serial.empty()) {
    now.serial.reserve(systems[k].settings.capacity);
    for (std::size_t i = 0; i < now.size(); ++i) now.serial.push_back(i);
  }
  std::erase_if(now.stuck,
                [&](const StuckParticle& s) { return dies(now.death[now.position_of(s.serial)]); });
  std::size_t to = static_cast<std::size_t>(first - now.death.begin());
  const std::size_t n = now.size();
  ParticleArrays& a = now.now;
  for (std::size_t i = to; i < n; ++i) {
    if (dies(now.death[i])) continue;
    for (std::vector<double>* v : {&a.x, &a.y, &a.z, &a.vx, &a.vy, &a.vz, &now.death}) (*v)[to] = (*v)[i];
    if (!now.mass.empty()) now.mass[to] = now.mass[i];
    now.serial[to] = now.serial[i];
    ++to;
  }
  report.died += n - to;
  a.resize(to);
  now.death.resize(to);
  now.serial.resize(to);
  if (!now.mass.empty()) now.mass.resize(to);
  ++now.population;
}

}  // namespace pantin
