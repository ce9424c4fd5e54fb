// What is asked of numbers with stops and friction between steps.
#include <pantin/physics/expects.hpp>
#include <pantin/physics/world.hpp>

namespace pantin {

namespace {

std::size_t axis_of(const JointDefinition& joint, int axis) {
  PANTIN_EXPECTS(axis >= 0 && axis < static_cast<int>(joint.axes.size()),
                 "joint '" + joint.name + "' has no number " + std::to_string(axis) + "; give 0, 1 or 2");
  return static_cast<std::size_t>(axis);
}

}  // namespace

AxisMode PhysicsManager::axis_mode(JointId id, int axis) const {
  const std::size_t j = impl_->constraints.at(id);
  static_cast<void>(axis_of(impl_->constraints.joint(j), axis));
  const std::vector<AxisMode>& modes = impl_->bodies.state.axis_modes;
  const std::optional<std::size_t> found = impl_->guard.find(j, axis);
  return found && *found < modes.size() ? modes[*found] : AxisMode::Free;
}

double PhysicsManager::axis_effort(JointId id, int axis) const {
  Impl& world = *impl_;
  const std::size_t j = world.constraints.at(id);
  static_cast<void>(axis_of(world.constraints.joint(j), axis));
  world.constraints.prepare(world.bodies);
  world.guard.fit();
  const std::optional<std::size_t> found = world.guard.find(j, axis);
  if (!found) return 0;
  const Impl::Moving now = world.begin_update();
  const GuardedMotion motion{*now.system, {time(), Side::After}, now.q, now.v};
  const double effort = world.guard.efforts(motion)[*found];
  world.guard.let_go();
  if (now.coupled) world.particles.bodies_have_moved();
  return world.guard.axes()[*found].sense * effort;
}

std::vector<std::pair<JointId, int>> PhysicsManager::unguarded_axes() const {
  ConstraintManager& constraints = impl_->constraints;
  constraints.prepare(impl_->bodies);
  std::vector<const JointDefinition*> joints;
  for (std::size_t j = 0; j < constraints.size(); ++j) joints.push_back(&constraints.joint(j));
  std::vector<std::pair<JointId, int>> out;
  for (const auto& [joint, axis] : pantin::unguarded_axes(constraints.layout(), joints)) {
    out.emplace_back(constraints.id(joint), axis);
  }
  return out;
}

std::span<const JointEvent> PhysicsManager::joint_events() const noexcept { return impl_->guard.events; }

}  // namespace pantin
