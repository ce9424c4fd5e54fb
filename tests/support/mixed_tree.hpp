#pragma once
// A tree with many kinds of joints, and a chain with parts whose motion is given.
#include <cmath>
#include <string>
#include <vector>

#include <support/mechanisms.hpp>

#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/fixed.hpp>
#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/constraints/slider.hpp>
#include <pantin/physics/forces/gravity.hpp>

namespace pantin::test {

/// A tree with every joint kind, off its axes everywhere, on the world or floating.
inline PhysicsManager mixed_tree(bool floating) {
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  std::vector<BodyId> ids;
  for (int i = 0; i < 7; ++i) {
    RigidBodySettings s{.name = "b" + std::to_string(i), .X_WB = {{0.3 * i, 0.1 * (i % 3), 0}}};
    s.X_WB.q = Quaternion{Eigen::AngleAxisd{0.4 * i, Vector3{1, 1.0 * i, 2}.normalized()}};
    s.mass = lopsided_mass(1 + 0.3 * i);
    ids.push_back(physics.add(std::move(s)));
  }
  const auto at = [](double x, const Vector3& axis) { return Pose{{x, 0.05, 0.02}, facing(axis)}; };
  if (!floating)
    physics.add(joint_here<PivotSettings>(physics, BodyId{}, ids[0], at(-0.2, {1, 2, 0}), "base"));
  physics.add(joint_here<BallSettings>(physics, ids[0], ids[1], at(0.1, {1, 0, 1}), "ball"));
  physics.add(joint_here<SliderSettings>(physics, ids[2], ids[1], at(0.4, {0, 1, 1}), "slider"));
  physics.add(joint_here<FixedSettings>(physics, ids[2], ids[3], at(0.7, {0, 0, 1}), "weld"));
  physics.add(joint_here<PivotSettings>(physics, ids[3], ids[4], at(1.0, {1, 1, 1}), "elbow"));
  physics.add(joint_here<PivotSettings>(physics, ids[1], ids[5], at(1.3, {0, 1, 0}), "branch"));
  physics.add(joint_here<BallSettings>(physics, ids[6], ids[5], at(1.6, {0, 0, 1}), "tip"));
  return physics;
}

/// Turns about z by sin(2 t) and slides along x.
inline std::unique_ptr<Driver> swaying() {
  return std::make_unique<FunctionDriver>([](double t, Side) {
    RigidMotion m;
    m.X_AB = {{0.5 + 0.1 * t * t, 0, 0}, Quaternion{Eigen::AngleAxisd{std::sin(2 * t), Vector3::UnitZ()}}};
    m.v_AB = {0.2 * t, 0, 0};
    m.a_AB = {0.2, 0, 0};
    m.w_AB = {0, 0, 2 * std::cos(2 * t)};
    m.alpha_AB = {0, 0, -4 * std::sin(2 * t)};
    return m;
  });
}

/// An animated ground, a body on a pivot of it, a driven body on that, and one on a ball at its end.
inline PhysicsManager driven_chain() {
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  RigidBodySettings ground{.name = "ground", .kind = BodyKind::Animated};
  ground.driver = swaying();
  const BodyId g = physics.add(std::move(ground));
  const BodyId a =
      physics.add(RigidBodySettings{.name = "a", .X_WB = {{0.5, 0, 0}}, .mass = lopsided_mass(2)});
  const BodyId b = physics.add(RigidBodySettings{.name = "b", .X_WB = {{1, 0, 0}}, .mass = lopsided_mass(1)});
  const BodyId c =
      physics.add(RigidBodySettings{.name = "c", .X_WB = {{1.5, 0, 0}}, .mass = lopsided_mass(1)});
  physics.add(joint_here<PivotSettings>(physics, g, a, {{0.3, 0, 0}, facing({0, 1, 0.2})}));
  physics.add(DrivenSettings{.name = "arm", .a = a, .b = b, .driver = swaying()});
  physics.add(joint_here<BallSettings>(physics, b, c, {{1.2, 0, 0}, Quaternion::Identity()}));
  return physics;
}

}  // namespace pantin::test
