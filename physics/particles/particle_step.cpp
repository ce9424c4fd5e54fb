// Particles in an update, after the bodies have moved. A system goes one of three ways:
//   tied     in substeps of its own (tied_step.cpp)
//   coupled  by laws with bodies or among its particles: integrated together with the bodies; it has arrived
//   already else     in batches that stay in the cache, by an integrator of the particles
// and is then swept past the deflectors. Everything goes to `next`, and becomes the state when all systems
// arrived.
#include <algorithm>

#include <pantin/physics/particles/particle_world.hpp>

namespace pantin {

void ParticleManager::set_integrator(std::unique_ptr<Integrator> integrator) {
  impl_->integrator = std::move(integrator);
  impl_->integrator_is_given = impl_->integrator != nullptr;
  ++impl_->integrator_revision;
}

Integrator* ParticleManager::own_integrator() noexcept {
  return impl_->integrator_is_given ? impl_->integrator.get() : nullptr;
}

std::uint64_t ParticleManager::integrator_revision() const noexcept { return impl_->integrator_revision; }

void ParticleManager::integrator_of_bodies_changed() {
  if (!impl_->integrator_is_given) impl_->integrator.reset();
}

ParticleId ParticleManager::not_finite() const noexcept { return impl_->not_finite; }

void ParticleManager::begin_step() {
  impl_->report = {};
  impl_->not_finite = {};
  impl_->deflectors.forget_hits();
  impl_->sweep.counts = {};
}

Dynamics* ParticleManager::begin_update(WorldDynamics& bodies) {
  Impl& world = *impl_;
  if (world.systems.empty()) return nullptr;
  world.before = world.bodies.state.kinematics;
  world.deflectors.begin();
  const bool any = world.coupled.begin(
      bodies, [&](std::size_t k) { return !world.systems[k].is_tied(); },
      [&](std::size_t k) { return world.systems[k].settings.mass; });
  return any ? &world.coupled : nullptr;
}

std::span<double> ParticleManager::coordinates_now() { return impl_->coupled.coordinates_now(); }
std::span<double> ParticleManager::velocities_now() { return impl_->coupled.velocities_now(); }
void ParticleManager::bodies_have_moved() { impl_->coupled.end(); }

bool ParticleManager::update(double t, double h, const Integrator& integrator_of_bodies) {
  Impl& world = *impl_;
  if (world.systems.empty()) return true;
  if (world.integrator == nullptr) world.integrator = integrator_of_bodies.another();
  world.deflectors.end(h);
  for (std::size_t k = 0; k < world.systems.size(); ++k) {
    if (!world.advance(k, t, h)) return false;
  }
  for (std::size_t k = 0; k < world.systems.size(); ++k) world.commit(k, t + h);
  return true;
}

const ParticleReport& ParticleManager::finish_step() {
  Impl& world = *impl_;
  ParticleReport& report = world.report;
  const SweepCounts& counts = world.sweep.counts;
  report.deflections = counts.deflections;
  report.pushed_out = counts.pushed_out;
  report.unresolved = counts.unresolved;
  report.stuck = counts.stuck;
  for (std::size_t k = 0; k < world.systems.size(); ++k) {
    report.count += world.state(k).size();
    report.energy.kinetic += world.systems[k].energy.kinetic;
    report.energy.potential += world.systems[k].energy.potential;
  }
  report.energy.potential += world.coupled_energy();
  return report;
}

bool ParticleManager::Impl::advance(std::size_t k, double t, double h) {
  SystemData& data = systems[k];
  ParticleSystemState& now = state(k);
  data.next.resize(now.size());
  data.newly_stuck.clear();
  data.energy = {};
  plan_births(k, t, h);
  list_skipped(k);
  if (data.is_tied()) {
    if (!advance_tied(k, t, h)) return false;
  } else {
    if (coupled.has(k)) coupled.read(k, data.next);
    for (std::size_t i = 0; i < now.size(); i += ParticleBlock::kMost) {
      if (!move_batch(k, i, std::min(ParticleBlock::kMost, now.size() - i), t, h, 0)) return false;
    }
  }
  // Births at one time go together.
  for (std::size_t b = 0; b < data.due.size();) {
    std::size_t e = b + 1;
    while (e < data.due.size() && e - b < ParticleBlock::kMost && data.due[e].time == data.due[b].time) ++e;
    const double s0 = std::min((data.due[b].time - t) / h, 1.0);
    if (!move_batch(k, now.size() + b, e - b, t, h, s0)) return false;
    b = e;
  }
  carry_stuck(k);
  return true;
}

/// Moves particles [first, first + n) from fraction s0 of the update to its end. Those before the state's end
/// come from there, or have been brought to `next` by the coupled equations; those born come from `next`.
bool ParticleManager::Impl::move_batch(std::size_t k, std::size_t first, std::size_t n, double t, double h,
                                       double s0) {
  SystemData& data = systems[k];
  const ParticleSystemState& now = state(k);
  const bool is_born = first >= now.size();
  const std::span<const double> own_masses =
      is_born ? std::span<const double>{} : std::span<const double>{now.mass};
  block.load(now.id, is_born ? data.next : now.now, first, n, own_masses, data.settings.mass);
  const double left = (1 - s0) * h;
  if (!is_born && coupled.has(k)) {
    block.arrive(data.next, first);
  } else if (left > 0) {
    block.evaluations = 0;
    block.integrate(*integrator, t + s0 * h, left);
    report.evaluations += block.evaluations;
    if (const StepControl* control = integrator->control()) report.inner_steps += control->accepted;
  } else {
    return true;
  }
  if (const std::size_t bad = block.first_not_finite(); bad < n) {
    not_finite = {now.id,
                  is_born ? now.next_serial + (first - now.size()) + bad : now.serial_of(first + bad)};
    return false;
  }
  const auto from = std::lower_bound(data.skip.begin(), data.skip.end(), first);
  const auto to = std::lower_bound(from, data.skip.end(), first + n);
  skip_in_batch.clear();
  for (auto i = from; i != to; ++i) skip_in_batch.push_back(*i - first);
  if (deflectors.size() > 0) {
    block.sweep(sweep, s0, h, data.settings.radius, skip_in_batch,
                [&](std::size_t i, const Deflector& on, const MovingParticle& particle) {
                  const Vector3 p_DP = on.motion.to_local(particle.path.p, particle.path.s0);
                  data.newly_stuck.push_back(
                      {first + i, on.id, p_DP, particle.path.at(1), particle.path.velocity(1)});
                });
  }
  block.store(data.next, first);
  const Energy energy = block.energy(t + h);
  data.energy.kinetic += energy.kinetic;
  data.energy.potential += energy.potential;
  return true;
}

void ParticleManager::Impl::list_skipped(std::size_t k) {
  SystemData& data = systems[k];
  ParticleSystemState& now = state(k);
  data.skip.clear();
  for (const StuckParticle& stuck : now.stuck) {
    const std::size_t i = now.position_of(stuck.serial);
    if (i < now.size() && deflectors.find(stuck.deflector) != nullptr) data.skip.push_back(i);
  }
}

/// Puts particles that stick where their deflector is; what it takes to keep them there is taken from its
/// body.
void ParticleManager::Impl::carry_stuck(std::size_t k) {
  SystemData& data = systems[k];
  const ParticleSystemState& now = state(k);
  const auto carry = [&](std::size_t i, const Deflector& on, const Vector3& p_DP, const Vector3& p_free,
                         const Vector3& v_free) {
    const Vector3 p = on.motion.to_world(p_DP, 1);
    Vector3 v = on.motion.velocity(p, 1);
    if (const StruckBody* body = deflectors.struck(on))
      v += body->dv + body->dw.cross(p - on.motion.centre(1));
    const bool weighed = i < now.size() && !now.mass.empty();
    const double mass = weighed ? now.mass[i] : data.settings.mass;
    data.energy.kinetic += 0.5 * mass * (v.squaredNorm() - data.next.velocity(i).squaredNorm());
    deflectors.react(on, mass * (v - v_free), mass * (p.cross(v) - p_free.cross(v_free)));
    data.next.set(i, p, v);
  };
  for (const StuckParticle& stuck : now.stuck) {
    const std::size_t i = now.position_of(stuck.serial);
    const Deflector* on = deflectors.find(stuck.deflector);
    if (i < now.size() && on != nullptr)
      carry(i, *on, stuck.p_DP, data.next.position(i), data.next.velocity(i));
  }
  for (const NewlyStuck& stuck : data.newly_stuck) {
    const Deflector* on = deflectors.find(stuck.deflector);
    if (on != nullptr) carry(stuck.position, *on, stuck.p_DP, stuck.p_free, stuck.v_free);
  }
}

}  // namespace pantin
