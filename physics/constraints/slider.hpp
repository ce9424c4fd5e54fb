#pragma once
// Slider (prismatic joint): B moves along the z axis of joint frame J without turning.
#include <pantin/physics/constraints/joint.hpp>

namespace pantin {

/// Zero is where X_WA * X_AJ and X_WB * X_BJ coincide; positive along z, B relative to A. Value: distance [m].
struct SliderSettings {
  std::string name{};
  BodyId a{}, b{};             ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};         ///< J seen from the body origins
  double damping{0};           ///< [N s/m], >= 0
};
[[nodiscard]] JointDefinition define(SliderSettings settings);

}  // namespace pantin
