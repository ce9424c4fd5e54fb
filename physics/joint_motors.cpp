// Motors, as the manager of everything is asked for them.
#include <string>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/world.hpp>

namespace pantin {

namespace {

/// Position of a joint that has the axis.
std::size_t joint_with(const ConstraintManager& constraints, JointId id, int axis) {
  const std::size_t j = constraints.at(id);
  const JointDefinition& joint = constraints.joint(j);
  const int count = axis_count(joint.kind);
  PANTIN_EXPECTS(axis >= 0 && axis < count, std::string{to_string(joint.kind)} + " '" + joint.name +
                                                "' has no axis " + std::to_string(axis) +
                                                " for a motor, only " + std::to_string(count) +
                                                ", counted from 0");
  return j;
}

}  // namespace

void PhysicsManager::set_motor(JointId id, const MotorSettings& motor, int axis) {
  const std::size_t j = joint_with(impl_->constraints, id, axis);
  const JointDefinition& joint = impl_->constraints.joint(j);
  const auto problem =
      problem_with(motor, "motor on " + std::string{to_string(joint.kind)} + " '" + joint.name + "'");
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
  impl_->constraints.set_motor(j, axis, motor);
}

void PhysicsManager::clear_motor(JointId id, int axis) {
  impl_->constraints.clear_motor(joint_with(impl_->constraints, id, axis), axis);
}

std::optional<MotorSettings> PhysicsManager::motor(JointId id, int axis) const {
  return impl_->constraints.motor(joint_with(impl_->constraints, id, axis), axis);
}

JointNumbers PhysicsManager::joint_effort(JointId id) const {
  return impl_->constraints.effort(impl_->bodies, impl_->constraints.at(id));
}

}  // namespace pantin
