#pragma once
// Fixed (weld): B does not move against A. Bodies joined so are one for the solver; each keeps its id, and
// the reaction between them can still be read.
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

struct FixedSettings {
  std::string name{};
  BodyId a{}, b{};      ///< a null = world; b must be a body
  Pose X_AJ{}, X_BJ{};  ///< J seen from the body origins
  JointStrength strength{};
};
[[nodiscard]] JointDefinition define(FixedSettings settings);

/// Kernel form (see joint_models.hpp): no coordinates.
struct FixedModel {
  static constexpr std::string_view kName = "fixed";
  static constexpr int kCoordinates = 0, kRates = 0;

  template <class T>
  static void place(const T*, kernel::Mat3<T>& R, kernel::Vec3<T>& p) {
    R = kernel::Mat3<T>::identity();
    p = {};
  }
  template <class T>
  static void columns(const kernel::Mat3<T>&, kernel::Vec3<T>*, kernel::Vec3<T>*) {}
  template <class T>
  static void rate(const T*, const T*, T*) {}
  static void measure(const Pose&, double*) {}
  static void normalise(double*) {}
  static void reverse(double*, double*) {}
};

}  // namespace pantin
