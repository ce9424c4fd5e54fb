#pragma once
// Screw: B turns about the z axis of joint frame J and thereby moves along it.
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

/// Zero is where X_WA * X_AJ and X_WB * X_BJ coincide; B relative to A. Value: angle [rad], right-hand sense;
/// B's joint origin is at pitch * angle on the axis.
struct ScrewSettings {
  std::string name{};
  BodyId a{}, b{};      ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};  ///< J seen from the body origins
  double pitch{0};      ///< [m/rad], positive for a right-handed thread; 0 makes a pivot
  double damping{0};    ///< on the angle [N m s/rad], >= 0
  JointAxis axis{};     ///< stops, spring, rotor, friction, on the angle
  JointStrength strength{};
};
[[nodiscard]] JointDefinition define(ScrewSettings settings);

/// Kernel form (see joint_models.hpp): q = angle, v = its rate.
struct ScrewModel {
  static constexpr std::string_view kName = "screw";
  static constexpr int kCoordinates = 1, kRates = 1;
  double pitch{0};  ///< [m/rad]

  template <class T>
  void place(const T* q, kernel::Mat3<T>& R, kernel::Vec3<T>& p) const {
    R = kernel::rotation_about_z(q[0]);
    p = {T(0), T(0), T(pitch) * q[0]};
  }
  template <class T>
  void columns(const kernel::Mat3<T>&, kernel::Vec3<T>* angular, kernel::Vec3<T>* linear) const {
    angular[0] = {T(0), T(0), T(1)};
    linear[0] = {T(0), T(0), T(pitch)};
  }
  template <class T>
  static void rate(const T*, const T* v, T* q_dot) {
    q_dot[0] = v[0];
  }
  /// The angle of the rotation, in the turn that the distance along the axis tells (without pitch: nearest to
  /// q).
  void measure(const Pose& X_JaJb, double* q) const {
    const double z = X_JaJb.p.z();
    const bool tells = std::abs(pitch) > 1e-12 * std::max(1.0, std::abs(z));
    q[0] = angle_about_z(X_JaJb.q, tells ? z / pitch : q[0]);
  }
  static void normalise(double*) {}
  static void reverse(double* q, double* v) { q[0] = -q[0], v[0] = -v[0]; }
};

}  // namespace pantin
