#include <pantin/physics/particle_system.hpp>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {

std::optional<SettingsProblem> problem_with(const ParticleSystemSettings& settings) {
  const std::string subject = "particle system '" + settings.name + "'";
  if (settings.capacity < 1 || settings.substeps < 1 || settings.substeps > 1000) {
    return SettingsProblem{ProblemCode::OutOfRange,
                           subject + ": capacity is " + std::to_string(settings.capacity) + ", substeps is " +
                               std::to_string(settings.substeps),
                           "give room for one particle at least, and 1 to 1000 substeps"};
  }
  return first_problem({must_be_positive({subject, "mass", "kg"}, settings.mass),
                        must_not_be_negative({subject, "radius", "m"}, settings.radius)});
}

std::optional<SettingsProblem> problem_with(const ParticleSettings& settings) {
  if (!(settings.lifetime > 0)) {
    return SettingsProblem{
        ProblemCode::OutOfRange,
        "particle: lifetime is " + text_of(settings.lifetime) + " s; it must be more than zero",
        "give a lifetime above zero, or infinity"};
  }
  return first_problem({must_be_finite({"particle", "position", "m"}, settings.p_WP),
                        must_be_finite({"particle", "velocity", "m/s"}, settings.v_WP),
                        must_not_be_negative({"particle", "mass", "kg"}, settings.mass)});
}

}  // namespace pantin
