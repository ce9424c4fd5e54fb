#pragma once
// What all joints share: how one is described to the constraint manager, and the numbers that say where it
// stands. To add a joint kind: one header like pivot.hpp (settings, problem_with, define, and a model for the
// kernel), its name in JointKind and its line in joint_models.hpp.
#include <array>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <pantin/physics/constraints/joint_axis.hpp>
#include <pantin/physics/driver.hpp>
#include <pantin/physics/ids.hpp>
#include <pantin/physics/pose.hpp>
#include <pantin/physics/problem.hpp>
#include <pantin/physics/step_report.hpp>

namespace pantin {

/// In the order of JointModels (joint_models.hpp).
enum class JointKind : std::uint8_t {
  Pivot,
  Slider,
  Ball,
  Fixed,
  Cylindrical,
  Universal,
  Planar,
  Screw,
  Driven,
  Free,
};
/// The kind in lower case: "pivot", "slider", ...
[[nodiscard]] std::string_view to_string(JointKind kind) noexcept;

/// The coordinates or rates of a joint: at most seven numbers; one number converts to double.
class JointNumbers {
 public:
  JointNumbers() = default;
  JointNumbers(double number) : numbers_{number}, size_{1} {}  // NOLINT: a pivot's angle is its coordinates
  JointNumbers(std::initializer_list<double> numbers)
      : JointNumbers(std::span{numbers.begin(), numbers.size()}) {}
  explicit JointNumbers(std::span<const double> numbers);  ///< at most 7

  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] double operator[](int i) const { return numbers_.at(static_cast<std::size_t>(i)); }
  [[nodiscard]] double& operator[](int i) { return numbers_.at(static_cast<std::size_t>(i)); }
  [[nodiscard]] std::span<const double> numbers() const noexcept {
    return {numbers_.data(), static_cast<std::size_t>(size_)};
  }
  operator double() const;  // NOLINT: for joints with one number; the contract says so

 private:
  std::array<double, 7> numbers_{};
  int size_{0};
};

/// A joint as the constraint manager takes it; made by define(settings).
struct JointDefinition {
  JointKind kind{JointKind::Fixed};
  std::string name{};
  BodyId a{}, b{};                  ///< a null = the world
  Pose X_AJ{}, X_BJ{};              ///< J seen from the body origins (from the world where a is null)
  std::array<double, 3> damping{};  ///< viscous, by rate, >= 0 [N m s/rad] or [N s/m]
  std::array<JointAxis, 3> axes{};  ///< by rate; none for Ball, Fixed, Driven
  JointStrength strength{};
  double pitch{0};                   ///< [m/rad]; Screw only
  std::unique_ptr<Driver> driver{};  ///< Driven only: X_AB(t)
};

/// How many numbers of a kind have an axis of their own, with stops, springs, rotors and motors: those whose
/// rates are their derivatives. None of Ball, Fixed, Driven, Free.
[[nodiscard]] int axis_count(JointKind kind) noexcept;

/// Checks shared by all joints: finite frames, unit quaternions, b given, a != b, damping >= 0, finite pitch.
[[nodiscard]] std::optional<SettingsProblem> problem_with(const JointDefinition& joint);

/// The angle about z [rad] of the rotation about z nearest to q, in the turn nearest to `near`.
[[nodiscard]] double angle_about_z(const Quaternion& q, double near) noexcept;

/// Whether whole turns of this number of a joint cannot be seen in poses.
[[nodiscard]] bool counts_turns(JointKind kind, int number) noexcept;
/// Whether this number of a joint is a distance [m]; others are angles.
[[nodiscard]] bool is_length(JointKind kind, int number) noexcept;

/// X_JaJb of a joint that is not driven, at coordinates `value` (as many as it has; quaternions of any length
/// but 0).
[[nodiscard]] Pose joint_pose(const JointDefinition& joint, const JointNumbers& value);

/// How far X_JaJb is from the poses that a joint, not driven, allows: from that of the coordinates measured
/// there.
[[nodiscard]] JointDrift joint_miss(const JointDefinition& joint, const Pose& X_JaJb);

}  // namespace pantin
