#pragma once
// Pivot (hinge): B turns about the z axis of joint frame J, all else is held.
#include <pantin/physics/constraints/joint.hpp>

namespace pantin {

/// Zero is where X_WA * X_AJ and X_WB * X_BJ coincide; right-hand sense, B relative to A. Value: angle [rad].
struct PivotSettings {
  std::string name{};
  BodyId a{}, b{};             ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};         ///< J seen from the body origins
  double damping{0};           ///< [N m s/rad], >= 0
};
[[nodiscard]] JointDefinition define(PivotSettings settings);

}  // namespace pantin
