#pragma once
// Driven joint: the pose of B in A is a given function of time, its velocity and acceleration enter the
// elimination, and the mass of B keeps loading A. So an animated body hangs below a simulated one.
#include <pantin/physics/constraints/fixed.hpp>
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

struct DrivenSettings {
  std::string name{};
  BodyId a{}, b{};                   ///< a null = world; b must be a body
  std::unique_ptr<Driver> driver{};  ///< X_AB(t) of the body origins; not null
};
[[nodiscard]] JointDefinition define(DrivenSettings settings);

/// Kernel form (see joint_models.hpp): no coordinates; the kernel takes place, rate and acceleration from the
/// driver.
struct DrivenModel : FixedModel {
  static constexpr std::string_view kName = "driven";
};

}  // namespace pantin
