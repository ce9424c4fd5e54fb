// What may be asked of solve(), and how its outcome is called.
#include <cmath>

#include <pantin/bridge/problems/solve.hpp>
#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

std::optional<SettingsProblem> problem_with(const SolveSettings& settings) {
  if (settings.integrator != "auto" && make_integrator(settings.integrator) == nullptr) {
    return SettingsProblem{ProblemCode::OutOfRange, "no integrator is called '" + settings.integrator + "'",
                           "give auto or one that integrator_names() lists"};
  }
  const bool controlled = settings.integrator == "auto" || make_integrator(settings.integrator, 1) != nullptr;
  if (!settings.step && !controlled) {
    return SettingsProblem{ProblemCode::OutOfRange,
                           "integrator '" + settings.integrator + "' keeps to no tolerance", "give a step"};
  }
  if (settings.step && !(*settings.step > 0 && std::isfinite(*settings.step))) {
    return SettingsProblem{ProblemCode::OutOfRange, "the step is not finite and above zero",
                           "give a step in seconds"};
  }
  if (!(settings.tolerance > 0 && std::isfinite(settings.tolerance))) {
    return SettingsProblem{ProblemCode::OutOfRange, "the tolerance is not finite and above zero",
                           "give an error per second"};
  }
  if (settings.repeats < 1)
    return SettingsProblem{ProblemCode::OutOfRange, "repeats are fewer than one", "give at least one"};
  return {};
}

std::string to_string(SolveStatus status) {
  return status == SolveStatus::Ok ? "ok" : status == SolveStatus::Refused ? "refused" : "failed";
}

}  // namespace pantin
