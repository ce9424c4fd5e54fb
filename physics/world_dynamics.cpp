#include <pantin/physics/world_dynamics.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

namespace {

constexpr std::size_t kFreeCoordinates = 7, kFreeVelocities = 6;

void write(const BodyState& s, double* q, double* v) {
  q[0] = s.p_WBcm.x(), q[1] = s.p_WBcm.y(), q[2] = s.p_WBcm.z();
  q[3] = s.q_WB.w(), q[4] = s.q_WB.x(), q[5] = s.q_WB.y(), q[6] = s.q_WB.z();
  for (int i = 0; i < 3; ++i) v[i] = s.linear_momentum[i], v[3 + i] = s.angular_momentum[i];
}

BodyState read(const double* q, const double* v) {
  return {{q[0], q[1], q[2]}, Quaternion{q[3], q[4], q[5], q[6]}, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

}  // namespace

void WorldDynamics::begin() {
  const TreeLayout& layout = constraints_.layout();
  q_.resize(kFreeCoordinates * layout.free_bodies.size() + layout.coordinates);
  v_.resize(kFreeVelocities * layout.free_bodies.size() + layout.rates);
  open_loop_ = {};
  stage_ = bodies_.state.kinematics;
  wrenches_.resize(bodies_.size());
  has_animated_ =
      std::find(bodies_.kinds.begin(), bodies_.kinds.end(), BodyKind::Animated) != bodies_.kinds.end();
  constraints_.ground_motions(bodies_, {bodies_.state.time, Side::After}, grounds_);
  lane_.fits = false;
}

std::span<double> WorldDynamics::coordinates_now() {
  double* q = q_.data();
  double unused[kFreeVelocities];
  for (const std::uint32_t i : free_bodies()) {
    write(bodies_.state.bodies[i], q, unused);
    q += kFreeCoordinates;
  }
  std::copy(bodies_.state.coordinates.begin(), bodies_.state.coordinates.end(), q);
  return q_;
}

std::span<double> WorldDynamics::velocities_now() {
  double* v = v_.data();
  double unused[kFreeCoordinates];
  for (const std::uint32_t i : free_bodies()) {
    write(bodies_.state.bodies[i], unused, v);
    v += kFreeVelocities;
  }
  std::copy(bodies_.state.rates.begin(), bodies_.state.rates.end(), v);
  return v_;
}

void WorldDynamics::place_free(std::span<const double> q_all, std::span<const double> v_all,
                               std::span<double> q_dot) {
  const double* q = q_all.data();
  const double* v = v_all.data();
  double* out = q_dot.empty() ? nullptr : q_dot.data();
  for (const std::uint32_t i : free_bodies()) {
    BodyKinematics& k = stage_[i];
    const kernel::Mat3<double> R = kernel::rotation_of(q + 3);
    k.R_WB << R.m[0], R.m[1], R.m[2], R.m[3], R.m[4], R.m[5], R.m[6], R.m[7], R.m[8];
    k.p_WBcm << q[0], q[1], q[2];
    const double inverse_mass = 1 / bodies_.mass[i].mass;
    k.v_WBcm << v[0] * inverse_mass, v[1] * inverse_mass, v[2] * inverse_mass;
    const kernel::Vec3<double> L_B = kernel::transposed_times(R, kernel::Vec3<double>{v[3], v[4], v[5]});
    const Vector3 w_B = bodies_.inverse_inertia[i] * Vector3{L_B.x, L_B.y, L_B.z};
    const kernel::Vec3<double> w = R * kernel::Vec3<double>{w_B.x(), w_B.y(), w_B.z()};
    k.w_WB << w.x, w.y, w.z;
    if (out != nullptr) {
      out[0] = k.v_WBcm.x(), out[1] = k.v_WBcm.y(), out[2] = k.v_WBcm.z();
      kernel::quaternion_rate_world(q + 3, w, out + 3);
      out += kFreeCoordinates;
    }
    q += kFreeCoordinates;
    v += kFreeVelocities;
  }
}

void WorldDynamics::place_grounds(Instant at) {
  if (!has_animated_) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_.kinds[i] != BodyKind::Animated) continue;
    const RigidMotion m = bodies_.drivers[i]->motion(at.t, at.side);
    grounds_[i] = m;
    BodyKinematics& k = stage_[i];
    k.R_WB = m.X_AB.rotation();
    const Vector3 c = k.R_WB * bodies_.mass[i].p_BBcm;
    k.p_WBcm = m.X_AB.p + c;
    k.v_WBcm = m.v_AB + m.w_AB.cross(c);
    k.w_WB = m.w_AB;
  }
}

void WorldDynamics::place_trees(Instant at, std::span<const double> q, std::span<const double> v) {
  const TreeLayout& layout = constraints_.layout();
  for (const Tree& tree : layout.trees) {
    constraints_.kernel().place(layout, tree, grounds_, at, q.last(layout.coordinates), v.last(layout.rates));
    constraints_.kernel().write_members(layout, tree, bodies_.mass, stage_);
  }
}

void WorldDynamics::tree_rates(std::span<const double> q, std::span<const double> v,
                               std::span<double> q_dot) const {
  const TreeLayout& layout = constraints_.layout();
  const double* q0 = q.data() + (q.size() - layout.coordinates);
  const double* v0 = v.data() + (v.size() - layout.rates);
  double* out = q_dot.data() + (q_dot.size() - layout.coordinates);
  for (const TreeLink& link : layout.links) {
    with_model(link, [&](auto model) { model.rate(q0 + link.q, v0 + link.v, out + link.q); });
  }
}

void WorldDynamics::gather_wrenches(Instant at) {
  if (bodies_.state.loaded) {
    for (std::size_t i = 0; i < wrenches_.size(); ++i) {
      wrenches_[i] = {bodies_.state.accumulators[i].force, bodies_.state.accumulators[i].torque};
    }
  } else {
    std::fill(wrenches_.begin(), wrenches_.end(), Wrench{});
  }
  const BodiesAt bodies{.t = at.t,
                        .side = at.side,
                        .kinematics = stage_,
                        .mass = bodies_.mass,
                        .kind = bodies_.kinds,
                        .position_of = bodies_.position_of};
  forces_.gather(bodies, wrenches_);
  if (also != nullptr) also->add_wrenches(bodies, wrenches_);
}

void WorldDynamics::evaluate(Instant at, std::span<const double> q, std::span<const double> v,
                             std::span<double> q_dot, std::span<double> v_dot) {
  ++evaluations;
  place_grounds(at);
  place_free(q, v, q_dot);
  place_trees(at, q, v);
  gather_wrenches(at);

  double* out = v_dot.data();
  for (const std::uint32_t i : free_bodies()) {
    for (int k = 0; k < 3; ++k) out[k] = wrenches_[i].force[k], out[3 + k] = wrenches_[i].torque[k];
    out += kFreeVelocities;
  }
  const TreeLayout& layout = constraints_.layout();
  Articulated& kernel = constraints_.kernel();
  for (const Tree& tree : layout.trees) {
    kernel.load(layout, tree);
    for (std::uint32_t l = tree.links_begin; l < tree.links_end; ++l) {
      for (std::uint32_t m = layout.links[l].members_begin; m < layout.links[l].members_end; ++m) {
        const std::uint32_t i = layout.members[m].body;
        kernel.add_wrench(static_cast<std::int32_t>(l), wrenches_[i].force, wrenches_[i].torque,
                          stage_[i].p_WBcm);
      }
    }
    if (tree.has_closures()) ClosureSolver::add_damping(layout, tree, kernel, grounds_, at);
    kernel.eliminate(layout, tree, v.last(layout.rates));
    kernel.substitute(layout, tree, v_dot.last(layout.rates));
    if (tree.has_closures()) evaluate_loops(at, tree, v_dot.last(layout.rates));
  }
}

void WorldDynamics::rate(Instant, std::span<const double> q, std::span<const double> v,
                         std::span<double> q_dot) {
  place_free(q, v, q_dot);
  tree_rates(q, v, q_dot);
}

void WorldDynamics::acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                                 std::span<double> v_dot) {
  evaluate(at, q, v, {}, v_dot);
}

void WorldDynamics::derivative(Instant at, std::span<const double> q, std::span<const double> v,
                               std::span<double> q_dot, std::span<double> v_dot) {
  evaluate(at, q, v, q_dot, v_dot);
  tree_rates(q, v, q_dot);
}

void WorldDynamics::settle(Instant at, std::span<double> q_all, std::span<double> v_all) {
  double* q = q_all.data();
  for (const std::uint32_t i : free_bodies()) {
    // A body that did not turn keeps its bits.
    const Quaternion& before = bodies_.state.bodies[i].q_WB;
    if (q[3] != before.w() || q[4] != before.x() || q[5] != before.y() || q[6] != before.z()) {
      kernel::normalise_quaternion(q + 3);
    }
    q += kFreeCoordinates;
  }
  const double* before = bodies_.state.coordinates.data();
  for (const TreeLink& link : constraints_.layout().links) {
    with_model(link, [&](auto model) {
      using Model = decltype(model);
      if (!std::equal(q + link.q, q + link.q + Model::kCoordinates, before + link.q))
        Model::normalise(q + link.q);
    });
  }
  if (has_constraints()) {
    const TreeLayout& layout = constraints_.layout();
    settle_loops(at, q_all.last(layout.coordinates), v_all.last(layout.rates));
  }
}

bool WorldDynamics::acceleration_depends_on_velocity() const {
  return !constraints_.layout().links.empty() || forces_.depends_on_velocity();
}

std::int32_t WorldDynamics::first_not_finite() const {
  const auto bad = [](const double* begin, std::size_t n) {
    return !std::all_of(begin, begin + n, [](double x) { return std::isfinite(x); });
  };
  const double *q = q_.data(), *v = v_.data();
  for (const std::uint32_t i : free_bodies()) {
    if (bad(q, kFreeCoordinates) || bad(v, kFreeVelocities)) return static_cast<std::int32_t>(i);
    q += kFreeCoordinates;
    v += kFreeVelocities;
  }
  const TreeLayout& layout = constraints_.layout();
  for (const Tree& tree : layout.trees) {
    if (bad(q + tree.q_begin, tree.q_end - tree.q_begin) ||
        bad(v + tree.v_begin, tree.v_end - tree.v_begin)) {
      return static_cast<std::int32_t>(layout.members[layout.links[tree.links_begin].members_begin].body);
    }
  }
  return -1;
}

bool WorldDynamics::is_at_rest(const Tree& tree, Instant at) {
  const TreeLayout& layout = constraints_.layout();
  constraints_.kernel().place(layout, tree, grounds_, at, bodies_.state.coordinates, bodies_.state.rates);
  for (std::uint32_t l = tree.links_begin; l < tree.links_end; ++l) {
    const LinkWork& link = constraints_.kernel().link(static_cast<std::int32_t>(l));
    if (dot(link.w, link.w) + dot(link.v, link.v) != 0) return false;
  }
  return true;
}

void WorldDynamics::write_back(double t) {
  const double *q = q_.data(), *v = v_.data();
  State& state = bodies_.state;
  for (const std::uint32_t i : free_bodies()) {
    const BodyState s = read(q, v);
    BodyState& old = state.bodies[i];
    if (s.p_WBcm != old.p_WBcm || s.q_WB.coeffs() != old.q_WB.coeffs() ||
        s.linear_momentum != old.linear_momentum || s.angular_momentum != old.angular_momentum) {
      old = s;
      bodies_.refresh(i);
    }
    q += kFreeCoordinates;
    v += kFreeVelocities;
  }
  const Instant end{t, Side::Before};
  for (std::size_t i = 0; has_animated_ && i < bodies_.size(); ++i) {
    if (bodies_.kinds[i] == BodyKind::Animated)
      bodies_.place(i, grounds_[i] = bodies_.drivers[i]->motion(t, end.side));
  }
  for (const Tree& tree : constraints_.layout().trees) {
    const bool same =
        std::equal(q + tree.q_begin, q + tree.q_end, state.coordinates.begin() + tree.q_begin) &&
        std::equal(v + tree.v_begin, v + tree.v_end, state.rates.begin() + tree.v_begin);
    if (same && (!tree.follows_driver || is_at_rest(tree, end))) continue;
    std::copy(q + tree.q_begin, q + tree.q_end, state.coordinates.begin() + tree.q_begin);
    std::copy(v + tree.v_begin, v + tree.v_end, state.rates.begin() + tree.v_begin);
    constraints_.commit(bodies_, tree, grounds_, end);
  }
}

void WorldDynamics::accelerations_now(std::vector<Wrench>& external, std::vector<Vector3>& alpha,
                                      std::vector<Vector3>& a_cm) {
  begin();
  error_rates_.resize(v_.size());
  evaluate({bodies_.state.time, Side::After}, coordinates_now(), velocities_now(), {}, error_rates_);
  external = wrenches_;
  alpha.assign(bodies_.size(), Vector3::Zero());
  a_cm.assign(bodies_.size(), Vector3::Zero());
  const TreeLayout& layout = constraints_.layout();
  const auto eigen = [](const kernel::Vec3<double>& x) { return Vector3{x.x, x.y, x.z}; };
  for (std::size_t l = 0; l < layout.links.size(); ++l) {
    const LinkWork& link = constraints_.kernel().link(static_cast<std::int32_t>(l));
    const Vector3 al = eigen(link.al + link.dal), a = eigen(link.a + link.da), w = eigen(link.w),
                  p = eigen(link.p);
    for (std::uint32_t m = layout.links[l].members_begin; m < layout.links[l].members_end; ++m) {
      const std::uint32_t i = layout.members[m].body;
      const Vector3 c = stage_[i].p_WBcm - p;
      alpha[i] = al;
      a_cm[i] = a + al.cross(c) + w.cross(w.cross(c));
    }
  }
}

}  // namespace pantin
