#pragma once
// What joints of limited strength bear at the present state, all of them in one evaluation.
#include <span>
#include <vector>

#include <pantin/physics/body_store.hpp>
#include <pantin/physics/constraints/constraint_manager.hpp>

namespace pantin {

class WorldDynamics;

class JointWrenches {
 public:
  JointWrenches(BodyStore& bodies, ConstraintManager& constraints, WorldDynamics& dynamics)
      : bodies_{bodies}, constraints_{constraints}, dynamics_{dynamics} {}

  /// Whether some joint is of limited strength.
  [[nodiscard]] bool any() const;
  /// Evaluates the accelerations of now and the wrenches by which joints and cut joints make them.
  void evaluate();
  /// Of a joint of limited strength, after evaluate; nothing for joints between bodies that are one for the
  /// solver (Fixed), and for joints that move nothing.
  [[nodiscard]] const Wrench* of(std::size_t joint) const;
  /// Whether a wrench at J passes the joint's strength.
  [[nodiscard]] bool passes(std::size_t joint, const Wrench& load) const;

 private:
  void add_at(std::int32_t link, const Vector3& point, const Vector3& force, const Vector3& torque);
  void add_members(std::int32_t link);

  BodyStore& bodies_;
  ConstraintManager& constraints_;
  WorldDynamics& dynamics_;
  std::vector<Wrench> external_{}, of_link_{}, of_joint_{};
  std::vector<std::uint8_t> is_known_{};  ///< by joint
  std::vector<Vector3> alpha_{}, a_cm_{};
};

}  // namespace pantin
