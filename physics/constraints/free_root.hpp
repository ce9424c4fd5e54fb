#pragma once
// The floating root of a tree that no joint ties to the world: a joint to the world that holds nothing. Made
// by the solver, not by the user.
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

/// Kernel form (see joint_models.hpp): q = position, then quaternion (w, x, y, z), of L in the world; v =
/// angular velocity in axes of L, then velocity of L's origin in axes of the world.
struct FreeModel {
  static constexpr std::string_view kName = "free";
  static constexpr int kCoordinates = 7, kRates = 6;

  template <class T>
  static void place(const T* q, kernel::Mat3<T>& R, kernel::Vec3<T>& p) {
    R = kernel::rotation_of(q + 3);
    p = {q[0], q[1], q[2]};
  }
  template <class T>
  static void columns(const kernel::Mat3<T>& R, kernel::Vec3<T>* angular, kernel::Vec3<T>* linear) {
    for (int j = 0; j < 3; ++j) {
      angular[j] = R.column(j);
      linear[j] = {};
      angular[3 + j] = {};
      linear[3 + j] = kernel::Mat3<T>::identity().column(j);
    }
  }
  template <class T>
  static void rate(const T* q, const T* v, T* q_dot) {
    for (int i = 0; i < 3; ++i) q_dot[i] = v[3 + i];
    kernel::quaternion_rate_body(q + 3, v, q_dot + 3);
  }
  static void measure(const Pose& X_WL, double* q) {
    for (int i = 0; i < 3; ++i) q[i] = X_WL.p[i];
    q[3] = X_WL.q.w(), q[4] = X_WL.q.x(), q[5] = X_WL.q.y(), q[6] = X_WL.q.z();
  }
  static void normalise(double* q) { kernel::normalise_quaternion(q + 3); }
  static void reverse(double*, double*) {}
};

}  // namespace pantin
