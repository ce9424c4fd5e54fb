// One step of the world, and what it is made of.
//
//   1  time step: cut where a driven motion breaks
//   2  forces, 4 constraints: evaluated inside the derivative, at every stage of the integrator
//   5  equations of motion, every group of islands by its integrator (integrate_islands.cpp); where stops or
//      dry friction act, from event to event (guarded_step.cpp)
//   7  particles against deflectors, at the end of every part of a step that is cut
//   6  impulses, those that particles gave among them, velocity projection, derived values
//   8  moved bodies, energies, report
// (3 collisions have no part yet.)
#include <algorithm>
#include <cmath>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/world.hpp>

namespace pantin {

namespace {

/// Breaks nearer to the end of a step than this are taken to be at its end [relative to time and step].
constexpr double kBreakSlack = 1e-12;

}  // namespace

StepReport PhysicsManager::step(double h) {
  PANTIN_EXPECTS(h > 0 && std::isfinite(h), "step of " + std::to_string(h) + " s; give a finite step > 0");
  Impl& world = *impl_;
  State& state = world.bodies.state;
  state.previous = state.bodies;
  world.constraints.prepare(world.bodies);
  if (const OpenLoop open = world.constraints.find_open_loop(world.bodies); open.joint >= 0) {
    return world.failure(open);
  }
  const double end = state.time + (h + state.time_compensation);
  const double slack = kBreakSlack * (std::abs(end) + h);
  const bool cut = world.next_break(state.time) < end - slack;
  world.guard.begin_step();
  world.crowded = 0;
  const bool in_parts = cut || world.guard.any();
  const bool keeps = in_parts || world.particles.size() > 0;
  if (keeps) world.remember(in_parts);
  world.particles.begin_step();

  StepReport report;
  world.begin_groups();
  world.fast = {};
  world.motion_topology = state.topology;
  for (bool done = false; !done; ++report.updates) {
    const double stop = world.next_break(state.time);
    done = !(stop < end - slack);
    const double part = done && !cut ? h : (done ? end : stop) - state.time;
    if (state.at_break) world.pass_break();
    if (!world.update(part)) {
      report = world.failure();
      if (keeps) world.go_back(in_parts);
      for (StepGroup& group : world.groups) group.motion.clear();
      return report;
    }
    state.at_break = stop < end + slack;
    if (cut) {
      state.time = done ? end : stop;
    } else {
      const double y = h + state.time_compensation, t = state.time + y;
      state.time_compensation = y - (t - state.time);
      state.time = t;
    }
  }
  world.apply_impulses();
  world.list_moved();
  world.find_overloaded(*this, report.broken);
  for (const JointId joint : report.broken) {
    world.guard.events.push_back({.time = state.time, .joint = joint, .kind = JointEventKind::Broken});
    remove(joint);
  }
  report.time = state.time;
  world.add_counts(report);
  report.fast = world.fast;
  report.moved = world.moved.size();
  report.joint_events = static_cast<int>(world.guard.events.size());
  report.crowded = world.crowded;
  report.energy = world.energy();
  report.particles = world.particles.finish_step();
  return report;
}

void PhysicsManager::Impl::remember(bool with_particles) {
  // Particles are many, and become the state only where an update went well: only parts before it can touch
  // them.
  std::vector<ParticleSystemState> aside;
  if (!with_particles) std::swap(aside, bodies.state.particles);
  before = bodies.state;
  if (!with_particles) std::swap(aside, bodies.state.particles);
}

void PhysicsManager::Impl::go_back(bool with_particles) {
  std::vector<ParticleSystemState> aside;
  if (!with_particles) std::swap(aside, bodies.state.particles);
  bodies.state = before;
  if (!with_particles) std::swap(aside, bodies.state.particles);
}

double PhysicsManager::Impl::next_break(double t) const {
  double next = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.kinds[i] == BodyKind::Animated) next = std::min(next, bodies.drivers[i]->next_break(t));
  }
  for (const TreeLink& link : constraints.layout().links) {
    if (link.driver != nullptr) next = std::min(next, link.driver->next_break(t));
  }
  for (const Closure& closure : constraints.layout().closures) {
    if (closure.driver != nullptr) next = std::min(next, closure.driver->next_break(t));
  }
  return std::min(next, constraints.loads().next_break(t));
}

void PhysicsManager::Impl::pass_break() {
  // A jump in velocity of something driven is an impulse on what hangs on it; a jump in pose carries it
  // along.
  const Instant now{bodies.state.time, Side::After};
  constraints.ground_motions(bodies, now, grounds);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.kinds[i] == BodyKind::Animated) bodies.place(i, grounds[i]);
  }
  for (const Tree& tree : constraints.layout().trees) {
    if (!tree.follows_driver) continue;
    if (tree.has_closures()) {
      constraints.reclose(bodies, static_cast<std::size_t>(&tree - constraints.layout().trees.data()),
                          grounds, now);
    }
    constraints.project(bodies, tree, grounds, now);
    constraints.commit(bodies, tree, grounds, now);
  }
}

bool PhysicsManager::Impl::update(double h) {
  const double t = bodies.state.time;
  const bool good = guard.any() ? guarded_update(h) : integrate(h) && particles.update(t, h, *integrator);
  take_counts();
  return good;
}

void PhysicsManager::Impl::apply_impulses() {
  State& state = bodies.state;
  if (!state.struck) return;
  const TreeLayout& layout = constraints.layout();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyAccumulators& sum = state.accumulators[i];
    const bool struck = sum.force_impulse != Vector3::Zero() || sum.torque_impulse != Vector3::Zero();
    if (struck && bodies.kinds[i] == BodyKind::Simulated) {
      state.bodies[i].linear_momentum += sum.force_impulse;
      state.bodies[i].angular_momentum += sum.torque_impulse;
      const std::int32_t link = layout.link_of_body[i];
      if (link >= 0) {
        state.edited[layout.tree_of(link)] = 1;
      } else {
        bodies.refresh(i);
      }
    }
    sum.force_impulse.setZero();
    sum.torque_impulse.setZero();
  }
  state.struck = false;
  constraints.prepare(bodies);
  if (guard.any()) strike_now();
}

void PhysicsManager::Impl::list_moved() {
  moved.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyState &now = bodies.state.bodies[i], &then = bodies.state.previous[i];
    if (now.p_WBcm != then.p_WBcm || now.q_WB.coeffs() != then.q_WB.coeffs()) moved.push_back(bodies.ids[i]);
  }
}

StepReport PhysicsManager::Impl::failure(const OpenLoop& open) const {
  const SettingsProblem problem = constraints.problem_with(open);
  StepReport report;
  report.status = StepStatus::LoopOpen;
  report.time = bodies.state.time;
  add_counts(report);
  report.message =
      "after " + std::to_string(bodies.state.time) + " s " + problem.text + "; " + problem.remedy;
  return report;
}

StepReport PhysicsManager::Impl::failure() const {
  StepReport report;
  report.status = StepStatus::NotFinite;
  report.time = bodies.state.time;
  add_counts(report);
  if (const ParticleId particle = particles.not_finite()) {
    report.particle = particle;
    report.message = "after " + std::to_string(bodies.state.time) + " s the motion of particle " +
                     std::to_string(particle.serial) + " of system '" +
                     particles.system(particle.system).name() +
                     "' is no longer finite; take a smaller step, or look for a force that is not finite";
    return report;
  }
  const WorldDynamics& culprit = *groups[failed_group].dynamics;
  const std::int32_t i = culprit.first_not_finite();
  if (i < 0) return failure(culprit.open_loop());
  const auto position = static_cast<std::size_t>(i);
  report.body = bodies.ids[position];
  const bool joined = constraints.layout().link_of_body[position] >= 0;
  report.message =
      "after " + std::to_string(bodies.state.time) + " s the motion of body '" + bodies.names[position] +
      (joined ? "', or of what is joined to it," : "'") +
      " is no longer finite; take a smaller step, look for a force that is not finite, or for a joint "
      "that moves no mass";
  return report;
}

Energy PhysicsManager::Impl::energy() const {
  Energy energy;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.kinds[i] != BodyKind::Simulated) continue;
    const BodyState& s = bodies.state.bodies[i];
    const BodyKinematics& k = bodies.state.kinematics[i];
    energy.kinetic += 0.5 * (s.linear_momentum.dot(k.v_WBcm) + s.angular_momentum.dot(k.w_WB));
  }
  energy.potential = forces.potential_energy(bodies.now());
  const Energy joints = constraints.energy(bodies);
  energy.kinetic += joints.kinetic;
  energy.potential += joints.potential;
  return energy;
}

}  // namespace pantin
