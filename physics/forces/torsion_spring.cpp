// In axes of A, q = (w, v) turns the attitude of rest into that of now, and q' = (0, omega) q / 2 with omega
// the angular velocity of B against A.
//   about all axes   phi = 2 atan2(|v|, w) along n = v / |v|, phi' = n . omega, torque on B -(k phi n + c
//   omega) about axis a     s = v . a, psi = 2 atan2(s, w), psi' = g . omega with
//                    g = (w (w a + v x a) + s v) / (w^2 + s^2), torque on B -(k psi + c psi') g
// Either is minus the gradient of k angle^2 / 2, and the damper takes power.
#include <pantin/physics/forces/torsion_spring.hpp>

#include <cmath>

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

class TorsionSpringLaw final : public ForceLaw {
 public:
  explicit TorsionSpringLaw(const TorsionSpring& settings) : settings_{settings} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    const Matrix3 R_WA = rotation(at, settings_.a);
    const Vector3 omega_A = R_WA.transpose() * (rate(at, settings_.b) - rate(at, settings_.a));
    const Turn turn = turn_now(at);
    Vector3 torque_A = -settings_.stiffness * turn.angle * turn.gradient;
    if (settings_.axis_A) {
      torque_A -= settings_.damping * turn.gradient.dot(omega_A) * turn.gradient;
    } else {
      torque_A -= settings_.damping * omega_A;
    }
    const Vector3 torque_W = R_WA * torque_A;
    if (settings_.b) wrenches[at.index(settings_.b)].torque += torque_W;
    if (settings_.a) wrenches[at.index(settings_.a)].torque -= torque_W;
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
  static Matrix3 rotation(const BodiesAt& at, BodyId body) {
    return body ? at.kinematics[at.index(body)].R_WB : Matrix3{Matrix3::Identity()};
  }
  static Vector3 rate(const BodiesAt& at, BodyId body) {
    return body ? at.kinematics[at.index(body)].w_WB : Vector3{Vector3::Zero()};
  }
  static bool moves(const BodiesAt& at, BodyId body) {
    return body && at.kind[at.index(body)] == BodyKind::Simulated;
  }
  [[nodiscard]] Turn turn_now(const BodiesAt& at) const {
    const Matrix3 R_AB = rotation(at, settings_.a).transpose() * rotation(at, settings_.b);
    const Quaternion q = Quaternion{R_AB} * settings_.q_AB.conjugate();
    return settings_.axis_A ? turn_about(*settings_.axis_A, q) : turn_about_any_axis(q);
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
