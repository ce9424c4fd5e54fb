#include <pantin/physics/constraints/gear.hpp>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {

namespace {

std::optional<SettingsProblem> problem_with_end(const std::string& subject, const char* end,
                                                const JointDefinition& joint, int axis) {
  int numbers = 0;
  with_model(joint, [&](auto model) {
    using Model = decltype(model);
    numbers = Model::kCoordinates == Model::kRates ? Model::kCoordinates : 0;
  });
  const std::string name = std::string{to_string(joint.kind)} + " '" + joint.name + "'";
  if (numbers == 0) {
    return SettingsProblem{ProblemCode::OutOfRange,
                           subject + end + " is " + name + ", which has no angle or distance to couple",
                           "couple a pivot, slider, cylindrical, universal, planar or screw joint"};
  }
  if (axis >= 0 && axis < numbers) return std::nullopt;
  return SettingsProblem{ProblemCode::OutOfRange,
                         subject + "axis_" + end + " is " + std::to_string(axis) + ", but " + name + " has " +
                             std::to_string(numbers) + " number(s)",
                         "give an axis from 0 to " + std::to_string(numbers - 1)};
}

}  // namespace

std::optional<SettingsProblem> problem_with(const GearSettings& settings) {
  const std::string subject = "gear '" + settings.name + "'";
  if (!settings.a || !settings.b) {
    return SettingsProblem{ProblemCode::UnknownEntity, subject + ": " + (settings.a ? "b" : "a") + " is null",
                           "name the two joints to couple"};
  }
  if (settings.a == settings.b) {
    return SettingsProblem{ProblemCode::ClosedLoop, subject + ": a and b are the same joint",
                           "couple two different joints"};
  }
  return first_problem({must_be_finite({subject, "ratio"}, settings.ratio),
                        must_be_finite({subject, "offset"}, settings.offset)});
}

std::optional<SettingsProblem> problem_with(const GearSettings& settings, const JointDefinition& a,
                                            const JointDefinition& b) {
  const std::string subject = "gear '" + settings.name + "': ";
  return first_problem({problem_with(settings), problem_with_end(subject, "a", a, settings.axis_a),
                        problem_with_end(subject, "b", b, settings.axis_b)});
}

}  // namespace pantin
