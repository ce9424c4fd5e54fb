#pragma once
// Uniform gravity on all simulated bodies and all particles: F = m g at the centre of gravity.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct Gravity {
  Vector3 g_W{0, 0, -9.81};  ///< [m/s^2]; potential energy is zero at the world origin
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const Gravity& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const Gravity& settings);

}  // namespace pantin
