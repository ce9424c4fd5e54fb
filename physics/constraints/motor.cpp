#include <pantin/physics/constraints/motor.hpp>

#include <algorithm>
#include <string>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {

std::optional<SettingsProblem> problem_with(const MotorSettings& motor, std::string_view subject) {
  if (!(motor.limit >= 0)) {
    return SettingsProblem{ProblemCode::OutOfRange,
                           std::string{subject} + ": limit is " + text_of(motor.limit) + " N m or N",
                           "give a limit >= 0, infinite where there is none"};
  }
  return first_problem({must_be_finite({subject, "effort", "N m or N"}, motor.effort),
                        must_be_finite({subject, "value", "rad or m"}, motor.value),
                        must_be_finite({subject, "rate", "rad/s or m/s"}, motor.rate),
                        must_not_be_negative({subject, "stiffness", "N m/rad or N/m"}, motor.stiffness),
                        must_not_be_negative({subject, "damping", "N m s/rad or N s/m"}, motor.damping)});
}

double effort_of(const MotorSettings& motor, double t, Side side, double value, double rate) {
  MotorTarget target{motor.effort, motor.value, motor.rate};
  if (motor.path != nullptr) {
    const MotorTarget along = motor.path->target(t, side);
    target.effort += along.effort, target.value += along.value, target.rate += along.rate;
  }
  const double effort =
      target.effort + motor.stiffness * (target.value - value) + motor.damping * (target.rate - rate);
  return std::clamp(effort, -motor.limit, motor.limit);
}

}  // namespace pantin
