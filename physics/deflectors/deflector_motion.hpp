#pragma once
// How a deflector moves during one update, as a function of the fraction s in [0, 1] of it: the centre of
// gravity of its body on the parabola through both ends that has the mean acceleration, the attitude turning
// evenly about one axis, whole turns included. A particle's path is a parabola as well; the two make a path
// in the deflector's frame.
#include <cstdint>

#include <pantin/physics/bodies_at.hpp>
#include <pantin/physics/deflector.hpp>

namespace pantin {

class DeflectorMotion {
 public:
  /// Stands still at a pose in W.
  void stand(const Pose& X_WD);
  /// Carried by a body from one instant to another, h [s] later.
  void carry(const BodyKinematics& from, const BodyKinematics& to, double h, const Vector3& p_BcmD_B,
             const Quaternion& q_BD);
  /// The same motion over the part of the update from s0 to s1.
  [[nodiscard]] DeflectorMotion part(double s0, double s1) const;

  [[nodiscard]] bool stands() const noexcept { return stands_; }
  [[nodiscard]] Vector3 centre(double s) const {
    return c0_ + s * (c1_ + 0.5 * s * c2_);
  }                                                ///< of gravity, in W
  [[nodiscard]] Matrix3 rotation(double s) const;  ///< R_WD
  [[nodiscard]] Vector3 origin(double s) const { return centre(s) + rotation(s) * p_CD_D_; }
  /// p_D of a point of W, or p_W of one of D.
  [[nodiscard]] Vector3 to_local(const Vector3& p_W, double s) const {
    return rotation(s).transpose() * (p_W - centre(s)) - p_CD_D_;
  }
  [[nodiscard]] Vector3 to_world(const Vector3& p_D, double s) const {
    return centre(s) + rotation(s) * (p_D + p_CD_D_);
  }
  /// Velocity of the point of D that is at p_W [m/s].
  [[nodiscard]] Vector3 velocity(const Vector3& p_W, double s) const {
    return (centre_rate(s) + turn_.cross(p_W - centre(s))) / h_;
  }
  [[nodiscard]] Vector3 centre_rate(double s) const { return c1_ + s * c2_; }     ///< a unit of s
  [[nodiscard]] const Vector3& centre_curvature() const noexcept { return c2_; }  ///< a unit of s, squared
  [[nodiscard]] const Vector3& turn() const noexcept { return turn_; }  ///< rotation vector of the update
  [[nodiscard]] double angle() const noexcept { return angle_; }        ///< its length [rad]
  [[nodiscard]] double duration() const noexcept { return h_; }         ///< [s]
  /// Greatest distance of D's origin from its straight line between the ends [m].
  [[nodiscard]] double sagitta() const { return (angle_ * angle_ * p_CD_D_.norm() + c2_.norm()) / 8; }

 private:
  Vector3 c0_{Vector3::Zero()}, c1_{Vector3::Zero()}, c2_{Vector3::Zero()};
  Vector3 p_CD_D_{Vector3::Zero()};
  Matrix3 R0_{Matrix3::Identity()};
  Vector3 turn_{Vector3::Zero()}, axis_{Vector3::UnitZ()};
  double angle_{0}, h_{1};
  bool stands_{true};
};

/// A particle's path: from fraction `s0` on, p + v t + a t^2 / 2 with t = (s - s0) h.
struct ParticlePath {
  Vector3 p{Vector3::Zero()};  ///< [m]
  Vector3 v{Vector3::Zero()};  ///< [m/s]
  Vector3 a{Vector3::Zero()};  ///< [m/s^2]
  double s0{0};
  double h{1};  ///< the whole update [s]

  [[nodiscard]] Vector3 at(double s) const {
    const double t = (s - s0) * h;
    return p + t * (v + 0.5 * t * a);
  }
  [[nodiscard]] Vector3 velocity(double s) const { return v + (s - s0) * h * a; }
};

/// The path as the deflector sees it.
class RelativePath {
 public:
  RelativePath(const ParticlePath& path, const DeflectorMotion& motion);

  [[nodiscard]] Vector3 at(double s) const { return motion_.to_local(path_.at(s), s); }
  /// Rate along s, in D.
  [[nodiscard]] Vector3 rate(double s) const;
  /// Bound of the speed and of the curvature, a unit of s, from path's begin to 1.
  [[nodiscard]] double greatest_speed() const noexcept { return speed_; }
  [[nodiscard]] double greatest_curvature() const noexcept { return curvature_; }
  [[nodiscard]] double begin() const noexcept { return path_.s0; }

 private:
  const ParticlePath& path_;
  const DeflectorMotion& motion_;
  double speed_{0}, curvature_{0};
};

}  // namespace pantin
