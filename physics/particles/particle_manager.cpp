#include <pantin/physics/particles/particle_manager.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/particles/particle_world.hpp>

namespace pantin {

namespace {

void check(const std::optional<SettingsProblem>& problem) {
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
}

std::string text_of(ParticleSystemId id) { return "particle system " + std::to_string(id.index); }

void erase_at(std::vector<double>& v, std::size_t i) {
  if (!v.empty()) v.erase(v.begin() + static_cast<std::ptrdiff_t>(i));
}

}  // namespace

ParticleManager::ParticleManager(BodyStore& bodies, ForceManager& forces, DeflectorManager& deflectors)
    : impl_{std::make_unique<Impl>(bodies, forces, deflectors)} {}
ParticleManager::~ParticleManager() = default;

// Systems

std::size_t ParticleManager::at(ParticleSystemId id) const {
  const std::vector<ParticleSystemState>& states = impl_->bodies.state.particles;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (id && states[k].id == id) return k;
  }
  PANTIN_EXPECTS(false, text_of(id) + " is null or was removed; keep the id that add returned");
  return 0;
}

bool ParticleManager::contains(ParticleSystemId id) const noexcept {
  const std::vector<ParticleSystemState>& states = impl_->bodies.state.particles;
  return id && std::any_of(states.begin(), states.end(), [id](const auto& state) { return state.id == id; });
}

std::size_t ParticleManager::size() const noexcept { return impl_->systems.size(); }

std::vector<ParticleSystemId> ParticleManager::ids() const {
  std::vector<ParticleSystemId> out;
  for (const ParticleSystemState& state : impl_->bodies.state.particles) out.push_back(state.id);
  return out;
}

ParticleSystem ParticleManager::system(ParticleSystemId id) const {
  const std::size_t k = at(id);
  return {impl_->state(k), impl_->systems[k].settings};
}

ParticleSystemId ParticleManager::add(const ParticleSystemSettings& settings) {
  check(problem_with(settings));
  const ParticleSystemId id{.index = impl_->next_system++, .generation = 1};
  SystemData data;
  data.settings = settings;
  data.next.reserve(settings.capacity);
  impl_->systems.push_back(std::move(data));
  ParticleSystemState state;
  state.id = id;
  state.now.reserve(settings.capacity);
  impl_->bodies.state.particles.push_back(std::move(state));
  return id;
}

void ParticleManager::remove(ParticleSystemId id) {
  const auto k = static_cast<std::ptrdiff_t>(at(id));
  impl_->systems.erase(impl_->systems.begin() + k);
  impl_->bodies.state.particles.erase(impl_->bodies.state.particles.begin() + k);
}

// Particles

std::size_t ParticleManager::position(ParticleId id, std::size_t& system) const {
  system = at(id.system);
  const ParticleSystemState& state = impl_->state(system);
  const std::size_t i = state.position_of(id.serial);
  PANTIN_EXPECTS(i < state.size(), "particle " + std::to_string(id.serial) + " of " + text_of(id.system) +
                                       " is not there (any more); ask system(id).contains(particle) first");
  return i;
}

Vector3 ParticleManager::place(ParticleId id) const {
  std::size_t k = 0;
  const std::size_t i = position(id, k);
  return impl_->state(k).now.position(i);
}

ParticleId ParticleManager::add_particle(ParticleSystemId system, const ParticleSettings& particle) {
  check(problem_with(particle));
  const std::size_t k = at(system);
  ParticleSystemState& state = impl_->state(k);
  const ParticleSystemSettings& settings = impl_->systems[k].settings;
  PANTIN_EXPECTS(state.size() < settings.capacity, "particle system '" + settings.name +
                                                       "' is full: " + std::to_string(settings.capacity) +
                                                       " particles; give it a greater capacity");
  const std::size_t i = state.size();
  const double mass = particle.mass > 0 ? particle.mass : settings.mass;
  const double death = impl_->bodies.state.time + particle.lifetime;
  if (!state.mass.empty() || mass != settings.mass)
    state.mass.resize(i, settings.mass), state.mass.push_back(mass);
  if (!state.death.empty() || std::isfinite(death)) {
    state.death.resize(i, std::numeric_limits<double>::infinity());
    state.death.push_back(death);
  }
  if (!state.serial.empty()) state.serial.push_back(state.next_serial);
  if (state.serial.empty() && state.next_serial != i) state.serial.assign(1, state.next_serial);
  state.now.resize(i + 1);
  state.now.set(i, particle.p_WP, particle.v_WP);
  ++state.population;
  return {system, state.next_serial++};
}

void ParticleManager::remove(ParticleId id) {
  std::size_t k = 0;
  const std::size_t i = position(id, k);
  ParticleSystemState& state = impl_->state(k);
  if (state.serial.empty()) {
    for (std::size_t j = 0; j < state.size(); ++j) state.serial.push_back(j);
  }
  state.serial.erase(state.serial.begin() + static_cast<std::ptrdiff_t>(i));
  ParticleArrays& now = state.now;
  for (std::vector<double>* a :
       {&now.x, &now.y, &now.z, &now.vx, &now.vy, &now.vz, &state.mass, &state.death}) {
    erase_at(*a, i);
  }
  std::erase_if(state.stuck, [&](const StuckParticle& stuck) { return stuck.serial == id.serial; });
  ++state.population;
}

void ParticleManager::set_position(ParticleId id, const Vector3& p_WP) {
  PANTIN_EXPECTS(p_WP.allFinite(), "the position of a particle is not finite");
  std::size_t k = 0;
  const std::size_t i = position(id, k);
  impl_->state(k).now.set(i, p_WP, impl_->state(k).now.velocity(i));
}

void ParticleManager::set_velocity(ParticleId id, const Vector3& v_WP) {
  PANTIN_EXPECTS(v_WP.allFinite(), "the velocity of a particle is not finite");
  std::size_t k = 0;
  const std::size_t i = position(id, k);
  impl_->state(k).now.set(i, impl_->state(k).now.position(i), v_WP);
}

void ParticleManager::unstick(ParticleId id) {
  std::size_t k = 0;
  static_cast<void>(position(id, k));
  std::erase_if(impl_->state(k).stuck, [&](const StuckParticle& stuck) { return stuck.serial == id.serial; });
}

// Emitters

EmitterId ParticleManager::add_emitter(ParticleSystemId system, EmitterSettings settings) {
  check(problem_with(settings));
  const std::size_t k = at(system);
  if (settings.body) static_cast<void>(impl_->bodies.at(settings.body));
  const EmitterId id{.index = impl_->next_emitter++, .generation = 1};
  // What would have been born before now is not.
  EmitterState state{.id = id};
  const double now = impl_->bodies.state.time;
  const double since = std::min(now, settings.stop) - settings.start;
  if (since > 0) state.emitted = static_cast<std::uint64_t>(std::min(std::ceil(since * settings.rate), 1e18));
  while (state.burst < settings.bursts.size() && settings.bursts[state.burst].time < now) ++state.burst;
  impl_->systems[k].emitters.push_back({id, std::move(settings)});
  impl_->state(k).emitters.push_back(state);
  return id;
}

void ParticleManager::remove(EmitterId id) {
  for (std::size_t k = 0; k < size(); ++k) {
    std::vector<Emitter>& emitters = impl_->systems[k].emitters;
    const auto found = std::find_if(emitters.begin(), emitters.end(),
                                    [id](const Emitter& emitter) { return emitter.id == id; });
    if (found == emitters.end()) continue;
    impl_->state(k).emitters.erase(impl_->state(k).emitters.begin() + (found - emitters.begin()));
    emitters.erase(found);
    return;
  }
  PANTIN_EXPECTS(false, "emitter " + std::to_string(id.index) +
                            " is null or was removed; keep the id that add returned");
}

// Ties and pins

ParticleConstraintId ParticleManager::add_tie(ParticleSystemId system, Tie tie) {
  SystemData& data = impl_->systems[at(system)];
  bool finite = std::isfinite(tie.compliance) && std::isfinite(tie.scale);
  for (const double c : tie.c) finite = finite && std::isfinite(c);
  PANTIN_EXPECTS(finite,
                 "particles of a tie stand at one place, or in one line where they make a triangle; "
                 "place them before they are tied");
  tie.id = {.index = impl_->next_tie++, .generation = 1};
  data.ties.push_back(tie);
  data.rows_are_stale = true;
  return tie.id;
}

ParticleConstraintId ParticleManager::add(const DistanceTie& settings) {
  check(problem_with(settings));
  return add_tie(settings.a.system, tie_of(settings, place(settings.a), place(settings.b)));
}

ParticleConstraintId ParticleManager::add(const BendTie& settings) {
  check(problem_with(settings));
  return add_tie(settings.a.system,
                 tie_of(settings, place(settings.a), place(settings.b), place(settings.c)));
}

ParticleConstraintId ParticleManager::add(const HingeTie& settings) {
  check(problem_with(settings));
  return add_tie(settings.a.system, tie_of(settings, place(settings.a), place(settings.b), place(settings.c),
                                           place(settings.d)));
}

void ParticleManager::remove(ParticleConstraintId id) {
  for (SystemData& data : impl_->systems) {
    if (std::erase_if(data.ties, [id](const Tie& tie) { return tie.id == id; }) == 0) continue;
    data.rows_are_stale = true;
    return;
  }
  PANTIN_EXPECTS(
      false, "tie " + std::to_string(id.index) + " is null or was removed; keep the id that add returned");
}

void ParticleManager::pin(ParticleId id, const Attachment& to) {
  PANTIN_EXPECTS(to.p_BQ.allFinite(), "the point that a particle is pinned to is not finite");
  if (to.body) static_cast<void>(impl_->bodies.at(to.body));
  std::size_t k = 0;
  static_cast<void>(position(id, k));
  unpin(id);
  std::vector<Pin>& pins = impl_->systems[k].pins;
  pins.insert(std::upper_bound(pins.begin(), pins.end(), id.serial,
                               [](std::uint64_t serial, const Pin& pin) { return serial < pin.serial; }),
              {id.serial, to});
  impl_->systems[k].rows_are_stale = true;
}

void ParticleManager::unpin(ParticleId id) {
  SystemData& data = impl_->systems[at(id.system)];
  if (std::erase_if(data.pins, [&](const Pin& pin) { return pin.serial == id.serial; }) > 0) {
    data.rows_are_stale = true;
  }
}

void ParticleManager::remove_all_of(BodyId body) {
  for (SystemData& data : impl_->systems) {
    if (std::erase_if(data.pins, [body](const Pin& pin) { return pin.to.body == body; }) > 0) {
      data.rows_are_stale = true;
    }
  }
  std::vector<EmitterId> gone;
  for (const SystemData& data : impl_->systems) {
    for (const Emitter& emitter : data.emitters) {
      if (emitter.settings.body == body) gone.push_back(emitter.id);
    }
  }
  for (const EmitterId id : gone) remove(id);
}

bool ParticleManager::fits(std::span<const ParticleSystemState> states) const {
  const auto same_emitter = [](const EmitterState& a, const EmitterState& b) { return a.id == b.id; };
  return std::equal(states.begin(), states.end(), impl_->bodies.state.particles.begin(),
                    impl_->bodies.state.particles.end(),
                    [&](const ParticleSystemState& a, const ParticleSystemState& b) {
                      return a.id == b.id && std::equal(a.emitters.begin(), a.emitters.end(),
                                                        b.emitters.begin(), b.emitters.end(), same_emitter);
                    });
}

void ParticleManager::reserve_again() {
  for (std::size_t k = 0; k < size(); ++k) {
    impl_->state(k).now.reserve(impl_->systems[k].settings.capacity);
    impl_->systems[k].rows_are_stale = true;
  }
}

}  // namespace pantin
