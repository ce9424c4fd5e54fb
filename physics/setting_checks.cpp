#include <pantin/physics/setting_checks.hpp>

#include <array>
#include <charconv>
#include <cmath>

namespace pantin {
namespace {

constexpr double kUnitTolerance = 1e-9;

std::string text_with_unit(const std::string& value, std::string_view unit) {
  return unit.empty() ? value : value + " " + std::string{unit};
}

SettingsProblem problem(ProblemCode code, const SettingName& name, const std::string& value,
                        std::string_view rule) {
  return {code,
          std::string{name.subject} + ": " + std::string{name.setting} + " is " +
              text_with_unit(value, name.unit) + "; it must be " + std::string{rule},
          "give a " + std::string{name.setting} + " that is " + std::string{rule}};
}

}  // namespace

std::string text_of(double value) {
  std::array<char, 32> buffer{};
  const std::to_chars_result end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

std::string text_of(const Vector3& value) {
  std::string text = "(";
  text += text_of(value.x()) + ", " + text_of(value.y()) + ", " + text_of(value.z()) + ")";
  return text;
}

std::string text_of(const Matrix3& value) {
  std::string text = "[";
  text += text_of(Vector3{value.row(0)}) + ", " + text_of(Vector3{value.row(1)}) + ", " +
          text_of(Vector3{value.row(2)}) + "]";
  return text;
}

std::optional<SettingsProblem> must_be_finite(const SettingName& name, double value) {
  if (std::isfinite(value)) return std::nullopt;
  return problem(ProblemCode::NotFinite, name, text_of(value), "finite");
}

std::optional<SettingsProblem> must_be_finite(const SettingName& name, const Vector3& value) {
  if (value.allFinite()) return std::nullopt;
  return problem(ProblemCode::NotFinite, name, text_of(value), "finite");
}

std::optional<SettingsProblem> must_not_be_negative(const SettingName& name, double value) {
  if (!std::isfinite(value)) return must_be_finite(name, value);
  if (value >= 0) return std::nullopt;
  return problem(ProblemCode::OutOfRange, name, text_of(value), "zero or more");
}

std::optional<SettingsProblem> must_be_positive(const SettingName& name, double value) {
  if (!std::isfinite(value)) return must_be_finite(name, value);
  if (value > 0) return std::nullopt;
  return problem(ProblemCode::OutOfRange, name, text_of(value), "more than zero");
}

std::optional<SettingsProblem> must_be_unit(const SettingName& name, const Quaternion& value) {
  const bool finite = value.coeffs().allFinite();
  if (finite && std::abs(value.norm() - 1) <= kUnitTolerance) return std::nullopt;
  std::string text = "(";
  text += text_of(value.w()) + ", " + text_of(value.x()) + ", " + text_of(value.y()) + ", " +
          text_of(value.z()) + ")";
  if (!finite) return problem(ProblemCode::NotFinite, name, text, "finite");
  return problem(ProblemCode::NotUnit, name, text, "of unit length");
}

std::optional<SettingsProblem> must_be_unit(const SettingName& name, const Vector3& value) {
  if (!value.allFinite()) return must_be_finite(name, value);
  if (std::abs(value.norm() - 1) <= kUnitTolerance) return std::nullopt;
  return problem(ProblemCode::NotUnit, name, text_of(value), "of unit length");
}

std::optional<SettingsProblem> first_problem(std::initializer_list<std::optional<SettingsProblem>> checks) {
  for (const std::optional<SettingsProblem>& check : checks) {
    if (check) return check;
  }
  return std::nullopt;
}

}  // namespace pantin
