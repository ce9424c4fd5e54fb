#include <pantin/physics/forces/uniform_field.hpp>

#include <pantin/physics/forces/field_law.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

struct Uniform {
  Vector3 field_W{Vector3::Zero()};
  [[nodiscard]] Vector3 at(const Vector3&) const { return field_W; }
  [[nodiscard]] Matrix3 derivative(const Vector3&) const { return Matrix3::Zero(); }
  [[nodiscard]] double potential(const Vector3& p_W) const { return -field_W.dot(p_W); }
};

}  // namespace

std::optional<SettingsProblem> problem_with(const UniformField& settings) {
  return first_problem({target_problem("uniform field", settings.body, settings.particles),
                        must_be_finite({"uniform field", "field", "N/kg"}, settings.field_W),
                        must_be_finite({"uniform field", "charge", ""}, settings.charge.value_or(0))});
}

std::unique_ptr<ForceLaw> make_law(const UniformField& settings) {
  return std::make_unique<FieldLaw<Uniform>>(Uniform{settings.field_W}, settings.charge,
                                             ForceTarget{settings.body, settings.particles});
}

}  // namespace pantin
