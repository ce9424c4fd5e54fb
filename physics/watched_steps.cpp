// Steps that are watched: cut, or taken implicitly, where the chosen integrator would not bear them.
#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/world.hpp>

namespace pantin {
namespace {

/// What would take more parts is taken by the implicit midpoint rule.
constexpr int kMostParts = 32;

}  // namespace

void PhysicsManager::Impl::integrate(std::size_t g, Dynamics& system, double h, std::span<double> q,
                                     std::span<double> v) {
  StepGroup& group = groups[g];
  const double t = bodies.state.time;
  const int parts = watched_parts(g, system, h, q, v);
  if (parts == 1) return integrate_part(group, *group.integrator, system, t, h, q, v);
  note_fast_motion(g, system, parts);
  if (parts > kMostParts) {
    if (implicit == nullptr) implicit = make_integrator("implicit-midpoint");
    return integrate_part(group, *implicit, system, t, h, q, v);
  }
  for (int i = 0; i < parts; ++i) {
    const double from = i * h / parts, to = (i + 1) * h / parts;
    integrate_part(group, *group.integrator, system, t + from, to - from, q, v);
  }
}

int PhysicsManager::Impl::watched_parts(std::size_t g, Dynamics& system, double h, std::span<const double> q,
                                        std::span<const double> v) {
  StepGroup& group = groups[g];
  const double radius = group.integrator->stability_radius();
  if (!watches_stability || std::isinf(radius)) return 1;
  StabilityMemory& memory = bodies.state.stabilities[g];
  const std::uint64_t scene = bodies.state.topology + forces.revision();
  if (memory.scene != scene) memory = {.scene = scene};
  const int asked = group.dynamics->evaluations;  // what watching costs is not the motion's
  const double rate = watch.fastest_rate(system, {bodies.state.time, Side::After}, q, v, radius / h, memory);
  group.dynamics->evaluations = asked;
  return parts_for(rate, h, *group.integrator);
}

void PhysicsManager::Impl::note_fast_motion(std::size_t g, Dynamics& system, int parts) {
  const StabilityMemory& memory = bodies.state.stabilities[g];
  if (memory.rate < fast.rate) return;
  const bool implicitly = parts > kMostParts;
  fast = {.rate = memory.rate, .parts = implicitly ? 1 : parts, .implicitly = implicitly};
  const std::size_t velocity = watch.fastest_velocity(system, memory);
  const WorldDynamics::Mover mover = groups[g].dynamics->mover_of(velocity);
  if (mover.body >= 0) fast.body = bodies.ids[static_cast<std::size_t>(mover.body)];
  if (mover.joint >= 0) fast.joint = constraints.id(static_cast<std::size_t>(mover.joint));
}

WorldDynamics::Mover WorldDynamics::mover_of(std::size_t velocity) const {
  constexpr std::size_t kFreeVelocities = 6;
  const std::size_t free = kFreeVelocities * free_bodies().size();
  if (velocity < free) return {.body = static_cast<std::int32_t>(free_bodies()[velocity / kFreeVelocities])};
  for (const TreeLink& link : layout_.links) {
    const std::size_t begin = free + link.v;
    std::size_t count = 0;
    with_model(link, [&count](auto model) { count = static_cast<std::size_t>(decltype(model)::kRates); });
    if (velocity < begin || velocity >= begin + count) continue;
    if (link.joint >= 0) return {.joint = link.joint};
    return {.body = static_cast<std::int32_t>(layout_.members[link.members_begin].body)};
  }
  return {};  // not of a body
}

}  // namespace pantin
