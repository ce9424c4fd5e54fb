#pragma once
// A constant force and torque on one body, for as long as the law exists. For a force of one frame use
// PhysicsManager::apply_force. A force in world axes has the potential -F . p_WQ (zero at the world origin);
// a force in body axes and a torque have none.
#include <memory>
#include <optional>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

/// The axes in which a load keeps its direction.
enum class LoadAxes { World, Body };

struct ConstantLoad {
  BodyId body{};                    ///< must be alive
  Vector3 force{Vector3::Zero()};   ///< [N], in `axes`
  Vector3 torque{Vector3::Zero()};  ///< [N m], in `axes`, besides what the force makes at its point
  Vector3 p_BQ{Vector3::Zero()};    ///< where the force acts, from the body origin, in B [m]
  LoadAxes axes{LoadAxes::World};
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const ConstantLoad& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const ConstantLoad& settings);

}  // namespace pantin
