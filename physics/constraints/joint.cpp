#include <pantin/physics/constraints/joint.hpp>

#include <algorithm>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/expects.hpp>

namespace pantin {

JointNumbers::JointNumbers(std::span<const double> numbers) : size_{static_cast<int>(numbers.size())} {
  PANTIN_EXPECTS(numbers.size() <= numbers_.size(),
                 "a joint has at most 7 numbers, not " + std::to_string(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), numbers_.begin());
}

JointNumbers::operator double() const {
  PANTIN_EXPECTS(size_ == 1, "only a joint with one number can be read as one; this one has " +
                                 std::to_string(size_) + ": use numbers()");
  return numbers_[0];
}

std::string_view to_string(JointKind kind) noexcept {
  std::string_view name;
  JointDefinition joint;
  joint.kind = kind;
  with_model(joint, [&name](auto model) { name = decltype(model)::kName; });
  return name;
}

int axis_count(JointKind kind) noexcept {
  int count = 0;
  JointDefinition joint;
  joint.kind = kind;
  with_model(joint, [&count](auto model) {
    using Model = decltype(model);
    if (Model::kCoordinates == Model::kRates) count = Model::kRates;
  });
  return count;
}

double angle_about_z(const Quaternion& q, double near) noexcept {
  const double angle = 2 * std::atan2(q.z(), q.w());
  return angle + 2 * M_PI * std::round((near - angle) / (2 * M_PI));
}

bool counts_turns(JointKind kind, int number) noexcept {
  switch (kind) {
    case JointKind::Pivot:
    case JointKind::Universal:
      return true;
    case JointKind::Cylindrical:
      return number == 0;
    case JointKind::Planar:
      return number == 2;
    default:
      return false;
  }
}

bool is_length(JointKind kind, int number) noexcept {
  return kind == JointKind::Slider || (kind == JointKind::Cylindrical && number == 1) ||
         (kind == JointKind::Planar && number < 2);
}

namespace {

bool is_rigid(const Pose& X) {
  return X.p.allFinite() && X.q.coeffs().allFinite() && std::abs(X.q.squaredNorm() - 1) < 1e-9;
}

JointDefinition defined(JointKind kind, auto& settings) {
  JointDefinition joint;
  joint.kind = kind;
  joint.name = std::move(settings.name);
  joint.a = settings.a;
  joint.b = settings.b;
  if constexpr (requires { settings.X_AJ; }) {
    joint.X_AJ = settings.X_AJ;
    joint.X_BJ = settings.X_BJ;
  }
  if constexpr (requires { settings.damping; }) joint.damping.fill(settings.damping);
  if constexpr (requires { settings.axis; }) joint.axes[0] = settings.axis;
  if constexpr (requires { settings.axes; })
    std::copy(settings.axes.begin(), settings.axes.end(), joint.axes.begin());
  if constexpr (requires { settings.strength; }) joint.strength = settings.strength;
  return joint;
}

std::optional<SettingsProblem> problem_with_axes(const JointDefinition& joint) {
  const std::string subject = std::string{to_string(joint.kind)} + " '" + joint.name + "'";
  const auto count = static_cast<std::size_t>(axis_count(joint.kind));
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    if (i >= count && !(joint.axes[i] == JointAxis{})) {
      return SettingsProblem{ProblemCode::OutOfRange,
                             subject + ": axis " + std::to_string(i) + " is set, of " + std::to_string(count),
                             "leave it at its default"};
    }
    const std::string number = count > 1 ? ", number " + std::to_string(i) : "";
    if (auto problem = problem_with(joint.axes[i], subject + number)) return problem;
  }
  return problem_with(joint.strength, subject);
}

}  // namespace

std::optional<SettingsProblem> problem_with(const JointDefinition& joint) {
  const std::string subject = std::string{to_string(joint.kind)} + " '" + joint.name + "': ";
  if (!joint.b) {
    return SettingsProblem{ProblemCode::UnknownEntity, subject + "b is null",
                           "b must be a body; only a may be the world"};
  }
  if (joint.a == joint.b) {
    return SettingsProblem{ProblemCode::ClosedLoop, subject + "a and b are the same body",
                           "join two different bodies"};
  }
  if (!is_rigid(joint.X_AJ) || !is_rigid(joint.X_BJ)) {
    return SettingsProblem{ProblemCode::NotUnit,
                           subject + "a joint frame is not finite or its quaternion is not unit",
                           "give finite positions and unit quaternions"};
  }
  for (const double damping : joint.damping) {
    if (damping >= 0 && std::isfinite(damping)) continue;
    return SettingsProblem{ProblemCode::OutOfRange, subject + "damping is " + std::to_string(damping),
                           "give a finite damping >= 0"};
  }
  if (!std::isfinite(joint.pitch)) {
    return SettingsProblem{ProblemCode::OutOfRange, subject + "pitch is not finite", "give metres per rad"};
  }
  if ((joint.kind == JointKind::Driven) != (joint.driver != nullptr)) {
    return SettingsProblem{ProblemCode::OutOfRange, subject + "a driven joint, and no other, has a driver",
                           "give the driver of the relative motion"};
  }
  if (joint.kind == JointKind::Free) {
    return SettingsProblem{ProblemCode::OutOfRange, subject + "a free joint holds nothing",
                           "leave the joint out"};
  }
  return problem_with_axes(joint);
}

JointDefinition define(PivotSettings settings) { return defined(JointKind::Pivot, settings); }
JointDefinition define(SliderSettings settings) { return defined(JointKind::Slider, settings); }
JointDefinition define(BallSettings settings) { return defined(JointKind::Ball, settings); }
JointDefinition define(FixedSettings settings) { return defined(JointKind::Fixed, settings); }
JointDefinition define(CylindricalSettings settings) {
  JointDefinition joint = defined(JointKind::Cylindrical, settings);
  joint.damping = {settings.angular_damping, settings.linear_damping, 0};
  joint.axes = {settings.angular, settings.linear, {}};
  return joint;
}
JointDefinition define(UniversalSettings settings) { return defined(JointKind::Universal, settings); }
JointDefinition define(PlanarSettings settings) {
  JointDefinition joint = defined(JointKind::Planar, settings);
  joint.damping = {settings.linear_damping, settings.linear_damping, settings.angular_damping};
  return joint;
}
JointDefinition define(ScrewSettings settings) {
  JointDefinition joint = defined(JointKind::Screw, settings);
  joint.pitch = settings.pitch;
  return joint;
}
JointDefinition define(DrivenSettings settings) {
  JointDefinition joint = defined(JointKind::Driven, settings);
  joint.driver = std::move(settings.driver);
  return joint;
}

}  // namespace pantin
