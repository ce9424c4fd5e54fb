// The equations of motion over one update: every group of islands by its integrator, one after the other, all
// from the same state. Nothing is written back before all have arrived.
#include <algorithm>

#include <pantin/physics/world.hpp>

namespace pantin {

void PhysicsManager::Impl::begin_groups() {
  fit_groups();
  for (StepGroup& group : groups) {
    group.motion.clear();
    group.evaluations = group.accepted = group.refused = 0;
    group.shortest = std::numeric_limits<double>::infinity();
    group.loop_margin = 1;
  }
}

bool PhysicsManager::Impl::integrate(double h) {
  room.begin(bodies, constraints);
  WorldDynamics* with_particles = &dynamics;
  for (StepGroup& group : groups) {
    if (group.has_particles) with_particles = group.dynamics;
  }
  Dynamics* both = particles.begin_update(*with_particles);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    StepGroup& group = groups[g];
    group.dynamics->begin();
    if (both != nullptr && group.has_particles) {
      advance(g, *both, h, particles.coordinates_now(), particles.velocities_now());
      particles.bodies_have_moved();
    } else {
      advance(g, *group.dynamics, h, group.dynamics->coordinates_now(), group.dynamics->velocities_now());
    }
    if (group.dynamics->first_not_finite() >= 0 || group.dynamics->open_loop().joint >= 0) {
      failed_group = g;
      for (StepMemory& memory : bodies.state.memories) memory = {};
      return false;
    }
    if (groups.size() > 1) group.dynamics->put_back();
  }
  for (StepGroup& group : groups) group.dynamics->write_back(bodies.state.time + h);
  return true;
}

void PhysicsManager::Impl::advance(std::size_t g, Dynamics& system, double h, std::span<double> q,
                                   std::span<double> v) {
  StepGroup& group = groups[g];
  StepControl* control = group.integrator->control();
  if (control != nullptr) std::swap(control->memory, bodies.state.memories[g]);
  group.dynamics->evaluations = 0;
  group.dynamics->loop_margin = 1;
  integrate(group, system, h, q, v);
  group.evaluations += group.dynamics->evaluations;
  group.loop_margin = std::min(group.loop_margin, group.dynamics->loop_margin);
  if (control == nullptr) return;
  std::swap(control->memory, bodies.state.memories[g]);
  group.accepted += control->accepted;
  group.refused += control->refused;
  if (control->accepted > 0) group.shortest = std::min(group.shortest, control->shortest);
}

void PhysicsManager::Impl::add_counts(StepReport& report) const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const StepGroup& group : groups) {
    report.evaluations += group.evaluations;
    report.loop_margin = std::min(report.loop_margin, group.loop_margin);
    report.inner_steps += group.accepted;
    report.refused_steps += group.refused;
    shortest = std::min(shortest, group.shortest);
  }
  if (report.inner_steps > 0) report.shortest_step = shortest;
}

}  // namespace pantin
