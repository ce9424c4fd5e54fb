#include <pantin/physics/deflector.hpp>

#include <string>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {

std::optional<SettingsProblem> problem_with(const DeflectorMount& on, std::string_view kind) {
  return first_problem({must_be_finite({kind, "position", "m"}, on.X_BD.p),
                        must_be_unit({kind, "orientation", ""}, on.X_BD.q)});
}

std::optional<SettingsProblem> problem_with(const SurfaceSettings& surface, std::string_view kind) {
  if (surface.restitution > 1) {
    return SettingsProblem{
        ProblemCode::OutOfRange,
        std::string{kind} + ": restitution is " + text_of(surface.restitution) + "; it must be at most 1",
        "give a restitution from 0 to 1"};
  }
  return first_problem({must_not_be_negative({kind, "restitution", ""}, surface.restitution),
                        must_not_be_negative({kind, "friction", ""}, surface.friction),
                        must_not_be_negative({kind, "stickiness", "m/s"}, surface.stickiness)});
}

}  // namespace pantin
