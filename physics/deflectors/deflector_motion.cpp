#include <pantin/physics/deflectors/deflector_motion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pantin {

namespace {

/// The rotation vector from one attitude to another, with the whole turns that the mean rate asks for.
Vector3 turn_between(const Matrix3& from, const Matrix3& to, const Vector3& expected) {
  if (from == to && expected.squaredNorm() < 1) return Vector3::Zero();
  Quaternion q{Matrix3{to * from.transpose()}};
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  const double angle = 2 * std::atan2(sine, q.w());
  const Vector3 least = sine > 1e-12 ? Vector3{q.vec() * (angle / sine)} : Vector3{2 * q.vec()};
  const double rate = expected.norm();
  if (rate < 1) return least;
  const Vector3 axis = angle > 1e-9 ? Vector3{least / angle} : Vector3{expected / rate};
  const double turns = std::round((axis.dot(expected) - axis.dot(least)) / (2 * std::numbers::pi));
  return least + 2 * std::numbers::pi * turns * axis;
}

}  // namespace

void DeflectorMotion::stand(const Pose& X_WD) {
  *this = DeflectorMotion{};
  c0_ = X_WD.p;
  R0_ = X_WD.rotation();
}

void DeflectorMotion::carry(const BodyKinematics& from, const BodyKinematics& to, double h,
                            const Vector3& p_BcmD_B, const Quaternion& q_BD) {
  const Matrix3 R_BD = q_BD.toRotationMatrix();
  h_ = h;
  c0_ = from.p_WBcm;
  c2_ = h * (to.v_WBcm - from.v_WBcm);
  c1_ = to.p_WBcm - from.p_WBcm - 0.5 * c2_;
  R0_ = from.R_WB * R_BD;
  p_CD_D_ = R_BD.transpose() * p_BcmD_B;
  turn_ = turn_between(from.R_WB, to.R_WB, 0.5 * h * (from.w_WB + to.w_WB));
  angle_ = turn_.norm();
  axis_ = angle_ > 0 ? Vector3{turn_ / angle_} : Vector3{Vector3::UnitZ()};
  stands_ = angle_ == 0 && c1_.isZero(0) && c2_.isZero(0);
}

Matrix3 DeflectorMotion::rotation(double s) const {
  if (angle_ == 0) return R0_;
  return Eigen::AngleAxisd{s * angle_, axis_}.toRotationMatrix() * R0_;
}

DeflectorMotion DeflectorMotion::part(double s0, double s1) const {
  DeflectorMotion out = *this;
  const double f = s1 - s0;
  out.c0_ = centre(s0);
  out.c1_ = f * centre_rate(s0);
  out.c2_ = f * f * c2_;
  out.R0_ = rotation(s0);
  out.turn_ = f * turn_;
  out.angle_ = f * angle_;
  out.h_ = f * h_;
  return out;
}

RelativePath::RelativePath(const ParticlePath& path, const DeflectorMotion& motion)
    : path_{path}, motion_{motion} {
  const double s = path.s0, span = 1 - s;
  const Vector3 curved = path.h * path.h * path.a - motion.centre_curvature();
  const double shift = std::max((path.h * path.v - motion.centre_rate(s)).norm(),
                                (path.h * path.velocity(1) - motion.centre_rate(1)).norm());
  const double far = std::max((path.p - motion.centre(s)).norm(), (path.at(1) - motion.centre(1)).norm()) +
                     curved.norm() * span * span / 8;
  const double angle = motion.angle();
  speed_ = shift + angle * far;
  curvature_ = curved.norm() + angle * (2 * shift + angle * far);
}

Vector3 RelativePath::rate(double s) const {
  const Vector3 r = path_.at(s) - motion_.centre(s);
  const Vector3 rate_W = path_.h * path_.velocity(s) - motion_.centre_rate(s) - motion_.turn().cross(r);
  return motion_.rotation(s).transpose() * rate_W;
}

}  // namespace pantin
