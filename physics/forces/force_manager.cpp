#include <pantin/physics/forces/force_manager.hpp>

#include <algorithm>
#include <string>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/forces/wrench_derivatives.hpp>

namespace pantin {
namespace {

std::string dead_force(ForceId id) {
  return "force " + std::to_string(id.index) + " is null or was removed; keep the id that add returned";
}

}  // namespace

void ForceManager::check(const std::optional<SettingsProblem>& problem) {
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
}

ForceId ForceManager::add_law(std::unique_ptr<ForceLaw> law) {
  PANTIN_EXPECTS(law, "the law is null; give an object");
  const ForceId id{.index = next_++, .generation = 1};
  all_.push_back(law.get());
  laws_.push_back({id, std::move(law)});
  ++revision_;
  return id;
}

// Ids count upwards and are never used twice, so the list is sorted by them.
std::size_t ForceManager::position_of(ForceId id) const noexcept {
  const auto found = std::lower_bound(laws_.begin(), laws_.end(), id,
                                      [](const Entry& entry, ForceId wanted) { return entry.id < wanted; });
  return found != laws_.end() && found->id == id ? static_cast<std::size_t>(found - laws_.begin()) : size();
}

void ForceManager::remove(ForceId id) {
  const std::size_t position = position_of(id);
  PANTIN_EXPECTS(position < size(), dead_force(id));
  laws_.erase(laws_.begin() + static_cast<std::ptrdiff_t>(position));
  list_anew();
}

void ForceManager::list_anew() {
  all_.clear();
  for (const Entry& entry : laws_) all_.push_back(entry.law.get());
  ++revision_;
}

std::size_t ForceManager::remove_laws_of(BodyId body) {
  PANTIN_EXPECTS(body, "the body is null; give the body whose laws are to go");
  const std::size_t removed =
      std::erase_if(laws_, [body](const Entry& entry) { return entry.law->names(body); });
  if (removed > 0) list_anew();
  return removed;
}

bool ForceManager::contains(ForceId id) const noexcept { return position_of(id) < size(); }

void LawList::gather(const BodiesAt& at, std::span<Wrench> wrenches) const {
  PANTIN_EXPECTS(wrenches.size() == at.size(), std::to_string(wrenches.size()) + " wrenches for " +
                                                   std::to_string(at.size()) + " bodies; give one a body");
  for (const ForceLaw* law : laws_) law->add_wrenches(at, wrenches);
}

bool LawList::gather_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const {
  return std::all_of(laws_.begin(), laws_.end(), [&](const ForceLaw* law) {
    return law->add_derivatives(at, derivatives) || derivatives.add_differences(*law, at);
  });
}

double ForceManager::potential_energy(const BodiesAt& at) const {
  double sum = 0;
  for (const Entry& entry : laws_) sum += entry.law->potential_energy(at);
  return sum;
}

std::optional<Vector3> LawList::uniform_acceleration() const {
  Vector3 sum = Vector3::Zero();
  for (const ForceLaw* law : laws_) {
    const std::optional<Vector3> one = law->uniform_acceleration();
    if (!one) return {};
    sum += *one;
  }
  return sum;
}

bool LawList::depends_on_velocity() const {
  return std::any_of(laws_.begin(), laws_.end(),
                     [](const ForceLaw* law) { return law->depends_on_velocity(); });
}

ParticleAction ForceManager::action_on(ParticleSystemId system) const {
  ParticleAction strongest = ParticleAction::None;
  for (const Entry& entry : laws_) strongest = std::max(strongest, entry.law->acts_on(system));
  return strongest;
}

void ForceManager::gather(const ParticlesAt& at, const ParticleForces& forces) const {
  for (const Entry& entry : laws_) {
    if (entry.law->acts_on(at.system) == ParticleAction::Each) entry.law->add_particle_forces(at, forces);
  }
}

double ForceManager::particle_energy(const ParticlesAt& at) const {
  double sum = 0;
  for (const Entry& entry : laws_) {
    if (entry.law->acts_on(at.system) == ParticleAction::Each) sum += entry.law->particle_energy(at);
  }
  return sum;
}

void ForceManager::gather(const BodiesAt& bodies, std::span<Wrench> wrenches,
                          std::span<const CoupledParticles> systems) const {
  for (const Entry& entry : laws_) entry.law->add_coupled_forces(bodies, wrenches, systems);
}

double ForceManager::coupled_energy(const BodiesAt& bodies, std::span<const CoupledParticles> systems) const {
  double sum = 0;
  for (const Entry& entry : laws_) sum += entry.law->coupled_energy(bodies, systems);
  return sum;
}

}  // namespace pantin
