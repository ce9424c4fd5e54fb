// As in reaction.cpp, but for all joints at once: what a link and all it carries need in order to move as
// they do, less what acts on them from outside, summed from the leaves.
#include <pantin/physics/stops/joint_wrenches.hpp>

#include <algorithm>

#include <pantin/physics/world.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

namespace {

Vector3 origin_of(const LinkWork& link) { return {link.p.x, link.p.y, link.p.z}; }

}  // namespace

bool JointWrenches::any() const {
  for (std::size_t j = 0; j < constraints_.size(); ++j) {
    if (constraints_.joint(j).strength.is_limited()) return true;
  }
  return false;
}

void JointWrenches::add_at(std::int32_t link, const Vector3& point, const Vector3& force,
                           const Vector3& torque) {
  Wrench& sum = of_link_[static_cast<std::size_t>(link)];
  sum.force += force;
  sum.torque += torque + (point - origin_of(constraints_.kernel().link(link))).cross(force);
}

void JointWrenches::add_members(std::int32_t link) {
  const TreeLayout& layout = constraints_.layout();
  const TreeLink& l = layout.links[static_cast<std::size_t>(link)];
  for (std::uint32_t m = l.members_begin; m < l.members_end; ++m) {
    const std::uint32_t i = layout.members[m].body;
    const BodyKinematics& k = bodies_.state.kinematics[i];
    const Matrix3 I = k.R_WB * bodies_.mass[i].I_BBcm_B * k.R_WB.transpose();
    const Vector3 spin = I * k.w_WB;
    add_at(link, k.p_WBcm, bodies_.mass[i].mass * a_cm_[i] - external_[i].force,
           I * alpha_[i] + k.w_WB.cross(spin) - external_[i].torque);
  }
}

void JointWrenches::evaluate() {
  const TreeLayout& layout = constraints_.layout();
  dynamics_.accelerations_now(external_, alpha_, a_cm_);
  of_link_.assign(layout.links.size(), Wrench{});
  of_joint_.assign(constraints_.size(), Wrench{});
  is_known_.assign(constraints_.size(), 0);
  const auto keep = [&](std::int32_t joint, const Wrench& on_link, const Vector3& at, bool reversed) {
    const auto j = static_cast<std::size_t>(joint);
    const JointDefinition& definition = constraints_.joint(j);
    const Vector3 p_WJ = (bodies_.X_WB(bodies_.at(definition.b)) * definition.X_BJ).p;
    const double sense = reversed ? -1 : 1;
    of_joint_[j] = {sense * on_link.force, sense * (on_link.torque + (at - p_WJ).cross(on_link.force))};
    is_known_[j] = 1;
  };
  for (std::uint32_t c = 0; c < layout.closures.size(); ++c) {
    if (layout.closures[c].coupling >= 0) continue;  // what a coupling does passes through its joints
    const CutWrench cut = dynamics_.cut_wrench(c);
    const Closure& closure = layout.closures[c];
    if (closure.b.link >= 0) add_at(closure.b.link, cut.p_WJ, -cut.force, -cut.torque);
    if (closure.a.link >= 0) add_at(closure.a.link, cut.p_WJ, cut.force, cut.torque);
    keep(closure.joint, {cut.force, cut.torque}, cut.p_WJ, false);
  }
  for (auto l = static_cast<std::int32_t>(layout.links.size()); l-- > 0;) {
    const TreeLink& link = layout.links[static_cast<std::size_t>(l)];
    add_members(l);
    const Wrench sum = of_link_[static_cast<std::size_t>(l)];
    const Vector3 at = origin_of(constraints_.kernel().link(l));
    if (link.parent >= 0) add_at(link.parent, at, sum.force, sum.torque);
    if (link.joint >= 0) keep(link.joint, sum, at, link.reversed);
  }
}

const Wrench* JointWrenches::of(std::size_t joint) const {
  return is_known_[joint] != 0 ? &of_joint_[joint] : nullptr;
}

bool JointWrenches::passes(std::size_t joint, const Wrench& load) const {
  const JointStrength& strength = constraints_.joint(joint).strength;
  return load.force.norm() > strength.force || load.torque.norm() > strength.torque;
}

void PhysicsManager::Impl::find_overloaded(const PhysicsManager& physics, std::vector<JointId>& out) {
  if (!wrenches.any()) return;
  constraints.prepare(bodies);
  if (guard.any()) guard.hold();
  wrenches.evaluate();
  if (guard.any()) guard.let_go();
  for (std::size_t j = 0; j < constraints.size(); ++j) {
    const JointDefinition& joint = constraints.joint(j);
    if (!joint.strength.is_limited()) continue;
    const auto is_simulated = [&](BodyId id) {
      return id && bodies.kinds[bodies.at(id)] == BodyKind::Simulated;
    };
    const Wrench* load = wrenches.of(j);
    if (load == nullptr && !is_simulated(joint.a) && !is_simulated(joint.b)) continue;
    // Inside of what is one body for the solver, a joint at a time.
    if (wrenches.passes(j, load != nullptr ? *load : physics.reaction(constraints.id(j)))) {
      out.push_back(constraints.id(j));
    }
  }
}

}  // namespace pantin
