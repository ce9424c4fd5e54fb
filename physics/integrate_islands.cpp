// The equations of motion over one update: every group of islands by its integrator, one after the other, all
// from the same state. Nothing is written back before all have arrived.
#include <algorithm>
#include <utility>

#include <pantin/physics/world.hpp>

namespace pantin {

void PhysicsManager::Impl::begin_groups() {
  fit_groups();
  for (StepGroup& group : groups) {
    group.motion.clear();
    group.evaluations = group.accepted = group.refused = 0;
    group.shortest = std::numeric_limits<double>::infinity();
    group.loop_margin = 1;
    group.dynamics->evaluations = 0;
    group.dynamics->loop_margin = 1;
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
    const StepControl* control = nullptr;
    if (both != nullptr && group.has_particles) {
      control = advance(g, *both, h, particles.coordinates_now(), particles.velocities_now());
      particles.bodies_have_moved();
    } else {
      control =
          advance(g, *group.dynamics, h, group.dynamics->coordinates_now(), group.dynamics->velocities_now());
    }
    if (control != nullptr) group.note(*control);
    if (has_failed(g)) return false;
    if (groups.size() > 1) group.dynamics->put_back();
  }
  for (StepGroup& group : groups) group.dynamics->write_back(bodies.state.time + h);
  return true;
}

bool PhysicsManager::Impl::has_failed(std::size_t g) {
  const WorldDynamics& reached = *groups[g].dynamics;
  if (reached.first_not_finite() < 0 && reached.open_loop().joint < 0) return false;
  failed_group = g;
  for (StepMemory& memory : bodies.state.memories) memory = {};
  return true;
}

StepControl* PhysicsManager::Impl::advance(std::size_t g, Dynamics& system, double h, std::span<double> q,
                                           std::span<double> v) {
  StepControl* control = groups[g].integrator->control();
  if (control != nullptr) std::swap(control->memory, bodies.state.memories[g]);
  integrate(g, system, h, q, v);
  if (control != nullptr) std::swap(control->memory, bodies.state.memories[g]);
  return control;
}

void PhysicsManager::Impl::take_counts() {
  for (StepGroup& group : groups) {
    group.evaluations += std::exchange(group.dynamics->evaluations, 0);
    group.loop_margin = std::min(group.loop_margin, std::exchange(group.dynamics->loop_margin, 1.0));
  }
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
