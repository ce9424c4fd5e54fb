// With d = p_WB - p_WA, l = |d|, n = d / l and dl/dt = n . (v_WB - v_WA), the tension T = k (l - l0) + c
// dl/dt pulls the points together: T n on A's end, -T n on B's. Both act on one line, so neither momentum nor
// angular momentum changes. The potential is k (l - l0)^2 / 2; the damper has none.
#include <pantin/physics/forces/damped_spring.hpp>

#include <pantin/physics/forces/line_force.hpp>
#include <pantin/physics/forces/wrench_derivatives.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

class DampedSpringLaw final : public ForceLaw, public LineForce {
 public:
  explicit DampedSpringLaw(const DampedSpring& settings) : settings_{settings} {}

  void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const override {
    add_effort(at, effort(at), wrenches);
  }
  const LineForce* line() const override { return this; }
  double stiffness() const override { return settings_.stiffness; }
  double damping() const override { return settings_.damping; }

  /// The tension.
  double effort(const BodiesAt& at) const override {
    const PointKinematics a = point_at(at, settings_.a), b = point_at(at, settings_.b);
    const Vector3 d = b.p_WQ - a.p_WQ;
    const double length = d.stableNorm();
    if (length == 0) return 0;
    const double length_rate = (d / length).dot(b.v_WQ - a.v_WQ);
    return settings_.stiffness * (length - settings_.rest_length) + settings_.damping * length_rate;
  }

  void add_effort(const BodiesAt& at, double effort, std::span<Wrench> wrenches) const override {
    const Vector3 a = point_at(at, settings_.a).p_WQ, b = point_at(at, settings_.b).p_WQ;
    const double length = (b - a).stableNorm();
    if (length == 0) return;
    const Vector3 force = effort * ((b - a) / length);
    if (settings_.a.body) add_force_at(at, at.index(settings_.a.body), a, force, wrenches);
    if (settings_.b.body) add_force_at(at, at.index(settings_.b.body), b, -force, wrenches);
  }

  /// With N = (1 - n n^T) / l, the derivative of n by d: T n changes by (n (k n^T + c d'^T N) + T N) with d
  /// and by c n n^T with its rate.
  bool add_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const override {
    const PointKinematics a = point_at(at, settings_.a);
    const PointKinematics b = point_at(at, settings_.b);
    const Vector3 d = b.p_WQ - a.p_WQ, d_rate = b.v_WQ - a.v_WQ;
    const double length = d.stableNorm();
    if (length == 0) {
      const double stiffness = settings_.rest_length == 0 ? settings_.stiffness : 0;
      derivatives.add_pair(at, settings_.a, settings_.b, {.by_distance = stiffness * Matrix3::Identity()});
      return true;
    }
    const Vector3 n = d / length;
    const Matrix3 N = (Matrix3::Identity() - n * n.transpose()) / length;
    const double tension =
        settings_.stiffness * (length - settings_.rest_length) + settings_.damping * n.dot(d_rate);
    const Vector3 by_d = settings_.stiffness * n + settings_.damping * (N * d_rate);
    derivatives.add_pair(at, settings_.a, settings_.b,
                         {.force_a = tension * n,
                          .by_distance = n * by_d.transpose() + tension * N,
                          .by_rate = settings_.damping * n * n.transpose()});
    return true;
  }

  double potential_energy(const BodiesAt& at) const override {
    if (!moves(at, settings_.a) && !moves(at, settings_.b)) return 0;
    const double length = (point_at(at, settings_.b).p_WQ - point_at(at, settings_.a).p_WQ).stableNorm();
    const double stretch = length - settings_.rest_length;
    return 0.5 * settings_.stiffness * stretch * stretch;
  }

  bool depends_on_velocity() const override { return settings_.damping != 0; }

  bool names(BodyId body) const override {
    return body && (body == settings_.a.body || body == settings_.b.body);
  }
  Coupling coupling() const override {
    return {.reach = Coupling::Reach::Named, .bodies = {settings_.a.body, settings_.b.body}};
  }

 private:
  static bool moves(const BodiesAt& at, const Attachment& end) {
    return end.body && at.kind[at.index(end.body)] == BodyKind::Simulated;
  }

  DampedSpring settings_;
};

}  // namespace

std::optional<SettingsProblem> problem_with(const DampedSpring& settings) {
  if (!settings.a.body && !settings.b.body) {
    return SettingsProblem{ProblemCode::UnknownEntity, "damped spring: both ends are on the world",
                           "attach at least one end to a body"};
  }
  return first_problem({must_be_finite({"damped spring", "point a", "m"}, settings.a.p_BQ),
                        must_be_finite({"damped spring", "point b", "m"}, settings.b.p_BQ),
                        must_not_be_negative({"damped spring", "stiffness", "N/m"}, settings.stiffness),
                        must_not_be_negative({"damped spring", "damping", "N s/m"}, settings.damping),
                        must_not_be_negative({"damped spring", "rest length", "m"}, settings.rest_length)});
}

std::unique_ptr<ForceLaw> make_law(const DampedSpring& settings) {
  return std::make_unique<DampedSpringLaw>(settings);
}

}  // namespace pantin
