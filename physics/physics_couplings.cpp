// Couplings of joints, as users see them.
#include <pantin/physics/expects.hpp>
#include <pantin/physics/world.hpp>

namespace pantin {

CouplingId PhysicsManager::add(GearSettings settings) {
  const std::optional<SettingsProblem> alone = problem_with(settings);
  PANTIN_EXPECTS(!alone, alone->text + "; " + alone->remedy);
  const std::optional<SettingsProblem> problem = problem_with(settings, joint(settings.a), joint(settings.b));
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
  impl_->constraints.stale(impl_->bodies);
  return impl_->constraints.add(impl_->bodies, std::move(settings));
}

void PhysicsManager::remove(CouplingId id) {
  impl_->constraints.stale(impl_->bodies);
  impl_->constraints.remove(id);
}

bool PhysicsManager::contains(CouplingId id) const noexcept {
  return impl_->constraints.couplings().contains(id);
}

const std::vector<CouplingId>& PhysicsManager::couplings() const noexcept {
  return impl_->constraints.couplings().ids();
}

const GearSettings& PhysicsManager::coupling(CouplingId id) const {
  const Couplings& couplings = impl_->constraints.couplings();
  return couplings[couplings.at(id)];
}

double PhysicsManager::coupling_effort(CouplingId id) const {
  ConstraintManager& constraints = impl_->constraints;
  const std::size_t position = constraints.couplings().at(id);
  constraints.prepare(impl_->bodies);
  const std::int32_t closure = constraints.layout().closure_of_coupling[position];
  if (closure < 0) return 0;
  std::vector<Wrench> external;
  std::vector<Vector3> alpha, a_cm;
  impl_->dynamics.accelerations_now(external, alpha, a_cm);
  return constraints.loops().solver().effort(static_cast<std::uint32_t>(closure));
}

}  // namespace pantin
