// Reaction of a joint: what the bodies on B's side need in order to move as they do, less what acts on them
// from outside (d'Alembert, summed over the side). Valid for every joint, also between bodies that are one
// for the solver. Joints that the solver has cut to make trees of loops act from outside too, by their
// multipliers.
#include <algorithm>
#include <unordered_set>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/world.hpp>

namespace pantin {

namespace {

/// The simulated bodies that hang together with `start` in the solver's trees when joint `cut` is taken away,
/// and whether one of them is held by ground.
struct JointSide {
  std::vector<BodyId> bodies{};
  bool grounded{false};
  [[nodiscard]] bool has(BodyId body) const {
    return body && std::find(bodies.begin(), bodies.end(), body) != bodies.end();
  }
};

JointSide side_of(const PhysicsManager& physics, const ConstraintManager& constraints, BodyId start,
                  JointId cut) {
  JointSide side;
  if (!start || physics.body(start).kind() != BodyKind::Simulated) {
    side.grounded = true;
    return side;
  }
  std::unordered_set<BodyId> seen{start};
  side.bodies.push_back(start);
  for (std::size_t next = 0; next < side.bodies.size(); ++next) {
    const BodyId body = side.bodies[next];
    for (const JointId id : physics.joints_of(body)) {
      if (id == cut || constraints.layout().closure_of_joint[constraints.at(id)] >= 0) continue;
      const JointDefinition& joint = physics.joint(id);
      const BodyId other = joint.a == body ? joint.b : joint.a;
      if (!other || physics.body(other).kind() != BodyKind::Simulated) {
        side.grounded = true;
      } else if (seen.insert(other).second) {
        side.bodies.push_back(other);
      }
    }
  }
  return side;
}

}  // namespace

Wrench PhysicsManager::reaction(JointId id) const {
  const ConstraintManager& constraints = impl_->constraints;
  const std::size_t position = constraints.at(id);
  const JointDefinition& joint = constraints.joint(position);
  impl_->constraints.prepare(impl_->bodies);
  const std::int32_t closure = constraints.layout().closure_of_joint[position];
  std::vector<Wrench> external;
  std::vector<Vector3> alpha, a_cm;
  impl_->guard.fit();
  if (impl_->guard.any()) impl_->guard.hold();
  impl_->dynamics.accelerations_now(external, alpha, a_cm);
  if (impl_->guard.any()) impl_->guard.let_go();
  if (closure >= 0) {
    const CutWrench cut = impl_->dynamics.cut_wrench(static_cast<std::uint32_t>(closure));
    return {cut.force, cut.torque};
  }
  const JointSide b_side = side_of(*this, constraints, joint.b, id);
  const bool use_a = b_side.grounded;
  const JointSide side = use_a ? side_of(*this, constraints, joint.a, id) : b_side;
  PANTIN_EXPECTS(!side.grounded, "joint '" + joint.name +
                                     "' is held from both sides by bodies that are not simulated: "
                                     "its reaction is not determined");
  const BodyStore& bodies = impl_->bodies;
  const Vector3 p_WJ = (bodies.X_WB(bodies.at(joint.b)) * joint.X_BJ).p;
  Wrench sum;
  for (const BodyId body : side.bodies) {
    const std::size_t i = bodies.at(body);
    const BodyKinematics& k = bodies.state.kinematics[i];
    const Matrix3 I = k.R_WB * bodies.mass[i].I_BBcm_B * k.R_WB.transpose();
    const Vector3 f = bodies.mass[i].mass * a_cm[i] - external[i].force;
    const Vector3 Iw = I * k.w_WB;
    const Vector3 t = I * alpha[i] + k.w_WB.cross(Iw) - external[i].torque;
    sum.force += f;
    sum.torque += t + (k.p_WBcm - p_WJ).cross(f);
  }
  for (std::uint32_t c = 0; c < constraints.layout().closures.size(); ++c) {
    // What a coupling does passes through its joints.
    if (constraints.layout().closures[c].coupling >= 0) continue;
    const JointDefinition& other =
        constraints.joint(static_cast<std::size_t>(constraints.layout().closures[c].joint));
    const double sign = (side.has(other.a) ? 1 : 0) - (side.has(other.b) ? 1 : 0);
    if (sign == 0) continue;
    const CutWrench cut = impl_->dynamics.cut_wrench(c);
    sum.force += sign * cut.force;
    sum.torque += sign * (cut.torque + (cut.p_WJ - p_WJ).cross(cut.force));
  }
  if (use_a) {
    sum.force *= -1;
    sum.torque *= -1;
  }
  return sum;
}

}  // namespace pantin
