#pragma once
// Private to bridge. A difference between two motions that dies out: the way back from where physics left a
// node to what its clip says, and the way from where a node stood to where the user has put it.
#include <pantin/bridge/rigid_motion.hpp>
#include <pantin/physics/driver.hpp>

namespace pantin {

/// How an offset goes from its start to nothing.
enum class Fade {
  Linear,    ///< x0 (1 - t / T), nothing after T
  Critical,  ///< (x0 + (x0' + x0 / T) t) exp(-t / T), critically damped: continuous in value and velocity
};

/// Translation and rotation vector, in axes of the frame in which the motion is given: p = p_base + d(t),
/// R = exp(theta(t)) R_base; and a difference of residuals, S = S_base + D(t).
class Offset {
 public:
  Offset() = default;
  /// Leads from `from` to `base`, both at `begin`, within `span` > 0 [s]. Critical takes over the difference
  /// of velocities too.
  Offset(Fade fade, double begin, double span, const RigidMotion& from, const RigidMotion& base);
  /// The residual at the start, against the base's; Critical only, it starts at rest.
  void set_residual(const Matrix3& from, const Matrix3& base) { D_ = from - base; }

  [[nodiscard]] RigidMotion applied(const RigidMotion& base, double t, Side side) const;
  [[nodiscard]] SplitMotion applied(const SplitMotion& base, double t, Side side) const;
  /// From when on nothing is left of it [s] (less than round-off of the start, for Critical).
  [[nodiscard]] double end() const noexcept { return end_; }
  [[nodiscard]] double span() const noexcept { return span_; }
  /// Whether it still counts at this time.
  [[nodiscard]] bool active(double t, Side side) const noexcept {
    return t < end_ || (t == end_ && side == Side::Before && fade_ == Fade::Linear);
  }

 private:
  struct Faded {
    Vector3 value{Vector3::Zero()}, first{Vector3::Zero()}, second{Vector3::Zero()};
  };
  [[nodiscard]] Faded faded(const Vector3& x0, const Vector3& x1, double t) const;

  Fade fade_{Fade::Linear};
  double begin_{0}, span_{1}, end_{0};
  Vector3 d0_{Vector3::Zero()}, d1_{Vector3::Zero()};          ///< [m], [m/s]
  Vector3 theta0_{Vector3::Zero()}, theta1_{Vector3::Zero()};  ///< [rad], [rad/s]
  Matrix3 D_{Matrix3::Zero()};
};

/// Rotation exp(theta) with the angular velocity and acceleration it has when theta moves; all in the fixed
/// axes.
struct RotationMotion {
  Quaternion q{Quaternion::Identity()};
  Vector3 w{Vector3::Zero()};      ///< [rad/s]
  Vector3 alpha{Vector3::Zero()};  ///< [rad/s^2]
};
[[nodiscard]] RotationMotion rotation_motion(const Vector3& theta, const Vector3& first,
                                             const Vector3& second);
/// The shortest rotation vector of q [rad].
[[nodiscard]] Vector3 rotation_vector(const Quaternion& q);
/// dtheta/dt from the angular velocity of exp(theta); |theta| <= pi.
[[nodiscard]] Vector3 rotation_vector_rate(const Vector3& theta, const Vector3& w);

}  // namespace pantin
