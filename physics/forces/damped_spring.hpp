#pragma once
// A spring with damper between two points, along the line that joins them: tension = k (l - l0) + c dl/dt.
// Where the points coincide the line has no direction and the force is zero. Potential energy is k (l - l0)^2
// / 2.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct DampedSpring {
  Attachment a{}, b{};    ///< at least one of them on a body
  double stiffness{0};    ///< k [N/m], >= 0
  double damping{0};      ///< c [N s/m], >= 0
  double rest_length{0};  ///< l0 [m], >= 0
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const DampedSpring& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const DampedSpring& settings);

}  // namespace pantin
