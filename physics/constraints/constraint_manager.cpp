// Trees and bodies: layout, measuring, projecting, writing back.
#include <pantin/physics/constraints/constraint_manager.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/expects.hpp>
#include <pantin/physics/stamp.hpp>

namespace pantin {

namespace {

/// Poses that miss their joints by less are left as they are: (relative to the distance from the origin).
constexpr double kSnapTolerance = 1e-9;

std::uint64_t stamp_of(const BodyStore& bodies, const std::vector<JointId>& joints,
                       const std::vector<CouplingId>& couplings) {
  std::uint64_t h = kStampSeed;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    h = stamped(stamped(stamped(h, bodies.ids[i].index), bodies.ids[i].generation),
                static_cast<std::uint64_t>(bodies.kinds[i]));
  }
  for (const JointId id : joints) h = stamped(stamped(h, id.index + 1ull), id.generation);
  for (const CouplingId id : couplings) h = stamped(stamped(h, ~std::uint64_t{id.index}), id.generation);
  return h;
}

/// q of the joint at zero, for joints never measured.
void zero(JointKind kind, double* q) {
  std::fill(q, q + kMostCoordinates, 0.0);
  if (kind == JointKind::Ball) q[0] = 1;
  if (kind == JointKind::Free) q[3] = 1;
}

}  // namespace

Pose ConstraintManager::link_pose(const BodyStore& bodies, const TreeLink& link) const {
  const TreeMember& first = layout_.members[link.members_begin];
  return bodies.X_WB(first.body) * inverse(first.X_LB);
}

void ConstraintManager::stale(const BodyStore& bodies) {
  if (stale_) return;
  for (std::size_t j = 0; j < joints_.size(); ++j) last_[j] = numbers(bodies, j);
  stale_ = true;
}

void ConstraintManager::measure(const BodyStore& bodies, const Tree& tree, std::vector<double>& q) const {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    const TreeLink& link = layout_.links[i];
    Pose X_WP;
    if (link.parent >= 0) {
      X_WP = link_pose(bodies, layout_.links[static_cast<std::size_t>(link.parent)]);
    } else if (link.ground >= 0) {
      X_WP = bodies.X_WB(static_cast<std::size_t>(link.ground));
    }
    const Pose X_JaJb = inverse(X_WP * link.X_PJ) * link_pose(bodies, link);
    with_model(link, [&](auto model) { model.measure(X_JaJb, q.data() + link.q); });
  }
}

void ConstraintManager::ground_motions(const BodyStore& bodies, Instant at,
                                       std::vector<RigidMotion>& out) const {
  out.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.kinds[i] == BodyKind::Animated) out[i] = bodies.drivers[i]->motion(at.t, at.side);
    if (bodies.kinds[i] == BodyKind::Static) out[i] = RigidMotion{.X_AB = bodies.X_WB(i)};
  }
}

void ConstraintManager::lay_out_anew(BodyStore& bodies) {
  State& state = bodies.state;
  std::vector<const JointDefinition*> joints;
  for (const auto& joint : joints_) joints.push_back(joint.get());
  layout_ = lay_out(bodies, joints, placed_couplings());
  ++layout_revision_;
  loads_.list(layout_, joints_, motors_);
  efforts_.assign(layout_.rates, 0.0);
  kernel_.resize(layout_);
  loops_.resize(layout_);
  open_.assign(layout_.trees.size(), {});
  state.topology = stamp_of(bodies, ids_, couplings_.ids());
  state.coordinates.assign(layout_.coordinates, 0.0);
  state.rates.assign(layout_.rates, 0.0);
  state.cut_coordinates.assign(kMostCoordinates * layout_.closures.size(), 0.0);
  zero_rates_.assign(layout_.rates, 0.0);
  state.edited.assign(layout_.trees.size(), 1);
  const auto last_of = [this](std::int32_t joint, JointKind kind) {
    Numbers near;
    zero(kind, near.q);
    const bool known = joint >= 0 && last_[static_cast<std::size_t>(joint)].known;
    return known ? last_[static_cast<std::size_t>(joint)] : near;
  };
  for (const TreeLink& link : layout_.links) {
    Numbers near = last_of(link.joint, link.kind);
    with_model(link, [&](auto model) {
      if (link.reversed) model.reverse(near.q, near.v);
      std::copy_n(near.q, decltype(model)::kCoordinates, state.coordinates.data() + link.q);
    });
  }
  for (std::size_t c = 0; c < layout_.closures.size(); ++c) {
    if (layout_.closures[c].coupling >= 0) continue;
    const Numbers near = last_of(layout_.closures[c].joint, layout_.closures[c].kind);
    std::copy_n(near.q, kMostCoordinates, state.cut_coordinates.data() + kMostCoordinates * c);
  }
  stale_ = false;
}

void ConstraintManager::measure_anew(BodyStore& bodies, std::size_t t, Instant now) {
  const Tree& tree = layout_.trees[t];
  measure(bodies, tree, bodies.state.coordinates);
  if (tree.has_closures()) reclose(bodies, t, grounds_, now);
  kernel_.place(layout_, tree, grounds_, now, bodies.state.coordinates, zero_rates_);
  bool missed = false;
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    const Pose X_WL = link_pose(bodies, layout_.links[i]);
    const LinkWork& work = kernel_.link(static_cast<std::int32_t>(i));
    const Vector3 p{work.p.x, work.p.y, work.p.z};
    const Matrix3 R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(work.R.m);
    missed = missed || (X_WL.p - p).norm() > kSnapTolerance * (1 + p.norm()) ||
             (X_WL.rotation() - R).norm() > kSnapTolerance;
  }
  if (missed) write_state(bodies, tree, true);
  measure_rotors(bodies, tree);
  measure_cut_joints(bodies, tree);
}

void ConstraintManager::prepare(BodyStore& bodies) {
  State& state = bodies.state;
  const Instant now{state.time, Side::After};
  if (stale_) {
    lay_out_anew(bodies);
    ground_motions(bodies, now, grounds_);
    for (std::size_t t = 0; t < layout_.trees.size(); ++t) measure_anew(bodies, t, now);
  } else if (std::find(state.edited.begin(), state.edited.end(), 1) != state.edited.end()) {
    ground_motions(bodies, now, grounds_);
  }
  for (std::size_t t = 0; t < layout_.trees.size(); ++t) {
    if (state.edited[t] == 0) continue;
    project(bodies, layout_.trees[t], grounds_, now);
    state.edited[t] = 0;
  }
}

void ConstraintManager::project(BodyStore& bodies, const Tree& tree, std::span<const RigidMotion> grounds,
                                Instant at) {
  State& state = bodies.state;
  keep_cut_rotors(bodies, tree, grounds, at);
  kernel_.place(layout_, tree, grounds, at, state.coordinates, zero_rates_);
  kernel_.load_momenta(layout_, tree, bodies.mass, state.bodies);
  kernel_.eliminate(layout_, tree, {}, rotor_momenta(state.rates));
  kernel_.substitute(layout_, tree, state.rates);
  if (tree.has_closures()) {
    // The impulses of cut joints belong to the same factor.
    kernel_.place(layout_, tree, grounds, at, state.coordinates, state.rates);
    ClosureSolver& solver = loops_.solver();
    solver.measure(layout_, tree, kernel_, grounds, at, {state.coordinates, state.rates, {}});
    solver.compare_rotor_rates(tree);
    solver.factor(layout_, tree, kernel_);
    solver.solve(layout_, tree, ClosureLevel::Velocity, kernel_);
    kernel_.substitute(layout_, tree, state.rates);
  }
  bool finite = true;
  for (std::uint32_t v = tree.v_begin; v < tree.v_end; ++v) finite = finite && std::isfinite(state.rates[v]);
  if (!finite) {  // a joint without inertia: the step will say which
    std::fill(state.rates.begin() + tree.v_begin, state.rates.begin() + tree.v_end, 0.0);
  }
  kernel_.place(layout_, tree, grounds, at, state.coordinates, state.rates);
  write_state(bodies, tree, false);
}

void ConstraintManager::commit(BodyStore& bodies, const Tree& tree, std::span<const RigidMotion> grounds,
                               Instant at) {
  kernel_.place(layout_, tree, grounds, at, bodies.state.coordinates, bodies.state.rates);
  write_state(bodies, tree, true);
  measure_cut_joints(bodies, tree);
}

void ConstraintManager::write_state(BodyStore& bodies, const Tree& tree, bool poses) const {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    const LinkWork& work = kernel_.link(static_cast<std::int32_t>(i));
    const Matrix3 R_WL = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(work.R.m);
    const Quaternion q_WL{R_WL};
    const Vector3 p{work.p.x, work.p.y, work.p.z}, v{work.v.x, work.v.y, work.v.z},
        w{work.w.x, work.w.y, work.w.z};
    for (std::uint32_t m = layout_.links[i].members_begin; m < layout_.links[i].members_end; ++m) {
      const TreeMember& member = layout_.members[m];
      const Pose X_WB = poses ? Pose{p + R_WL * member.X_LB.p, (q_WL * member.X_LB.q).normalized()}
                              : bodies.X_WB(member.body);
      const Vector3 c = R_WL * (member.X_LB * bodies.mass[member.body].p_BBcm);
      const BodyState before = bodies.state.bodies[member.body];
      bodies.place(member.body, X_WB, v + w.cross(c), w);
      BodyState& after = bodies.state.bodies[member.body];
      if (!poses) {
        after.p_WBcm = before.p_WBcm;
        bodies.state.kinematics[member.body].p_WBcm = before.p_WBcm;
      } else if (after.q_WB.dot(before.q_WB) < 0) {
        after.q_WB.coeffs() *= -1;
      }
    }
  }
}

}  // namespace pantin
