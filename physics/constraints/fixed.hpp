#pragma once
// Fixed (weld): B does not move against A. Bodies joined so are one for the solver; each keeps its id, and the reaction
// between them can still be read.
#include <pantin/physics/constraints/joint.hpp>

namespace pantin {

struct FixedSettings {
  std::string name{};
  BodyId a{}, b{};             ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};         ///< J seen from the body origins
};
[[nodiscard]] JointDefinition define(FixedSettings settings);

}  // namespace pantin
