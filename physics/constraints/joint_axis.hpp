#pragma once
// What acts along one number of a joint besides the loads on its bodies: a spring, the inertia of a rotor,
// dry friction, stops. The same struct serves every joint with numbers of its own; units go by the number,
// [rad] for angles and [m] for distances.
#include <limits>
#include <optional>
#include <string_view>

#include <pantin/physics/problem.hpp>

namespace pantin {

struct JointAxis {
  static constexpr double kUnlimited = std::numeric_limits<double>::infinity();

  double lower{-kUnlimited}, upper{kUnlimited};  ///< stops [rad or m], lower <= upper
  double restitution{0};                         ///< of a blow on a stop, 0 to 1
  double stiffness{0};                           ///< of a spring towards `rest` [N m/rad or N/m], >= 0
  double rest{0};                                ///< [rad or m]
  double armature{0};                            ///< inertia of a rotor, as felt here [kg m^2 or kg], >= 0
  double friction{0};                            ///< greatest dry (Coulomb) friction [N m or N], >= 0

  [[nodiscard]] bool has_stops() const noexcept { return lower > -kUnlimited || upper < kUnlimited; }
};
[[nodiscard]] bool operator==(const JointAxis& a, const JointAxis& b);

/// `subject` names the joint and the number, as in "pivot 'elbow'".
[[nodiscard]] std::optional<SettingsProblem> problem_with(const JointAxis& axis, std::string_view subject);

/// What a joint bears before it breaks: the force and the torque by which A holds B, at J.
struct JointStrength {
  static constexpr double kUnbreakable = std::numeric_limits<double>::infinity();

  double force{kUnbreakable};   ///< [N], > 0
  double torque{kUnbreakable};  ///< [N m], > 0

  [[nodiscard]] bool is_limited() const noexcept { return force < kUnbreakable || torque < kUnbreakable; }
};
[[nodiscard]] std::optional<SettingsProblem> problem_with(const JointStrength& strength,
                                                          std::string_view subject);

}  // namespace pantin
