#pragma once
// Ball (spherical joint): B turns freely about the origin of joint frame J.
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

/// Value: unit quaternion (w, x, y, z) of B's joint frame in A's; identity where the two coincide.
struct BallSettings {
  std::string name{};
  BodyId a{}, b{};      ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};  ///< J seen from the body origins
  double damping{0};    ///< [N m s/rad], >= 0
  JointStrength strength{};
};
[[nodiscard]] JointDefinition define(BallSettings settings);

/// Kernel form (see joint_models.hpp): q = quaternion (w, x, y, z) of Jb in Ja, v = angular velocity in axes
/// of Jb.
struct BallModel {
  static constexpr std::string_view kName = "ball";
  static constexpr int kCoordinates = 4, kRates = 3;

  template <class T>
  static void place(const T* q, kernel::Mat3<T>& R, kernel::Vec3<T>& p) {
    R = kernel::rotation_of(q);
    p = {};
  }
  template <class T>
  static void columns(const kernel::Mat3<T>& R, kernel::Vec3<T>* angular, kernel::Vec3<T>* linear) {
    for (int j = 0; j < 3; ++j) {
      angular[j] = R.column(j);
      linear[j] = {};
    }
  }
  template <class T>
  static void rate(const T* q, const T* v, T* q_dot) {
    kernel::quaternion_rate_body(q, v, q_dot);
  }
  static void measure(const Pose& X_JaJb, double* q) {
    const Quaternion& m = X_JaJb.q;
    const double sign = m.w() * q[0] + m.x() * q[1] + m.y() * q[2] + m.z() * q[3] < 0 ? -1 : 1;
    q[0] = sign * m.w(), q[1] = sign * m.x(), q[2] = sign * m.y(), q[3] = sign * m.z();
  }
  static void normalise(double* q) { kernel::normalise_quaternion(q); }
  static void reverse(double* q, double* v) {
    // Angular velocity of Ja in Jb seen from Ja becomes that of Jb in Ja seen from Jb.
    const kernel::Vec3<double> w = kernel::rotation_of(q) * kernel::Vec3<double>{v[0], v[1], v[2]};
    v[0] = -w.x, v[1] = -w.y, v[2] = -w.z;
    q[1] = -q[1], q[2] = -q[2], q[3] = -q[3];
  }
};

}  // namespace pantin
