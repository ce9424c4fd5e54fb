// exp(theta) as a quaternion is (c(u), s(u) theta) with u = theta . theta, c = cos(sqrt(u) / 2),
// s = sin(sqrt(u) / 2) / sqrt(u). Its derivatives follow by the chain rule in u, and w = 2 vec(q' q*),
// alpha = 2 vec(q'' q*) (q' q'* is real). With dc/du = -s / 4 and ds/du = (c / 2 - s) / (2 u) nothing is
// singular.
#include <pantin/bridge/offset.hpp>

#include <cmath>

namespace pantin {
namespace {

constexpr double kNothingLeft = 40;  // time constants: (1 + 40) exp(-40) is below round-off
constexpr double kSeriesBelow = 1;   // u, where the closed forms begin to lose digits

/// s(u) with its first and second derivative.
struct HalfSine {
  double s{0}, s1{0}, s2{0};
};

HalfSine half_sine(double u, double c) {
  HalfSine f;
  if (u < kSeriesBelow) {
    double term = 0.5;            // (-1)^k / (2^(2k+1) (2k+1)!)
    double power[3] = {1, 0, 0};  // u^k, u^(k-1), u^(k-2)
    for (int k = 0; k < 12; ++k) {
      f.s += term * power[0];
      f.s1 += k * term * power[1];
      f.s2 += k * (k - 1) * term * power[2];
      term *= -0.25 / ((2 * k + 2) * (2 * k + 3));
      power[2] = power[1], power[1] = power[0], power[0] *= u;
    }
    return f;
  }
  const double root = std::sqrt(u);
  f.s = std::sin(root / 2) / root;
  f.s1 = (c / 2 - f.s) / (2 * u);
  f.s2 = -(f.s / 8 + 3 * f.s1) / (2 * u);
  return f;
}

Quaternion plus(double real, const Vector3& vector) { return {real, vector.x(), vector.y(), vector.z()}; }

}  // namespace

RotationMotion rotation_motion(const Vector3& theta, const Vector3& first, const Vector3& second) {
  const double u = theta.squaredNorm();
  const double u1 = 2 * theta.dot(first);
  const double u2 = 2 * (first.squaredNorm() + theta.dot(second));
  const double c = std::cos(std::sqrt(u) / 2);
  const HalfSine f = half_sine(u, c);
  const double s_1 = f.s1 * u1, s_2 = f.s2 * u1 * u1 + f.s1 * u2;
  const double c_1 = -f.s / 4 * u1, c_2 = -f.s1 / 4 * u1 * u1 - f.s / 4 * u2;
  const Quaternion q = plus(c, f.s * theta);
  const Quaternion q1 = plus(c_1, s_1 * theta + f.s * first);
  const Quaternion q2 = plus(c_2, s_2 * theta + 2 * s_1 * first + f.s * second);
  return {q.normalized(), 2 * (q1 * q.conjugate()).vec(), 2 * (q2 * q.conjugate()).vec()};
}

Vector3 rotation_vector(const Quaternion& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  const double sine = q.vec().norm();
  if (sine == 0) return Vector3::Zero();
  return 2 * std::atan2(sine, sign * q.w()) / sine * sign * q.vec();
}

// Inverse of the left Jacobian: 1 - [theta] / 2 + k [theta]^2, k = (1 - (phi/2) cot(phi/2)) / phi^2
// (Chirikjian, Stochastic Models, Information Theory, and Lie Groups 2, 2012, (10.86)).
Vector3 rotation_vector_rate(const Vector3& theta, const Vector3& w) {
  const double u = theta.squaredNorm(), half = std::sqrt(u) / 2;
  const double k =
      u < 1e-2 ? 1.0 / 12 + u / 720 + u * u / 30240 + u * u * u / 1209600 : (1 - half / std::tan(half)) / u;
  return w - 0.5 * theta.cross(w) + k * theta.cross(theta.cross(w));
}

Offset::Offset(Fade fade, double begin, double span, const RigidMotion& from, const RigidMotion& base)
    : fade_{fade},
      begin_{begin},
      span_{span},
      end_{begin + (fade == Fade::Linear ? span : kNothingLeft * span)} {
  const Quaternion E = from.X_AB.q * base.X_AB.q.conjugate();
  d0_ = from.X_AB.p - base.X_AB.p;
  theta0_ = rotation_vector(E);
  if (fade == Fade::Linear) return;
  d1_ = from.v_AB - base.v_AB;
  theta1_ = rotation_vector_rate(theta0_, from.w_AB - E * base.w_AB);
}

Offset::Faded Offset::faded(const Vector3& x0, const Vector3& x1, double t) const {
  const double at = t - begin_;
  if (fade_ == Fade::Linear) return {x0 * ((span_ - at) / span_), -x0 / span_, Vector3::Zero()};
  const double decay = std::exp(-at / span_);
  const Vector3 slope = x1 + x0 / span_;
  const Vector3 line = x0 + slope * at;
  return {decay * line, decay * (slope - line / span_), decay * (line / span_ - 2 * slope) / span_};
}

RigidMotion Offset::applied(const RigidMotion& base, double t, Side side) const {
  if (!active(t, side)) return base;
  const Faded d = faded(d0_, d1_, t), theta = faded(theta0_, theta1_, t);
  const RotationMotion E = rotation_motion(theta.value, theta.first, theta.second);
  const Vector3 w = E.q * base.w_AB;
  RigidMotion X;
  X.X_AB = {base.X_AB.p + d.value, (E.q * base.X_AB.q).normalized()};
  X.v_AB = base.v_AB + d.first;
  X.a_AB = base.a_AB + d.second;
  X.w_AB = E.w + w;
  X.alpha_AB = E.alpha + E.w.cross(w) + E.q * base.alpha_AB;
  return X;
}

SplitMotion Offset::applied(const SplitMotion& base, double t, Side side) const {
  if (!active(t, side)) return base;
  SplitMotion out = base;
  out.X = applied(base.X, t, side);
  if (fade_ == Fade::Linear) return out;
  const double at = (t - begin_) / span_, decay = std::exp(-at);
  out.S += (1 + at) * decay * D_;
  out.S1 -= at * decay / span_ * D_;
  out.S2 += (at - 1) * decay / (span_ * span_) * D_;
  return out;
}

}  // namespace pantin
