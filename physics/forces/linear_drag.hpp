#pragma once
// Drag proportional to the velocity against a medium: F = -c (v_WBcm - u), T = -k w_WB.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct LinearDrag {
  BodyId body{};                              ///< null = every simulated body
  double coefficient{0};                      ///< c [N s/m], >= 0
  double angular_coefficient{0};              ///< k [N m s/rad], >= 0
  Vector3 medium_velocity{Vector3::Zero()};   ///< u, in W [m/s]
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const LinearDrag& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const LinearDrag& settings);

}  // namespace pantin
