#pragma once
// Runs reference problems and measures how far from their samples the engine ends up.
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <pantin/bridge/problems/rigid_ref.hpp>

namespace pantin::test {

struct RunSettings {
  std::string integrator{"rk4"};  ///< a name of the catalogue
  double tolerance{0};  ///< above 0: dormand-prince at this tolerance, whatever the integrator's name
  double step{1e-3};    ///< > 0 [s]; shortened so that samples are hit exactly
  int refinement{1};    ///< cuts every step into so many equal ones
  double until{
      std::numeric_limits<double>::infinity()};  ///< last sample that counts [s]; never after the duration
};

/// Maxima over samples and bodies.
struct RunErrors {
  double position{0};       ///< distance of the centres of gravity [m]
  double attitude{0};       ///< attitude_error [rad]
  double energy{0};         ///< of the total, relative to the greatest energy in the samples
  double joint_drift{0};    ///< [m] or [rad], whichever is greater
  std::size_t compared{0};  ///< states
  std::string failure{};    ///< of a step that could not be done; empty if all were
};

/// Angle between two attitudes, 2 atan2(|vec(conj(q) q_ref)|, |scalar|) [rad]: exact for small angles too.
[[nodiscard]] double attitude_error(const Quaternion& q, const Quaternion& q_ref);

/// Builds the problem in a fresh manager and runs it over its samples. The problem must be one that can be
/// built.
[[nodiscard]] RunErrors run(const ReferenceProblem& problem, const RunSettings& settings);

/// The problems in a folder, in the order of their names.
[[nodiscard]] std::vector<std::filesystem::path> problems_in(const std::filesystem::path& folder);

/// The folder of the reference problems, which are kept beside a checkout rather than in it:
/// PANTIN_PROBLEMS_DIR if set, else a folder `problems` in a neighbour of the source folder whose INDEX.md
/// names the schema. Empty if none.
[[nodiscard]] std::filesystem::path reference_folder();

/// The folder of the problems that come with the sources.
[[nodiscard]] std::filesystem::path own_folder();

/// The value, or a test failure with all notes and nothing.
[[nodiscard]] std::optional<ReferenceProblem> loaded(const std::filesystem::path& file);

/// All notes, a line each.
[[nodiscard]] std::string lines(const std::vector<Diagnostic>& notes);

/// A file name as the name of a test: letters, digits and underscores.
[[nodiscard]] std::string test_name(const std::filesystem::path& file);

}  // namespace pantin::test
