// Which islands are integrated together, and by which integrator.
//
//   an island with an integrator of its own      by itself
//   the others, where the common integrator
//     takes the steps it is asked for            all together
//     chooses its own                            each by itself, but for free bodies that no law names, which
//                                                go together: their steps are alike, and they are many
//
// Events at stops and in dry friction are met by all bodies: where there are such joints, all islands go
// together. Where bodies of one group ask for different integrators, the one that was set last wins.
#include <algorithm>
#include <cmath>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/islands.hpp>
#include <pantin/physics/stamp.hpp>
#include <pantin/physics/world.hpp>

namespace pantin {
namespace {

/// Of bodies and integrators, group by group: equal for managers that were built alike.
std::uint64_t stamp_of(const std::vector<StepGroup>& groups, const std::vector<BodyId>& ids) {
  std::uint64_t h = kStampSeed;
  for (const StepGroup& group : groups) {
    h = stamped(h, 2 * group.bodies.size() + (group.has_particles ? 1 : 0));
    for (const std::uint32_t i : group.bodies) h = stamped(stamped(h, ids[i].index), ids[i].generation);
    for (const char c : group.integrator->name()) h = stamped(h, static_cast<unsigned char>(c));
  }
  return h;
}

Island united(const std::vector<Island>& islands) {
  Island all;
  for (const Island& island : islands) {
    all.bodies.insert(all.bodies.end(), island.bodies.begin(), island.bodies.end());
    all.has_particles = all.has_particles || island.has_particles;
  }
  std::sort(all.bodies.begin(), all.bodies.end());
  return all;
}

}  // namespace

void PhysicsManager::Impl::fit_groups() {
  const std::vector<ParticleSystemState>& systems = bodies.state.particles;
  const bool same_systems =
      std::equal(systems.begin(), systems.end(), groups_key.systems.begin(), groups_key.systems.end(),
                 [](const auto& state, ParticleSystemId id) { return state.id == id; });
  if (groups.empty() || !same_systems || groups_key.layout != constraints.layout_revision() ||
      groups_key.forces != forces.revision() || groups_key.integrators != integrator_revision ||
      groups_key.integrator_of_particles != particles.integrator_revision() ||
      groups_key.is_guarded != guard.any()) {
    groups_key = {.layout = constraints.layout_revision(),
                  .forces = forces.revision(),
                  .integrators = integrator_revision,
                  .integrator_of_particles = particles.integrator_revision(),
                  .is_guarded = guard.any()};
    for (const ParticleSystemState& system : systems) groups_key.systems.push_back(system.id);
    make_groups();
  }
  // Memories go with the state, which may come from another manager that was built alike.
  State& state = bodies.state;
  if (state.groups == groups_stamp) return;
  double next = 0;
  for (const StepMemory& memory : state.memories) {
    if (memory.next > 0) next = next > 0 ? std::min(next, memory.next) : memory.next;
  }
  state.memories.assign(groups.size(), StepMemory{.next = next});
  state.stabilities.assign(groups.size(), {});
  state.groups = groups_stamp;
}

const BodyIntegrator* PhysicsManager::Impl::integrator_of(const Island& island) const {
  const BodyIntegrator* last = nullptr;
  for (const BodyIntegrator& own : own_integrators) {
    const auto i = static_cast<std::uint32_t>(bodies.at(own.body));
    if (std::binary_search(island.bodies.begin(), island.bodies.end(), i)) last = &own;
  }
  return last;
}

void PhysicsManager::Impl::make_groups() {
  std::vector<Island> islands = find_islands(bodies, constraints.layout(), forces);
  if (guard.any()) islands = {united(islands)};
  const auto others =
      std::count_if(islands.begin(), islands.end(), [](const Island& island) { return !island.is_plain; });
  const bool chooses = integrator->control() != nullptr;
  const bool apart = chooses && static_cast<std::size_t>(others) <= kMostSeparateIslands;
  const std::string reason_together =
      !chooses ? "one integrator in steps of the length asked for"
      : apart  ? "free bodies that no law names"
               : "more than " + std::to_string(kMostSeparateIslands) +
                    " islands, for each of which the force laws would be asked about all bodies";

  groups.clear();
  std::size_t together = islands.size();  // which group that is, where there is one
  for (const Island& island : islands) {
    StepGroup group{.bodies = island.bodies, .has_particles = island.has_particles};
    if (const BodyIntegrator* own = integrator_of(island)) {
      group.integrator = own->integrator.get();
      group.reason = "asked for by body '" + bodies.names[bodies.at(own->body)] + "'";
    } else if (Integrator* of_particles = particles.own_integrator(); of_particles && island.bodies.empty()) {
      group.integrator = of_particles;
      group.reason = "the integrator of particles, which no body is coupled with";
    } else if (apart && !island.is_plain) {
      group.integrator = integrator.get();
      group.reason = "in steps of its own, which no other island needs";
    } else if (together < groups.size()) {
      StepGroup& with = groups[together];
      with.bodies.insert(with.bodies.end(), island.bodies.begin(), island.bodies.end());
      with.has_particles = with.has_particles || island.has_particles;
      continue;
    } else {
      together = groups.size();
      group.integrator = integrator.get();
      group.reason = reason_together;
    }
    groups.push_back(std::move(group));
  }
  if (groups.empty()) groups.push_back({.integrator = integrator.get(), .reason = "nothing is simulated"});
  for (StepGroup& group : groups) std::sort(group.bodies.begin(), group.bodies.end());
  if (guard.any())
    groups.front().reason = "joints have stops or friction, whose events all bodies meet together";
  if (groups.size() == 1) groups.front().dynamics = &dynamics;
  else lay_out_groups();
  groups_stamp = stamp_of(groups, bodies.ids);
}

void PhysicsManager::Impl::lay_out_groups() {
  const TreeLayout& layout = constraints.layout();
  std::vector<std::size_t> group_of(bodies.size(), groups.size());
  std::vector<std::uint32_t> free, trees;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    StepGroup& group = groups[g];
    free.clear();
    trees.clear();
    for (const std::uint32_t i : group.bodies) {
      group_of[i] = g;
      const std::int32_t link = layout.link_of_body[i];
      if (link < 0) free.push_back(i);
      if (link >= 0) trees.push_back(static_cast<std::uint32_t>(layout.tree_of(link)));
    }
    std::sort(trees.begin(), trees.end());
    trees.erase(std::unique(trees.begin(), trees.end()), trees.end());
    group.part = part_of(layout, free, trees);
    constraints.list_loads(group.part->layout, group.part->loads);
    group.of_part = std::make_unique<WorldDynamics>(bodies, constraints, forces, room, *group.part);
    group.dynamics = group.of_part.get();
  }
  for (const ForceLaw* law : forces.laws()) {
    const Coupling coupling = law->coupling();
    if (coupling.reach != Coupling::Reach::Named) {
      for (StepGroup& group : groups) group.part->laws.push_back(law);
      continue;
    }
    // The bodies named are of one group, as far as they are simulated.
    for (const BodyId id : coupling.bodies) {
      const std::size_t g = id ? group_of[bodies.position_of[id.index]] : groups.size();
      if (g == groups.size()) continue;
      groups[g].part->laws.push_back(law);
      break;
    }
  }
}

void PhysicsManager::set_integrator(std::unique_ptr<Integrator> integrator) {
  PANTIN_EXPECTS(integrator != nullptr, "no integrator given; known names are those of integrator_names()");
  impl_->integrator = std::move(integrator);
  impl_->particles.integrator_of_bodies_changed();
  ++impl_->integrator_revision;
}

void PhysicsManager::set_integrator(BodyId body, std::unique_ptr<Integrator> integrator) {
  static_cast<void>(impl_->bodies.at(body));
  impl_->forget_integrator_of(body);
  if (integrator != nullptr) impl_->own_integrators.push_back({body, std::move(integrator)});
}

void PhysicsManager::Impl::forget_integrator_of(BodyId body) {
  std::erase_if(own_integrators, [body](const BodyIntegrator& own) { return own.body == body; });
  ++integrator_revision;
}

bool PhysicsManager::holds_tolerance() const noexcept {
  return std::isfinite(impl_->integrator->tolerance()) &&
         std::all_of(impl_->own_integrators.begin(), impl_->own_integrators.end(),
                     [](const BodyIntegrator& own) { return std::isfinite(own.integrator->tolerance()); });
}

std::vector<IslandGroup> PhysicsManager::islands() {
  Impl& world = *impl_;
  world.constraints.prepare(world.bodies);
  world.guard.fit();
  world.fit_groups();
  std::vector<IslandGroup> list;
  for (const StepGroup& group : world.groups) {
    IslandGroup& out = list.emplace_back();
    for (const std::uint32_t i : group.bodies) out.bodies.push_back(world.bodies.ids[i]);
    out.has_particles = group.has_particles;
    out.integrator = group.integrator->name();
    out.reason = group.reason;
    out.evaluations = group.evaluations;
    out.inner_steps = group.accepted;
    out.refused_steps = group.refused;
    out.shortest_step = group.accepted > 0 ? group.shortest : 0;
  }
  return list;
}

}  // namespace pantin
