#include <pantin/physics/particles/coupled_dynamics.hpp>

#include <algorithm>
#include <cmath>

namespace pantin {

void CoupledDynamics::add_member(std::size_t system, double mass) {
  const ParticleSystemState& state = bodies_.state.particles[system];
  const Member* last = members_.empty() ? nullptr : &members_.back();
  const std::size_t begin = last == nullptr ? 0 : last->begin + last->size;
  members_.push_back({system, begin, state.size()});
  mass_.resize(begin + state.size());
  for (std::size_t i = 0; i < state.size(); ++i) mass_[begin + i] = state.mass.empty() ? mass : state.mass[i];
  force_.resize(3 * mass_.size());
}

bool CoupledDynamics::has(std::size_t system) const {
  return std::any_of(members_.begin(), members_.end(),
                     [system](const Member& m) { return m.system == system; });
}

std::span<double> CoupledDynamics::coordinates_now() {
  const std::span<double> world = world_->coordinates_now();
  q_.resize(world.size() + 3 * mass_.size());
  std::copy(world.begin(), world.end(), q_.begin());
  double* to = q_.data() + world.size();
  for (const Member& m : members_) {
    const ParticleArrays& now = bodies_.state.particles[m.system].now;
    for (const std::vector<double>* a : {&now.x, &now.y, &now.z}) to = std::copy(a->begin(), a->end(), to);
  }
  world_->also = this;
  return q_;
}

std::span<double> CoupledDynamics::velocities_now() {
  const std::span<double> world = world_->velocities_now();
  v_.resize(world.size() + 3 * mass_.size());
  std::copy(world.begin(), world.end(), v_.begin());
  double* to = v_.data() + world.size();
  for (const Member& m : members_) {
    const ParticleArrays& now = bodies_.state.particles[m.system].now;
    for (const std::vector<double>* a : {&now.vx, &now.vy, &now.vz}) to = std::copy(a->begin(), a->end(), to);
  }
  return v_;
}

void CoupledDynamics::end() {
  world_->also = nullptr;
  std::copy_n(q_.begin(), world_->coordinates(), world_->coordinates_reached().begin());
  std::copy_n(v_.begin(), world_->velocities(), world_->velocities_reached().begin());
}

void CoupledDynamics::read(std::size_t system, ParticleArrays& out) const {
  for (const Member& m : members_) {
    if (m.system != system) continue;
    const double* q = q_.data() + world_->coordinates() + 3 * m.begin;
    const double* v = v_.data() + world_->velocities() + 3 * m.begin;
    for (std::vector<double>* a : {&out.x, &out.y, &out.z})
      q = (std::copy_n(q, m.size, a->begin()), q + m.size);
    for (std::vector<double>* a : {&out.vx, &out.vy, &out.vz})
      v = (std::copy_n(v, m.size, a->begin()), v + m.size);
  }
}

void CoupledDynamics::look_at(std::span<const double> q, std::span<const double> v) {
  const std::span<const double> qp = q.subspan(world_->coordinates()), vp = v.subspan(world_->velocities());
  views_.clear();
  for (const Member& m : members_) {
    const ParticleSystemState& state = bodies_.state.particles[m.system];
    const std::size_t n = m.size, b = 3 * m.begin;
    const std::span<double> f{force_};
    views_.push_back({{.system = state.id,
                       .x = qp.subspan(b, n),
                       .y = qp.subspan(b + n, n),
                       .z = qp.subspan(b + 2 * n, n),
                       .vx = vp.subspan(b, n),
                       .vy = vp.subspan(b + n, n),
                       .vz = vp.subspan(b + 2 * n, n),
                       .mass = std::span<const double>{mass_}.subspan(m.begin, n)},
                      {f.subspan(b, n), f.subspan(b + n, n), f.subspan(b + 2 * n, n)},
                      state.serial});
  }
}

void CoupledDynamics::add_wrenches(const BodiesAt& bodies, std::span<Wrench> wrenches) {
  std::fill(force_.begin(), force_.end(), 0.0);
  for (CoupledParticles& view : views_) {
    view.at.t = bodies.t;
    view.at.side = bodies.side;
    forces_.gather(view.at, view.force);
  }
  forces_.gather(bodies, wrenches, views_);
}

void CoupledDynamics::rate(Instant at, std::span<const double> q, std::span<const double> v,
                           std::span<double> q_dot) {
  const std::size_t nq = world_->coordinates(), nv = world_->velocities();
  world_->rate(at, q.first(nq), v.first(nv), q_dot.first(nq));
  std::copy(v.begin() + static_cast<std::ptrdiff_t>(nv), v.end(),
            q_dot.begin() + static_cast<std::ptrdiff_t>(nq));
}

void CoupledDynamics::acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                                   std::span<double> v_dot) {
  derivative(at, q, v, {}, v_dot);
}

void CoupledDynamics::derivative(Instant at, std::span<const double> q, std::span<const double> v,
                                 std::span<double> q_dot, std::span<double> v_dot) {
  const std::size_t nq = world_->coordinates(), nv = world_->velocities();
  look_at(q, v);
  if (q_dot.empty()) {
    world_->acceleration(at, q.first(nq), v.first(nv), v_dot.first(nv));
  } else {
    world_->derivative(at, q.first(nq), v.first(nv), q_dot.first(nq), v_dot.first(nv));
    std::copy(v.begin() + static_cast<std::ptrdiff_t>(nv), v.end(),
              q_dot.begin() + static_cast<std::ptrdiff_t>(nq));
  }
  double* out = v_dot.data() + nv;
  for (const Member& m : members_) {
    const double* f = force_.data() + 3 * m.begin;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < m.size; ++i) *out++ = *f++ / mass_[m.begin + i];
    }
  }
}

double CoupledDynamics::motion_error(std::span<const double> q, std::span<const double> v,
                                     std::span<const double> q_error, std::span<const double> v_error,
                                     double h) {
  const std::size_t nq = world_->coordinates(), nv = world_->velocities();
  double worst = world_->motion_error(q.first(nq), v.first(nv), q_error.first(nq), v_error.first(nv), h);
  for (const double e : q_error.subspan(nq)) worst = std::max(worst, std::abs(e));
  for (const double e : v_error.subspan(nv)) worst = std::max(worst, h * std::abs(e));
  return worst;
}

}  // namespace pantin
