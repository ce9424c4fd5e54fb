#include <pantin/physics/world_dynamics.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

namespace {

constexpr std::size_t kFreeCoordinates = 7, kFreeVelocities = 6;

}  // namespace

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
  if (!room_.has_animated) return;
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
  for (const Tree& tree : layout_.trees) {
    kernel_.place(layout_, tree, grounds_, at, q.last(layout_.coordinates), v.last(layout_.rates));
    kernel_.write_members(layout_, tree, bodies_.mass, stage_);
  }
}

void WorldDynamics::tree_rates(std::span<const double> q, std::span<const double> v,
                               std::span<double> q_dot) const {
  const double* q0 = q.data() + (q.size() - layout_.coordinates);
  const double* v0 = v.data() + (v.size() - layout_.rates);
  double* out = q_dot.data() + (q_dot.size() - layout_.coordinates);
  for (const TreeLink& link : layout_.links) {
    with_model(link, [&](auto model) { model.rate(q0 + link.q, v0 + link.v, out + link.q); });
  }
}

BodiesAt WorldDynamics::bodies_at(Instant at) const {
  return {.t = at.t,
          .side = at.side,
          .kinematics = stage_,
          .mass = bodies_.mass,
          .kind = bodies_.kinds,
          .position_of = bodies_.position_of};
}

void WorldDynamics::gather_wrenches(Instant at) {
  if (bodies_.state.loaded) {
    for (std::size_t i = 0; i < wrenches_.size(); ++i) {
      wrenches_[i] = {bodies_.state.accumulators[i].force, bodies_.state.accumulators[i].torque};
    }
  } else {
    std::fill(wrenches_.begin(), wrenches_.end(), Wrench{});
  }
  const BodiesAt bodies = bodies_at(at);
  laws().gather(bodies, wrenches_);
  adjust_lines(bodies);
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
  loads_.write_efforts(layout_, {&at, 1}, q.data() + (q.size() - layout_.coordinates),
                       v.data() + (v.size() - layout_.rates), efforts_.data());
  for (const Tree& tree : layout_.trees) {
    kernel_.load(layout_, tree);
    for (std::uint32_t l = tree.links_begin; l < tree.links_end; ++l) {
      for (std::uint32_t m = layout_.links[l].members_begin; m < layout_.links[l].members_end; ++m) {
        const std::uint32_t i = layout_.members[m].body;
        kernel_.add_wrench(static_cast<std::int32_t>(l), wrenches_[i].force, wrenches_[i].torque,
                           stage_[i].p_WBcm);
      }
    }
    loads_.on_cut_joints(layout_, tree, kernel_, grounds_, at, cut_near_,
                         [this](auto link, const Vector3& force, const Vector3& torque, const Vector3& p_WQ) {
                           kernel_.add_wrench(link, force, torque, p_WQ);
                         });
    kernel_.eliminate(layout_, tree, v.last(layout_.rates), efforts_);
    kernel_.substitute(layout_, tree, v_dot.last(layout_.rates));
    if (!tree.has_closures()) continue;
    evaluate_loops(at, tree, q.last(layout_.coordinates), v.last(layout_.rates), v_dot.last(layout_.rates));
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
  const double* before = trees_before_.data();
  for (const TreeLink& link : layout_.links) {
    with_model(link, [&](auto model) {
      using Model = decltype(model);
      if (!std::equal(q + link.q, q + link.q + Model::kCoordinates, before + link.q))
        Model::normalise(q + link.q);
    });
  }
  if (has_constraints()) {
    settle_loops(at, q_all.last(layout_.coordinates), v_all.last(layout_.rates));
  }
}

bool WorldDynamics::acceleration_depends_on_velocity() const {
  return !layout_.links.empty() || laws().depends_on_velocity();
}

}  // namespace pantin
