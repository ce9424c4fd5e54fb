#pragma once
// Solves reference problems and measures what came out: errors against the samples, drift, and cost. It
// prints nothing.
#include <optional>
#include <string>
#include <vector>

#include <pantin/bridge/problems/reference_problem.hpp>
#include <pantin/bridge/problems/solver_choice.hpp>

namespace pantin {

struct SolveSettings {
  std::string integrator{"auto"};  ///< "auto" or a name that make_integrator knows
  /// Local error per unit time of body position [m/s] and attitude [rad/s], > 0; for integrators that control
  /// their steps.
  double tolerance{1e-9};
  /// Steps of this length, shortened to land on samples [s], > 0; nothing = as the tolerance needs. Must be
  /// given for integrators without control of their steps.
  std::optional<double> step{};
  int repeats{1};  ///< runs to take the shortest time of, >= 1
};

/// Why these settings cannot be used, with the remedy.
[[nodiscard]] std::optional<SettingsProblem> problem_with(const SolveSettings& settings);

enum class SolveStatus {
  Ok,
  Refused,  ///< the problem holds what cannot be read or built: nothing was run
  Failed,   ///< a step could not be done; states and errors go as far as they came
};
[[nodiscard]] std::string to_string(SolveStatus status);

/// Everything that moves at one time.
struct SolvedState {
  double t{0};                            ///< [s]
  std::vector<reference::Body> bodies{};  ///< in the order of the problem; masses are not filled in
  std::vector<reference::Particle> particles{};
};

struct SolveResult {
  std::string problem{};  ///< its name
  SolveStatus status{SolveStatus::Ok};
  std::string integrator{};  ///< name; of all islands, where they go by several
  // Greatest over samples and bodies; nothing where the samples do not say.
  std::optional<double> position_error{};  ///< of the centre of gravity [m]
  std::optional<double> attitude_error{};  ///< angle between the attitudes [rad]
  std::optional<double> velocity_error{};  ///< of the centre of gravity [m/s]
  /// Greatest difference of the total energy from that of the samples, or, where they give none and nothing
  /// takes energy away, from that of the start; relative to the greatest part of it.
  std::optional<double> energy_drift{};
  double joint_drift{0};  ///< greatest distance by which bodies miss their joints [m]
  long steps{0};          ///< that the integrator took
  long evaluations{0};    ///< of the derivative
  double cpu_seconds{0};  ///< of the stepping, least of the repeats, and of a run that was thrown away
  double loop_margin{1};  ///< least StepReport::loop_margin
  std::vector<IslandChoice> islands{};  ///< as they were run
  std::vector<std::string> messages{};
  std::vector<SolvedState> states{};  ///< at every sample time; at the end where there is no sample
};

/// Builds the problem and runs it over its samples. `auto` gives each island the solver that suits it, and
/// integrates loops like trees; where they come near singular positions the run is thrown away and
/// dormand-prince takes short steps in islands with loops instead. Where `auto` fails
/// at the tolerance, as near singular positions of loops it may, it is tried at stricter ones, and a message
/// says so.
[[nodiscard]] SolveResult solve(const ReferenceProblem& problem, const SolveSettings& settings);

}  // namespace pantin
