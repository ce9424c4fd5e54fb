#pragma once
// Wheels and pendulums on the ground, to be geared.
#include <string>
#include <vector>

#include <pantin/physics/constraints/gear.hpp>

#include "support/mechanisms.hpp"

namespace pantin::test {

/// Wheels on pivots about z, each in a tree of its own.
struct Wheels {
  PhysicsManager physics{};
  std::vector<BodyId> bodies{};
  std::vector<JointId> joints{};

  explicit Wheels(const std::vector<double>& inertias) {
    for (const double inertia : inertias) {
      const auto i = static_cast<double>(bodies.size());
      MassProperties m;
      m.mass = 1;
      m.I_BBcm_B = Vector3{inertia, inertia, inertia}.asDiagonal();
      const std::string name = "wheel " + std::to_string(bodies.size());
      bodies.push_back(physics.add(
          RigidBodySettings{.name = name, .X_WB = {{0.5 * i, 0, 0}, Quaternion::Identity()}, .mass = m}));
      joints.push_back(physics.add(joint_here<PivotSettings>(physics, BodyId{}, bodies.back(),
                                                             physics.body(bodies.back()).X_WB(), name)));
    }
  }
  CouplingId gear(std::size_t a, std::size_t b, double ratio, double offset = 0) {
    return physics.add(
        GearSettings{.name = "gear", .a = joints[a], .b = joints[b], .ratio = ratio, .offset = offset});
  }
  [[nodiscard]] double angle(std::size_t i) const { return physics.joint_value(joints[i]); }
};

/// Two pendulums that swing about y, the second one geared to the first; angle 0 hangs. They start at 1 rad
/// of the first, turning at 2 rad/s.
struct Pendulums {
  static constexpr double kG = 9.81, kLength[2] = {0.4, 0.7}, kMass[2] = {2, 1.1};
  PhysicsManager physics{};
  std::vector<JointId> joints{};
  CouplingId gear{};

  Pendulums(double ratio, double offset) {
    physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
    for (const int i : {0, 1}) {
      MassProperties m;
      m.mass = kMass[i];
      m.p_BBcm = {0, 0, -kLength[i]};
      m.I_BBcm_B = Vector3{0.05, 0.06, 0.02}.asDiagonal();
      const BodyId bob = physics.add(
          RigidBodySettings{.name = "bob", .X_WB = {{0, 1.0 * i, 0}, Quaternion::Identity()}, .mass = m});
      joints.push_back(physics.add(
          joint_here<PivotSettings>(physics, BodyId{}, bob, {{0, 1.0 * i, 0}, facing(Vector3::UnitY())})));
    }
    gear = physics.add(GearSettings{.a = joints[0], .b = joints[1], .ratio = ratio, .offset = offset});
    physics.set_joint_value(joints[0], 1);
    physics.set_joint_rate(joints[0], 2);
  }
  [[nodiscard]] double angle(std::size_t i) const { return physics.joint_value(joints[i]); }
  [[nodiscard]] static double inertia(std::size_t i) { return 0.06 + kMass[i] * kLength[i] * kLength[i]; }
  [[nodiscard]] static double weight(std::size_t i) { return kMass[i] * kG * kLength[i]; }
};

}  // namespace pantin::test
