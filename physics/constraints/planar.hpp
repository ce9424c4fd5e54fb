#pragma once
// Planar joint: B slides in the x-y plane of joint frame J and turns about z.
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

/// Zero is where X_WA * X_AJ and X_WB * X_BJ coincide; B relative to A. Value: x, y of B's joint origin in
/// A's joint frame [m], angle about z [rad].
struct PlanarSettings {
  std::string name{};
  BodyId a{}, b{};                  ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};              ///< J seen from the body origins
  double linear_damping{0};         ///< along x and y [N s/m], >= 0
  double angular_damping{0};        ///< [N m s/rad], >= 0
  std::array<JointAxis, 3> axes{};  ///< of x, y, angle: stops, spring, rotor, friction
  JointStrength strength{};
};
[[nodiscard]] JointDefinition define(PlanarSettings settings);

/// Kernel form (see joint_models.hpp): q = x, y, angle; v = their rates.
struct PlanarModel {
  static constexpr std::string_view kName = "planar";
  static constexpr int kCoordinates = 3, kRates = 3;

  template <class T>
  static void place(const T* q, kernel::Mat3<T>& R, kernel::Vec3<T>& p) {
    R = kernel::rotation_about_z(q[2]);
    p = {q[0], q[1], T(0)};
  }
  template <class T>
  static void columns(const kernel::Mat3<T>&, kernel::Vec3<T>* angular, kernel::Vec3<T>* linear) {
    angular[0] = {}, linear[0] = {T(1), T(0), T(0)};
    angular[1] = {}, linear[1] = {T(0), T(1), T(0)};
    angular[2] = {T(0), T(0), T(1)}, linear[2] = {};
  }
  template <class T>
  static void rate(const T*, const T* v, T* q_dot) {
    for (int i = 0; i < 3; ++i) q_dot[i] = v[i];
  }
  static void measure(const Pose& X_JaJb, double* q) {
    q[0] = X_JaJb.p.x(), q[1] = X_JaJb.p.y();
    q[2] = angle_about_z(X_JaJb.q, q[2]);
  }
  static void normalise(double*) {}
  static void reverse(double* q, double* v) {
    // p -> -R(-a) p, and its rate: -R(-a) p' turned back by the rate of -a.
    const double c = std::cos(q[2]), s = std::sin(q[2]);
    const double x = -(c * q[0] + s * q[1]), y = -(c * q[1] - s * q[0]);
    const double vx = -(c * v[0] + s * v[1]) + v[2] * y, vy = -(c * v[1] - s * v[0]) - v[2] * x;
    q[0] = x, q[1] = y, q[2] = -q[2];
    v[0] = vx, v[1] = vy, v[2] = -v[2];
  }
  /// Second derivatives of the reversed numbers at v' = 0: with y = R(-a) p and u = R(-a) p',
  /// y'' = -2 a' z x u - a'^2 y.
  static void reversed_bias(const double* q, const double* v, double* bias) {
    const double c = std::cos(q[2]), s = std::sin(q[2]), w = v[2];
    const double ux = c * v[0] + s * v[1], uy = c * v[1] - s * v[0];
    bias[0] = -2 * w * uy + w * w * (c * q[0] + s * q[1]);
    bias[1] = 2 * w * ux + w * w * (c * q[1] - s * q[0]);
    bias[2] = 0;
  }
};

}  // namespace pantin
