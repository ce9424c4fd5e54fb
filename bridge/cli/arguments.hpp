#pragma once
// The small languages inside command line arguments. Nothing here knows a scene: whether a name exists is
// asked later.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pantin/bridge/drive.hpp>
#include <pantin/bridge/model.hpp>

namespace pantin::cli {

/// A finite decimal number, or a quotient of two ("1/240"); independent of the locale.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
/// Numbers with commas between them, at least one.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(std::string_view text);
/// "X", "Y" or "Z", in either case.
[[nodiscard]] std::optional<UpAxis> parse_up_axis(std::string_view text);

/// NAME=VALUE: how a joint stands.
struct JointArgument {
  std::string name{};
  std::vector<double> value{};  ///< as many numbers as were given
};
/// Split at the last '='.
[[nodiscard]] std::optional<JointArgument> parse_joint(std::string_view text);

/// T:PATH=simulated|animated: a change of drive to come.
struct ToggleArgument {
  double time{0};  ///< [s], >= 0
  std::string path{};
  Drive drive{Drive::Physics};
};
/// Split at the first ':' and the last '='.
[[nodiscard]] std::optional<ToggleArgument> parse_toggle(std::string_view text);

// What is wrong with an argument, as the command line library wants it: empty if nothing is.
[[nodiscard]] std::string complaint_about_positive(const std::string& text);
[[nodiscard]] std::string complaint_about_number(const std::string& text);
[[nodiscard]] std::string complaint_about_vector(const std::string& text);
[[nodiscard]] std::string complaint_about_up_axis(const std::string& text);
[[nodiscard]] std::string complaint_about_joint(const std::string& text);
[[nodiscard]] std::string complaint_about_toggle(const std::string& text);
[[nodiscard]] std::string complaint_about_trajectory_file(const std::string& text);

}  // namespace pantin::cli
