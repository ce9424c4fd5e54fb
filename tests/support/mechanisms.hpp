#pragma once
// Small mechanisms that several physics tests use.
#include <functional>
#include <string>

#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/driven.hpp>
#include <pantin/physics/constraints/fixed.hpp>
#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/constraints/slider.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/physics_manager.hpp>

namespace pantin::test {

/// A box of 1 kg and different moments of inertia whose centre of gravity is not its origin.
inline MassProperties lopsided_mass(double mass = 1) {
  MassProperties m;
  m.mass = mass;
  m.p_BBcm = {0.1, -0.05, -0.2};
  m.I_BBcm_B = mass * Matrix3{{0.03, 0.004, 0.002}, {0.004, 0.02, -0.003}, {0.002, -0.003, 0.025}};
  return m;
}

/// A body that moves and turns about no axis of symmetry.
inline RigidBodySettings thrown_body() {
  RigidBodySettings s;
  s.name = "thrown";
  s.X_WB = {{1, 2, 3}, Quaternion{Eigen::AngleAxisd{0.7, Vector3{1, 2, -1}.normalized()}}};
  s.v_WBcm = {2, -1, 4};
  s.w_WB = {3, -5, 2};
  s.mass = lopsided_mass(2.5);
  return s;
}

/// Quaternion that turns z onto `axis`.
inline Quaternion facing(const Vector3& axis) { return Quaternion::FromTwoVectors(Vector3::UnitZ(), axis); }

/// Joint frames of two bodies for a joint at a world pose where they stand now.
template <class Settings>
Settings joint_here(const PhysicsManager& physics, BodyId a, BodyId b, const Pose& X_WJ,
                    std::string name = "joint") {
  Settings s;
  s.name = std::move(name);
  s.a = a;
  s.b = b;
  s.X_AJ = a ? inverse(physics.body(a).X_WB()) * X_WJ : X_WJ;
  s.X_BJ = inverse(physics.body(b).X_WB()) * X_WJ;
  return s;
}

/// A motion given by a function of time.
class FunctionDriver final : public Driver {
 public:
  using Motion = std::function<RigidMotion(double, Side)>;
  explicit FunctionDriver(Motion motion, std::function<double(double)> next = {})
      : motion_{std::move(motion)}, next_{std::move(next)} {}
  [[nodiscard]] RigidMotion motion(double t, Side side) const override { return motion_(t, side); }
  [[nodiscard]] double next_break(double t) const override {
    return next_ ? next_(t) : Driver::next_break(t);
  }

 private:
  Motion motion_;
  std::function<double(double)> next_;
};

/// Takes n steps of h; false as soon as one fails.
inline bool run(PhysicsManager& physics, double h, int n) {
  for (int i = 0; i < n; ++i) {
    if (!physics.step(h).ok()) return false;
  }
  return true;
}

/// Momentum and angular momentum about the world origin of all bodies.
struct Momenta {
  Vector3 linear{Vector3::Zero()}, angular{Vector3::Zero()};
};
inline Momenta momenta_of(const PhysicsManager& physics) {
  Momenta m;
  for (const BodyId id : physics.bodies()) {
    const RigidBody body = physics.body(id);
    m.linear += body.linear_momentum();
    m.angular += body.angular_momentum() + body.p_WBcm().cross(body.linear_momentum());
  }
  return m;
}

}  // namespace pantin::test
