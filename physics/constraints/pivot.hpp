#pragma once
// Pivot (hinge): B turns about the z axis of joint frame J, all else is held.
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

/// Zero is where X_WA * X_AJ and X_WB * X_BJ coincide; right-hand sense, B relative to A. Value: angle [rad].
struct PivotSettings {
  std::string name{};
  BodyId a{}, b{};      ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};  ///< J seen from the body origins
  double damping{0};    ///< [N m s/rad], >= 0
  JointAxis axis{};     ///< stops, spring, rotor, friction
  JointStrength strength{};
};
[[nodiscard]] JointDefinition define(PivotSettings settings);

/// Kernel form (see joint_models.hpp): q = angle, v = its rate.
struct PivotModel {
  static constexpr std::string_view kName = "pivot";
  static constexpr int kCoordinates = 1, kRates = 1;

  template <class T>
  static void place(const T* q, kernel::Mat3<T>& R, kernel::Vec3<T>& p) {
    R = kernel::rotation_about_z(q[0]);
    p = {};
  }
  template <class T>
  static void columns(const kernel::Mat3<T>&, kernel::Vec3<T>* angular, kernel::Vec3<T>* linear) {
    angular[0] = {T(0), T(0), T(1)};
    linear[0] = {};
  }
  template <class T>
  static void rate(const T*, const T* v, T* q_dot) {
    q_dot[0] = v[0];
  }
  static void measure(const Pose& X_JaJb, double* q) { q[0] = angle_about_z(X_JaJb.q, q[0]); }
  static void normalise(double*) {}
  static void reverse(double* q, double* v) {
    q[0] = -q[0];
    v[0] = -v[0];
  }
};

}  // namespace pantin
