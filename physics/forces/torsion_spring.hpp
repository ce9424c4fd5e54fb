#pragma once
// A torsion spring with damper between two bodies, or a body and the world. It wants the attitude of B in A
// to be `q_AB` and pulls the shorter way there. Potential energy k angle^2 / 2; with damping it depends on
// velocity.
//
// Without an axis it resists every turn, by angle and axis of the rotation that leads from `q_AB` to now.
// With an axis it resists the turn about it alone (the twist of the swing-twist decomposition) and leaves B
// free to swing. A law knows no turns: beyond half a turn the nearer way is the other one, and the torque
// jumps.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct TorsionSpring {
  BodyId a{}, b{};                          ///< null = the world; not both
  Quaternion q_AB{Quaternion::Identity()};  ///< attitude of B in A without torque, unit
  std::optional<Vector3> axis_A{};          ///< unit, fixed in A; nothing = about all axes
  double stiffness{0};                      ///< k [N m/rad], >= 0
  double damping{0};                        ///< [N m s/rad], >= 0
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const TorsionSpring& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const TorsionSpring& settings);

}  // namespace pantin
