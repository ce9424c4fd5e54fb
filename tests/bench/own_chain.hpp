#pragma once
// The chains and the top in Pantin.
#include <pantin/physics/constraints/fixed.hpp>
#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/physics_manager.hpp>

#include "bench/chain.hpp"
#include "support/mechanisms.hpp"

namespace pantin::bench {

inline PhysicsManager build(const Chain& chain) {
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -kGravity}});
  BodyId up{};
  Pose X_WJ{};
  for (int i = 0; i < chain.links; ++i) {
    const Vector3 axis = turns_about_x(i) ? Vector3::UnitX() : Vector3::UnitY();
    X_WJ.q = (X_WJ.q * Quaternion{Eigen::AngleAxisd{start_angle(chain, i), axis}}).normalized();
    RigidBodySettings rod{.X_WB = X_WJ};
    const double mass = rod_mass(chain, i), across = inertia_across(mass);
    rod.mass.mass = mass;
    rod.mass.p_BBcm = {0, 0, -kRodLength / 2};
    rod.mass.I_BBcm_B = Vector3{across, across, inertia_along(mass)}.asDiagonal();
    const BodyId id = physics.add(std::move(rod));
    const Pose X_WA = X_WJ * Pose{Vector3::Zero(), test::facing(axis)};
    auto pivot = test::joint_here<PivotSettings>(physics, up, id, X_WA);
    if (i > 0) pivot.axis.stiffness = chain.stiffness, pivot.damping = chain.damping;
    if (std::isinf(pivot.axis.stiffness)) physics.add(test::joint_here<FixedSettings>(physics, up, id, X_WA));
    else physics.add(std::move(pivot));
    up = id;
    X_WJ.p = X_WJ * Vector3{0, 0, -kRodLength};
  }
  if (chain.spin != 0) physics.set_joint_rate(physics.joints().back(), chain.spin);
  return physics;
}

inline PhysicsManager build(const Top& top) {
  PhysicsManager physics;
  RigidBodySettings body;
  body.w_WB = {top.rate[0], top.rate[1], top.rate[2]};
  body.mass.mass = 1;
  body.mass.I_BBcm_B = Vector3{top.inertia[0], top.inertia[1], top.inertia[2]}.asDiagonal();
  physics.add(std::move(body));
  return physics;
}

}  // namespace pantin::bench
