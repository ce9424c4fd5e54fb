#include <pantin/physics/constraints/joint_axis.hpp>

#include <string>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {

bool operator==(const JointAxis& a, const JointAxis& b) {
  return a.lower == b.lower && a.upper == b.upper && a.restitution == b.restitution &&
         a.stiffness == b.stiffness && a.rest == b.rest && a.armature == b.armature &&
         a.friction == b.friction;
}

std::optional<SettingsProblem> problem_with(const JointAxis& axis, std::string_view subject) {
  if (!(axis.lower <= axis.upper)) {
    return SettingsProblem{ProblemCode::OutOfRange,
                           std::string{subject} + ": stops from " + text_of(axis.lower) + " to " +
                               text_of(axis.upper) + " leave no room",
                           "give lower <= upper, infinite where there is no stop"};
  }
  if (!(axis.restitution >= 0 && axis.restitution <= 1)) {
    return SettingsProblem{ProblemCode::OutOfRange,
                           std::string{subject} + ": restitution is " + text_of(axis.restitution),
                           "give 0 (no bounce) to 1 (no loss)"};
  }
  return first_problem({must_not_be_negative({subject, "stiffness", "N m/rad or N/m"}, axis.stiffness),
                        must_be_finite({subject, "rest", "rad or m"}, axis.rest),
                        must_not_be_negative({subject, "armature", "kg m^2 or kg"}, axis.armature),
                        must_not_be_negative({subject, "friction", "N m or N"}, axis.friction)});
}

std::optional<SettingsProblem> problem_with(const JointStrength& strength, std::string_view subject) {
  if (strength.force > 0 && strength.torque > 0) return std::nullopt;
  return SettingsProblem{ProblemCode::OutOfRange,
                         std::string{subject} + ": strength is " + text_of(strength.force) + " N and " +
                             text_of(strength.torque) + " N m",
                         "give a force and a torque above zero, infinite for a joint that does not break"};
}

}  // namespace pantin
