#pragma once
// What `pantin run` was asked to do.
#include <optional>
#include <string>
#include <vector>

#include <pantin/bridge/bridge.hpp>
#include <pantin/bridge/cli/arguments.hpp>
#include <pantin/bridge/cli/common_options.hpp>
#include <pantin/bridge/cli/exit_code.hpp>

namespace pantin::cli {

struct RunOptions {
  CommonOptions common{};
  std::vector<std::string> models{};    ///< files, at least one
  std::vector<std::string> simulate{};  ///< paths, or "all"
  std::vector<std::string> animate{};   ///< PATH or PATH=CLIP, or "all", or "none"; empty = "all"
  std::vector<std::string> joints{};    ///< NAME=VALUE, as parse_joint takes them
  std::vector<ToggleArgument> toggles{};
  double duration{5};                ///< [s], > 0
  double step{1.0 / 240};            ///< [s], > 0
  double every{1.0 / 60};            ///< [s], > 0
  double tolerance{1e-9};            ///< of integrators that choose their steps [m/s] and [rad/s], > 0
  bool adaptive{false};              ///< updates as long as samples and toggles let them be
  bool unwatched{false};             ///< steps as asked for, borne or not
  std::string integrator{"rk4"};     ///< a name that make_integrator knows
  std::optional<UpAxis> up{};        ///< nothing = the first model's
  std::optional<Vector3> gravity{};  ///< [m/s^2]; nothing = 9.81 against the up axis
  Base base{Base::Fixed};
  bool free_joints{false};         ///< without limits and dry friction
  std::vector<std::string> out{};  ///< files, each .csv or .json
};

/// Loads, prepares, simulates and reports.
[[nodiscard]] ExitCode run(const RunOptions& options);

}  // namespace pantin::cli
