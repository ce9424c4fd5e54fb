#pragma once
// Cylindrical joint: B turns about the z axis of joint frame J and moves along it, each by itself.
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

/// Zero is where X_WA * X_AJ and X_WB * X_BJ coincide; B relative to A, right-hand sense, positive along z.
/// Value: angle [rad], distance [m].
struct CylindricalSettings {
  std::string name{};
  BodyId a{}, b{};                ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};            ///< J seen from the body origins
  double angular_damping{0};      ///< [N m s/rad], >= 0
  double linear_damping{0};       ///< [N s/m], >= 0
  JointAxis angular{}, linear{};  ///< stops, spring, rotor, friction
  JointStrength strength{};
};
[[nodiscard]] JointDefinition define(CylindricalSettings settings);

/// Kernel form (see joint_models.hpp): q = angle, distance; v = their rates.
struct CylindricalModel {
  static constexpr std::string_view kName = "cylindrical";
  static constexpr int kCoordinates = 2, kRates = 2;

  template <class T>
  static void place(const T* q, kernel::Mat3<T>& R, kernel::Vec3<T>& p) {
    R = kernel::rotation_about_z(q[0]);
    p = {T(0), T(0), q[1]};
  }
  template <class T>
  static void columns(const kernel::Mat3<T>&, kernel::Vec3<T>* angular, kernel::Vec3<T>* linear) {
    angular[0] = {T(0), T(0), T(1)}, linear[0] = {};
    angular[1] = {}, linear[1] = {T(0), T(0), T(1)};
  }
  template <class T>
  static void rate(const T*, const T* v, T* q_dot) {
    q_dot[0] = v[0], q_dot[1] = v[1];
  }
  static void measure(const Pose& X_JaJb, double* q) {
    q[0] = angle_about_z(X_JaJb.q, q[0]);
    q[1] = X_JaJb.p.z();
  }
  static void normalise(double*) {}
  static void reverse(double* q, double* v) {
    for (int i = 0; i < 2; ++i) q[i] = -q[i], v[i] = -v[i];
  }
};

}  // namespace pantin
