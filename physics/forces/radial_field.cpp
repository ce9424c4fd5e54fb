#include <pantin/physics/forces/radial_field.hpp>

#include <cmath>

#include <pantin/physics/forces/field_law.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

struct Radial {
  Vector3 centre{Vector3::Zero()};
  double strength{0}, exponent{0}, at_distance{1}, softening{0};

  [[nodiscard]] Vector3 at(const Vector3& p_W) const {
    const Vector3 r = p_W - centre;
    const double d = distance(r);
    if (d == 0) return Vector3::Zero();
    return strength * std::pow(d / at_distance, exponent) * (r / d);
  }
  [[nodiscard]] Matrix3 derivative(const Vector3& p_W) const {
    const Vector3 r = p_W - centre;
    const double d = distance(r);
    if (d == 0) return Matrix3::Zero();
    const Vector3 n = r / d;
    return strength * std::pow(d / at_distance, exponent) / d *
           (Matrix3::Identity() + (exponent - 1) * n * n.transpose());
  }
  [[nodiscard]] double potential(const Vector3& p_W) const {
    const double d = distance(p_W - centre), power = exponent + 1;
    if (d == 0 && power <= 0) return 0;  // no number stands for it; there is no force there either
    if (power == 0) return -strength * at_distance * std::log(d / at_distance);
    return -strength * at_distance * std::pow(d / at_distance, power) / power;
  }
  [[nodiscard]] double distance(const Vector3& r) const { return std::hypot(r.stableNorm(), softening); }
};

}  // namespace

std::optional<SettingsProblem> problem_with(const RadialField& settings) {
  return first_problem({target_problem("radial field", settings.body, settings.particles),
                        must_be_finite({"radial field", "centre", "m"}, settings.centre),
                        must_be_finite({"radial field", "strength", "N/kg"}, settings.strength),
                        must_be_finite({"radial field", "exponent", ""}, settings.exponent),
                        must_be_positive({"radial field", "distance", "m"}, settings.at_distance),
                        must_not_be_negative({"radial field", "softening", "m"}, settings.softening),
                        must_be_finite({"radial field", "charge", ""}, settings.charge.value_or(0))});
}

std::unique_ptr<ForceLaw> make_law(const RadialField& settings) {
  const Radial field{settings.centre, settings.strength, settings.exponent, settings.at_distance,
                     settings.softening};
  return std::make_unique<FieldLaw<Radial>>(field, settings.charge,
                                            ForceTarget{settings.body, settings.particles});
}

}  // namespace pantin
