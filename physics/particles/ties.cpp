#include <pantin/physics/particles/ties.hpp>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

std::optional<SettingsProblem> particles_problem(std::string_view subject,
                                                 std::initializer_list<ParticleId> ids) {
  for (const ParticleId* i = ids.begin(); i != ids.end(); ++i) {
    if (!*i || i->system != ids.begin()->system) {
      return SettingsProblem{ProblemCode::UnknownEntity,
                             std::string{subject} + ": a particle is null, or of another system",
                             "give particles of one system"};
    }
    for (const ParticleId* j = ids.begin(); j != i; ++j) {
      if (*i == *j) {
        return SettingsProblem{ProblemCode::OutOfRange, std::string{subject} + ": a particle is named twice",
                               "give different particles"};
      }
    }
  }
  return std::nullopt;
}

double cotangent(const Vector3& u, const Vector3& v) { return u.dot(v) / u.cross(v).norm(); }

}  // namespace

std::optional<SettingsProblem> problem_with(const DistanceTie& settings) {
  return first_problem({particles_problem("distance tie", {settings.a, settings.b}),
                        must_be_finite({"distance tie", "length", "m"}, settings.length),
                        must_not_be_negative({"distance tie", "compliance", "m/N"}, settings.compliance),
                        must_not_be_negative({"distance tie", "damping time", "s"}, settings.damping_time)});
}

std::optional<SettingsProblem> problem_with(const BendTie& settings) {
  return first_problem({particles_problem("bend tie", {settings.a, settings.b, settings.c}),
                        must_be_positive({"bend tie", "stiffness", "N m^2"}, settings.stiffness),
                        must_not_be_negative({"bend tie", "damping time", "s"}, settings.damping_time)});
}

std::optional<SettingsProblem> problem_with(const HingeTie& settings) {
  return first_problem({particles_problem("hinge tie", {settings.a, settings.b, settings.c, settings.d}),
                        must_be_positive({"hinge tie", "stiffness", "N m"}, settings.stiffness),
                        must_not_be_negative({"hinge tie", "damping time", "s"}, settings.damping_time)});
}

Tie tie_of(const DistanceTie& settings, const Vector3& a, const Vector3& b) {
  const double standing = (b - a).norm(), length = settings.length < 0 ? standing : settings.length;
  return {.serial = {settings.a.serial, settings.b.serial},
          .c = {-1, 1},
          .particles = 2,
          .rest = length,
          .compliance = settings.compliance,
          .damping_time = settings.damping_time,
          .scale = length > 0 ? length : (standing > 0 ? standing : 1)};
}

// Curvature vector k = (2 / (l1 + l2)) ((c - b) / l2 - (b - a) / l1); energy B |k|^2 (l1 + l2) / 4.
Tie tie_of(const BendTie& settings, const Vector3& a, const Vector3& b, const Vector3& c) {
  const double l1 = (b - a).norm(), l2 = (c - b).norm(), f = 2 / (l1 + l2);
  return {.serial = {settings.a.serial, settings.b.serial, settings.c.serial},
          .c = {f / l1, -f / l1 - f / l2, f / l2},
          .particles = 3,
          .straight = true,
          .compliance = 1 / (settings.stiffness * 0.5 * (l1 + l2)),
          .damping_time = settings.damping_time,
          .scale = f};
}

// |sum K_k p_k| with cotangent weights K is |e| theta for a small angle theta between the triangles; energy
// (stiffness / 2) |sum K_k p_k|^2 / (A0 + A1). Edge a-b, corners c and d.
Tie tie_of(const HingeTie& settings, const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 e = b - a;
  const double area = 0.5 * (e.cross(c - a).norm() + e.cross(d - a).norm());
  const double ac = cotangent(e, c - a), ad = cotangent(e, d - a);  // angles at a
  const double bc = cotangent(-e, c - b), bd = cotangent(-e, d - b);
  return {.serial = {settings.a.serial, settings.b.serial, settings.c.serial, settings.d.serial},
          .c = {bc + bd, ac + ad, -(ac + bc), -(ad + bd)},
          .particles = 4,
          .straight = true,
          .compliance = area / settings.stiffness,
          .damping_time = settings.damping_time,
          .scale = e.norm()};
}

}  // namespace pantin
