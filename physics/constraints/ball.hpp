#pragma once
// Ball (spherical joint): B turns freely about the origin of joint frame J.
#include <pantin/physics/constraints/joint.hpp>

namespace pantin {

/// Value: unit quaternion (w, x, y, z) of B's joint frame in A's; identity where the two coincide.
struct BallSettings {
  std::string name{};
  BodyId a{}, b{};             ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};         ///< J seen from the body origins
  double damping{0};           ///< [N m s/rad], >= 0
};
[[nodiscard]] JointDefinition define(BallSettings settings);

}  // namespace pantin
