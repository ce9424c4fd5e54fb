#pragma once
// Slider (prismatic joint): B moves along the z axis of joint frame J without turning.
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

/// Zero is where X_WA * X_AJ and X_WB * X_BJ coincide; positive along z, B relative to A. Value: distance
/// [m].
struct SliderSettings {
  std::string name{};
  BodyId a{}, b{};      ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};  ///< J seen from the body origins
  double damping{0};    ///< [N s/m], >= 0
  JointAxis axis{};     ///< stops, spring, rotor, friction
  JointStrength strength{};
};
[[nodiscard]] JointDefinition define(SliderSettings settings);

/// Kernel form (see joint_models.hpp): q = distance, v = its rate.
struct SliderModel {
  static constexpr std::string_view kName = "slider";
  static constexpr int kCoordinates = 1, kRates = 1;

  template <class T>
  static void place(const T* q, kernel::Mat3<T>& R, kernel::Vec3<T>& p) {
    R = kernel::Mat3<T>::identity();
    p = {T(0), T(0), q[0]};
  }
  template <class T>
  static void columns(const kernel::Mat3<T>&, kernel::Vec3<T>* angular, kernel::Vec3<T>* linear) {
    angular[0] = {};
    linear[0] = {T(0), T(0), T(1)};
  }
  template <class T>
  static void rate(const T*, const T* v, T* q_dot) {
    q_dot[0] = v[0];
  }
  static void measure(const Pose& X_JaJb, double* q) { q[0] = X_JaJb.p.z(); }
  static void normalise(double*) {}
  static void reverse(double* q, double* v) {
    q[0] = -q[0];
    v[0] = -v[0];
  }
};

}  // namespace pantin
