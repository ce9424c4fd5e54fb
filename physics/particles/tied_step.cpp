// An update of a system whose particles are tied, in substeps (tied_particles.hpp). Forces are evaluated at
// both ends of a substep; bodies stand, for the forces that couple with them, where the update ended, and get
// the impulses of these forces and of pins at the end of the step: between bodies and tied particles the
// method is of first order.
#include <algorithm>
#include <cmath>

#include <pantin/physics/particles/particle_world.hpp>

namespace pantin {

namespace {

constexpr std::size_t kArrays = 9;  // x y z vx vy vz, forces

}  // namespace

void ParticleManager::Impl::prepare_ties(std::size_t k) {
  SystemData& data = systems[k];
  const ParticleSystemState& now = state(k);
  const std::size_t n = now.size();
  if (!data.rows_are_stale && data.rows_of_population == now.population && data.inverse_mass.size() == n)
    return;
  data.inverse_mass.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    data.inverse_mass[i] = 1 / (now.mass.empty() ? data.settings.mass : now.mass[i]);
  data.pinned.clear();
  for (const Pin& pin : data.pins) {
    const std::size_t i = now.position_of(pin.serial);
    data.pinned.push_back(i);
    if (i < n) data.inverse_mass[i] = 0;
  }
  data.tied.build(data.ties, data.inverse_mass,
                  [&](std::uint64_t serial) { return now.position_of(serial); });
  for (std::vector<Vector3>* v : {&data.q0, &data.q1, &data.v, &data.force}) v->resize(n);
  data.rows_are_stale = false;
  data.rows_of_population = now.population;
}

CoupledParticles ParticleManager::Impl::view_of(std::size_t k, double t, std::span<double> arrays) {
  const std::size_t n = arrays.size() / kArrays;
  const auto part = [&](std::size_t j) { return arrays.subspan(j * n, n); };
  return {{.t = t,
           .system = state(k).id,
           .x = part(0),
           .y = part(1),
           .z = part(2),
           .vx = part(3),
           .vy = part(4),
           .vz = part(5),
           .mass = std::span<const double>{masses}.first(n)},
          {part(6), part(7), part(8)},
          state(k).serial};
}

/// Forces at positions `q` and velocities v of the system's work space.
void ParticleManager::Impl::find_forces(std::size_t k, double t, std::span<const Vector3> q, double weight) {
  SystemData& data = systems[k];
  const std::size_t n = q.size();
  soa.assign(kArrays * n, 0.0);
  masses.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      soa[axis * n + i] = q[i][static_cast<Eigen::Index>(axis)];
      soa[(3 + axis) * n + i] = data.v[i][static_cast<Eigen::Index>(axis)];
    }
    masses[i] = state(k).mass.empty() ? data.settings.mass : state(k).mass[i];
  }
  const CoupledParticles view = view_of(k, t, soa);
  forces.gather(view.at, view.force);
  if (forces.action_on(view.at.system) == ParticleAction::Coupled) {
    wrenches.assign(bodies.size(), Wrench{});
    forces.gather(bodies.now(), wrenches, {&view, 1});
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (bodies.kinds[b] != BodyKind::Simulated) continue;
      bodies.state.accumulators[b].force_impulse += weight * wrenches[b].force;
      bodies.state.accumulators[b].torque_impulse += weight * wrenches[b].torque;
      bodies.state.struck = true;
    }
  }
  for (std::size_t i = 0; i < n; ++i) data.force[i] = {view.force.x[i], view.force.y[i], view.force.z[i]};
}

/// Tells pinned particles where they end a substep, at this fraction of the update.
void ParticleManager::Impl::place_pins(std::size_t k, double fraction, double h) {
  SystemData& data = systems[k];
  for (std::size_t p = 0; p < data.pins.size(); ++p) {
    const std::size_t i = data.pinned[p];
    if (i >= data.q1.size()) continue;
    const Attachment& to = data.pins[p].to;
    const DeflectorMotion motion = motion_of(to.body, h);
    data.q1[i] = motion.to_world(to.p_BQ, fraction);
    data.v[i] = motion.velocity(data.q1[i], fraction);
  }
}

/// What ties pull at pinned particles goes to the bodies that hold them.
void ParticleManager::Impl::feel_pins(std::size_t k) {
  const SystemData& data = systems[k];
  for (std::size_t p = 0; p < data.pins.size(); ++p) {
    const std::size_t i = data.pinned[p];
    const BodyId body = data.pins[p].to.body;
    if (i >= data.q1.size() || !body || bodies.kinds[bodies.at(body)] != BodyKind::Simulated) continue;
    const std::size_t b = bodies.at(body);
    const Vector3 j = data.tied.impulse_on(i);
    const Vector3 middle = 0.5 * (data.q0[i] + data.q1[i]);
    bodies.state.accumulators[b].force_impulse += j;
    bodies.state.accumulators[b].torque_impulse += (middle - bodies.state.bodies[b].p_WBcm).cross(j);
    bodies.state.struck = true;
  }
}

bool ParticleManager::Impl::advance_tied(std::size_t k, double t, double h) {
  prepare_ties(k);
  SystemData& data = systems[k];
  const ParticleSystemState& now = state(k);
  const std::size_t n = now.size();
  const int substeps = data.settings.substeps;
  const double part = h / substeps;
  for (std::size_t i = 0; i < n; ++i) data.q1[i] = now.now.position(i), data.v[i] = now.now.velocity(i);
  const auto note = [&](const TieSolve& solve) {
    report.constraint_iterations = std::max(report.constraint_iterations, solve.iterations);
    report.converged = report.converged && solve.converged;
  };
  for (int j = 0; j < substeps; ++j) {
    const double s0 = static_cast<double>(j) / substeps, s1 = static_cast<double>(j + 1) / substeps;
    note(data.tied.correct(data.q1));
    std::swap(data.q0, data.q1);
    find_forces(k, t + s0 * h, data.q0, 0.5 * part);
    for (std::size_t i = 0; i < n; ++i) data.v[i] += (0.5 * part * data.inverse_mass[i]) * data.force[i];
    place_pins(k, s1, h);
    note(data.tied.drift(part, data.q0, data.q1, data.v));
    feel_pins(k);
    predict(k, 0.5 * part);
    find_forces(k, t + s1 * h, data.q1, 0.5 * part);
    for (std::size_t i = 0; i < n; ++i) {
      data.v[i] = kicked[i] + (0.5 * part * data.inverse_mass[i]) * data.force[i];
    }
    if (!sweep_tied(k, s0, s1, h)) return false;
  }
  report.constraint_error = std::max(report.constraint_error, data.tied.error(data.q1));
  data.energy.potential += data.tied.energy(data.q1) + forces.particle_energy(view_of(k, t + h, soa).at);
  for (std::size_t i = 0; i < n; ++i) {
    data.next.set(i, data.q1[i], data.v[i]);
    data.energy.kinetic += 0.5 * masses[i] * data.v[i].squaredNorm();
  }
  return true;
}

/// Velocities at the end of a substep, for forces that look at them: with the force that was there at its
/// begin.
void ParticleManager::Impl::predict(std::size_t k, double half) {
  SystemData& data = systems[k];
  kicked.assign(data.v.begin(), data.v.end());
  for (std::size_t i = 0; i < data.v.size(); ++i) data.v[i] += (half * data.inverse_mass[i]) * data.force[i];
}

bool ParticleManager::Impl::sweep_tied(std::size_t k, double s0, double s1, double h) {
  SystemData& data = systems[k];
  const ParticleSystemState& now = state(k);
  for (std::size_t i = 0; i < data.q1.size(); ++i) {
    if (data.q1[i].allFinite() && data.v[i].allFinite()) continue;
    not_finite = {now.id, now.serial_of(i)};
    return false;
  }
  if (deflectors.size() == 0) return true;
  deflectors.narrow(s0, s1);
  begin_arrays.resize(data.q1.size());
  for (std::size_t i = 0; i < data.q1.size(); ++i) begin_arrays.set(i, data.q0[i], data.v[i]);
  for (std::size_t i = 0; i < data.q1.size(); ++i) data.next.set(i, data.q1[i], data.v[i]);
  for (std::size_t first = 0; first < data.q1.size(); first += ParticleBlock::kMost) {
    const std::size_t n = std::min(ParticleBlock::kMost, data.q1.size() - first);
    block.load(now.id, begin_arrays, first, n, now.mass, data.settings.mass);
    block.arrive(data.next, first);
    skip_in_batch.clear();
    for (const std::size_t pinned : data.pinned) {
      if (pinned >= first && pinned < first + n) skip_in_batch.push_back(pinned - first);
    }
    block.sweep(sweep, 0, (s1 - s0) * h, data.settings.radius, skip_in_batch,
                [](std::size_t, const Deflector&, const MovingParticle&) {});
    block.store(data.next, first);
  }
  for (std::size_t i = 0; i < data.q1.size(); ++i) {
    data.q1[i] = data.next.position(i);
    data.v[i] = data.next.velocity(i);
  }
  deflectors.narrow(0, 1);
  return true;
}

}  // namespace pantin
