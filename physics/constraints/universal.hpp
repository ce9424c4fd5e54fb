#pragma once
// Universal (Cardan, Hooke) joint: B turns about two axes at right angles that meet in the origin of J.
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

/// Turns about the z axis of A's joint frame, then about the x axis of B's, which the first turn carries:
/// R_JaJb = Rz(first) Rx(second). Zero is where X_WA * X_AJ and X_WB * X_BJ coincide. Value: both angles
/// [rad], right-hand sense, B relative to A.
struct UniversalSettings {
  std::string name{};
  BodyId a{}, b{};                  ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};              ///< J seen from the body origins
  double damping{0};                ///< on both angles [N m s/rad], >= 0
  std::array<JointAxis, 2> axes{};  ///< stops, spring, rotor, friction
  JointStrength strength{};
};
[[nodiscard]] JointDefinition define(UniversalSettings settings);

/// Kernel form (see joint_models.hpp): q = angle about z of Ja, angle about x of Jb; v = their rates.
struct UniversalModel {
  static constexpr std::string_view kName = "universal";
  static constexpr int kCoordinates = 2, kRates = 2;

  template <class T>
  static void place(const T* q, kernel::Mat3<T>& R, kernel::Vec3<T>& p) {
    using std::cos;
    using std::sin;
    const T c1 = cos(q[0]), s1 = sin(q[0]), c2 = cos(q[1]), s2 = sin(q[1]);
    R = {{c1, -s1 * c2, s1 * s2, s1, c1 * c2, -c1 * s2, T(0), s2, c2}};
    p = {};
  }
  template <class T>
  static void columns(const kernel::Mat3<T>& R, kernel::Vec3<T>* angular, kernel::Vec3<T>* linear) {
    angular[0] = {T(0), T(0), T(1)}, linear[0] = {};
    angular[1] = R.column(0), linear[1] = {};
  }
  /// The first turn carries the second axis: z v0 x (R x) v1.
  template <class T>
  static void bias(const kernel::Mat3<T>& R, const T* v, kernel::Vec3<T>& alpha, kernel::Vec3<T>&) {
    const T s = v[0] * v[1];
    alpha = {-s * R.m[3], s * R.m[0], T(0)};
  }
  template <class T>
  static void rate(const T*, const T* v, T* q_dot) {
    q_dot[0] = v[0], q_dot[1] = v[1];
  }
  static void measure(const Pose& X_JaJb, double* q) {
    // First the second axis, x of Jb, as it lies across z of Ja; then what is left about it.
    const Vector3 x = X_JaJb.q * Vector3::UnitX();
    const double first = std::atan2(x.y(), x.x());
    q[0] = first + 2 * M_PI * std::round((q[0] - first) / (2 * M_PI));
    const Quaternion back{std::cos(first / 2), 0, 0, -std::sin(first / 2)};
    const Quaternion rest = back * X_JaJb.q;
    const double second = 2 * std::atan2(rest.x(), rest.w());
    q[1] = second + 2 * M_PI * std::round((q[1] - second) / (2 * M_PI));
  }
  static void normalise(double*) {}
  static void reverse(double* q, double* v) {
    const double q0 = q[0], v0 = v[0];
    q[0] = -q[1], q[1] = -q0;
    v[0] = -v[1], v[1] = -v0;
  }
  /// Seen from B the turn about x comes first: (Rz(a) Rx(b))^T = C Rz(-b) Rx(-a) C^T with C = (z, -y, x).
  static Quaternion reversed_frame() { return Quaternion{0, std::sqrt(0.5), 0, std::sqrt(0.5)}; }
};

}  // namespace pantin
