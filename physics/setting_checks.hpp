#pragma once
// Checks of single settings, the parts that every problem_with is put together from. Each gives nothing, or a
// problem that names subject, setting, value and rule.
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include <pantin/physics/pose.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

/// What a check speaks of: "damped spring", "stiffness", "N/m". The unit is empty for a pure number.
struct SettingName {
  std::string_view subject{};
  std::string_view setting{};
  std::string_view unit{};
};

/// Shortest text that reads back as the same number; vectors as "(x, y, z)", matrices row by row.
[[nodiscard]] std::string text_of(double value);
[[nodiscard]] std::string text_of(const Vector3& value);
[[nodiscard]] std::string text_of(const Matrix3& value);

/// NotFinite where a number is NaN or infinite.
[[nodiscard]] std::optional<SettingsProblem> must_be_finite(const SettingName& name, double value);
[[nodiscard]] std::optional<SettingsProblem> must_be_finite(const SettingName& name, const Vector3& value);
/// NotFinite, or OutOfRange where the number is < 0.
[[nodiscard]] std::optional<SettingsProblem> must_not_be_negative(const SettingName& name, double value);
/// NotFinite, or OutOfRange where the number is <= 0.
[[nodiscard]] std::optional<SettingsProblem> must_be_positive(const SettingName& name, double value);
/// NotFinite, or NotUnit where the length differs from 1 by more than 1e-9.
[[nodiscard]] std::optional<SettingsProblem> must_be_unit(const SettingName& name, const Quaternion& value);
[[nodiscard]] std::optional<SettingsProblem> must_be_unit(const SettingName& name, const Vector3& value);

/// The first problem of a list of checks; nothing where all hold.
[[nodiscard]] std::optional<SettingsProblem> first_problem(
    std::initializer_list<std::optional<SettingsProblem>> checks);

}  // namespace pantin
