// In axes of A, q = (w, v) turns the attitude of rest into that of now, and q' = (0, omega) q / 2 with omega
// the angular velocity of B against A.
//   about all axes   phi = 2 atan2(|v|, w) along n = v / |v|, phi' = n . omega, torque on B -(k phi n + c
//   omega) about axis a     s = v . a, psi = 2 atan2(s, w), psi' = g . omega with
//                    g = (w (w a + v x a) + s v) / (w^2 + s^2), torque on B -(k psi + c psi') g
// Either is minus the gradient of k angle^2 / 2, and the damper takes power.
#include <pantin/physics/forces/torsion_spring.hpp>

#include <cmath>

#include <pantin/physics/forces/line_force.hpp>
#include <pantin/physics/forces/wrench_derivatives.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

struct Turn {
  double angle{0};                    ///< [rad], in (-pi, pi]
  Vector3 gradient{Vector3::Zero()};  ///< angle' = gradient . omega
};

Turn turn_about_any_axis(const Quaternion& q) {
  const double sense = q.w() < 0 ? -1 : 1;  // the shorter way
  const double length = q.vec().stableNorm();
  if (length == 0) return {};
  return {2 * std::atan2(length, std::abs(q.w())), sense / length * q.vec()};
}

Turn turn_about(const Vector3& axis, const Quaternion& q) {
  const double sense = q.w() < 0 ? -1 : 1;
  const double w = q.w(), s = q.vec().dot(axis), squares = w * w + s * s;
  if (squares == 0) return {};  // swung by half a turn: no twist is nearer than another
  const Vector3 gradient = (w * (w * axis + q.vec().cross(axis)) + s * q.vec()) / squares;
  return {2 * std::atan2(sense * s, std::abs(w)), gradient};
}

/// The derivative of angle * n, the vector of a turn, by a small turn after it: half cot and cross product
/// (J. Sola et al., A micro Lie theory, 2018, eq. 146).
Matrix3 derivative_of_vector(const Vector3& vector) {
  const double angle = vector.norm(), half = 0.5 * angle;
  const Matrix3 X = cross_matrix(vector);
  const double c =
      angle < 1e-3 ? 1.0 / 12 + angle * angle / 720 : (1 - half / std::tan(half)) / (angle * angle);
  return Matrix3::Identity() - 0.5 * X + c * X * X;
}

/// The derivative of turn_about's gradient by a small turn after q, in the axes of q.
Matrix3 derivative_of_gradient(const Vector3& axis, const Quaternion& q) {
  const double w = q.w(), s = q.vec().dot(axis), squares = w * w + s * s;
  if (squares == 0) return Matrix3::Zero();
  const Vector3 v = q.vec(), n = w * (w * axis + v.cross(axis)) + s * v;
  Matrix3 by_turn;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vector3 turn = Vector3::Unit(k);
    const double dw = -0.5 * v.dot(turn);
    const Vector3 dv = 0.5 * (w * turn + turn.cross(v));
    const double ds = dv.dot(axis);
    const Vector3 dn = dw * (2 * w * axis + v.cross(axis)) + w * dv.cross(axis) + ds * v + s * dv;
    by_turn.col(k) = (dn - n * (2 * (w * dw + s * ds) / squares)) / squares;
  }
  return by_turn;
}

/// About an axis it acts along one number, the twist.
class TorsionSpringLaw final : public ForceLaw, public LineForce {
 public:
  explicit TorsionSpringLaw(const TorsionSpring& settings) : settings_{settings} {}

  const LineForce* line() const override { return settings_.axis_A ? this : nullptr; }
  double stiffness() const override { return settings_.stiffness; }
  double damping() const override { return settings_.damping; }
  double effort(const BodiesAt& at) const override {
    const Vector3 omega_W = rate(at, settings_.b) - rate(at, settings_.a);
    return effort_of(turn_now(at), rotation(at, settings_.a).transpose() * omega_W);
  }
  void add_effort(const BodiesAt& at, double effort, std::span<Wrench> wrenches) const override {
    push(at, rotation(at, settings_.a) * (-effort * turn_now(at).gradient), wrenches);
  }

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    const Matrix3 R_WA = rotation(at, settings_.a);
    const Vector3 omega_A = R_WA.transpose() * (rate(at, settings_.b) - rate(at, settings_.a));
    push(at, R_WA * torque_of(turn_now(at), omega_A), wrenches);
  }

  /// A turn of both ends turns the torque; the rest is by the turn of b against a, and by its rate.
  bool add_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const override {
    const Matrix3 R_WA = rotation(at, settings_.a);
    const Vector3 omega_W = rate(at, settings_.b) - rate(at, settings_.a);
    const Vector3 omega_A = R_WA.transpose() * omega_W, torque_W = R_WA * torque_of(turn_now(at), omega_A);
    const Change change = change_now(at, omega_A);
    const Matrix3 by_turn = R_WA * change.by_turn * R_WA.transpose(),
                  by_rate = R_WA * change.by_rate * R_WA.transpose();
    const Matrix3 with_a = -cross_matrix(torque_W) + by_rate * cross_matrix(omega_W);
    for (const BodyId on : {settings_.a, settings_.b}) {
      for (const BodyId by : {settings_.a, settings_.b}) {
        if (!on || !by) continue;
        const double sign = on == settings_.b ? 1 : -1;
        WrenchDerivative& part = derivatives.add(at.index(on), at.index(by));
        part.torque.turn = sign * (by == settings_.b ? by_turn : Matrix3{with_a - by_turn});
        part.torque.spin = sign * (by == settings_.b ? by_rate : Matrix3{-by_rate});
      }
    }
    return true;
  }

  double potential_energy(const BodiesAt& at) const override {
    if (!moves(at, settings_.a) && !moves(at, settings_.b)) return 0;
    const double angle = turn_now(at).angle;
    return 0.5 * settings_.stiffness * angle * angle;
  }

  bool depends_on_velocity() const override { return settings_.damping != 0; }
  bool names(BodyId body) const override { return body && (body == settings_.a || body == settings_.b); }
  Coupling coupling() const override {
    return {.reach = Coupling::Reach::Named, .bodies = {settings_.a, settings_.b}};
  }

 private:
  /// A torque on B, and against it on A.
  void push(const BodiesAt& at, const Vector3& torque_W, std::span<Wrench> wrenches) const {
    if (settings_.b) wrenches[at.index(settings_.b)].torque += torque_W;
    if (settings_.a) wrenches[at.index(settings_.a)].torque -= torque_W;
  }
  static Matrix3 rotation(const BodiesAt& at, BodyId body) {
    return body ? at.kinematics[at.index(body)].R_WB : Matrix3{Matrix3::Identity()};
  }
  static Vector3 rate(const BodiesAt& at, BodyId body) {
    return body ? at.kinematics[at.index(body)].w_WB : Vector3{Vector3::Zero()};
  }
  static bool moves(const BodiesAt& at, BodyId body) {
    return body && at.kind[at.index(body)] == BodyKind::Simulated;
  }
  /// From the attitude of rest to that of now, in axes of A.
  [[nodiscard]] Quaternion turned(const BodiesAt& at) const {
    const Matrix3 R_AB = rotation(at, settings_.a).transpose() * rotation(at, settings_.b);
    return Quaternion{R_AB} * settings_.q_AB.conjugate();
  }
  [[nodiscard]] Turn turn_now(const BodiesAt& at) const {
    const Quaternion q = turned(at);
    return settings_.axis_A ? turn_about(*settings_.axis_A, q) : turn_about_any_axis(q);
  }
  /// On B, in A.
  [[nodiscard]] Vector3 torque_of(const Turn& turn, const Vector3& omega_A) const {
    const Vector3& g = turn.gradient;
    if (!settings_.axis_A) return -settings_.stiffness * turn.angle * g - settings_.damping * omega_A;
    return -effort_of(turn, omega_A) * g;
  }
  [[nodiscard]] double effort_of(const Turn& turn, const Vector3& omega_A) const {
    return settings_.stiffness * turn.angle + settings_.damping * turn.gradient.dot(omega_A);
  }
  /// Of that torque, by a small turn after the one of now and by omega_A.
  struct Change {
    Matrix3 by_turn{Matrix3::Zero()}, by_rate{Matrix3::Zero()};
  };
  [[nodiscard]] Change change_now(const BodiesAt& at, const Vector3& omega_A) const {
    const double k = settings_.stiffness, c = settings_.damping;
    const Turn turn = turn_now(at);
    const Vector3& g = turn.gradient;
    if (!settings_.axis_A) return {-k * derivative_of_vector(turn.angle * g), -c * Matrix3::Identity()};
    const Matrix3 by_turn = derivative_of_gradient(*settings_.axis_A, turned(at));
    const Vector3 along = k * g + c * by_turn.transpose() * omega_A;
    return {-g * along.transpose() - (k * turn.angle + c * g.dot(omega_A)) * by_turn, -c * g * g.transpose()};
  }

  TorsionSpring settings_;
};

std::optional<SettingsProblem> ends_problem(const TorsionSpring& settings) {
  if (settings.a != settings.b) return std::nullopt;
  return SettingsProblem{
      ProblemCode::UnknownEntity,
      settings.a ? "torsion spring: both ends are one body" : "torsion spring: both ends are on the world",
      "give two ends, at least one of them a body"};
}

}  // namespace

std::optional<SettingsProblem> problem_with(const TorsionSpring& settings) {
  return first_problem(
      {ends_problem(settings), must_be_unit({"torsion spring", "rest attitude", ""}, settings.q_AB),
       must_be_unit({"torsion spring", "axis", ""}, settings.axis_A.value_or(Vector3::UnitZ())),
       must_not_be_negative({"torsion spring", "stiffness", "N m/rad"}, settings.stiffness),
       must_not_be_negative({"torsion spring", "damping", "N m s/rad"}, settings.damping)});
}

std::unique_ptr<ForceLaw> make_law(const TorsionSpring& settings) {
  return std::make_unique<TorsionSpringLaw>(settings);
}

}  // namespace pantin
