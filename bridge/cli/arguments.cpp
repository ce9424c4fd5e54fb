#include <pantin/bridge/cli/arguments.hpp>

#include <charconv>
#include <cmath>
#include <filesystem>

namespace pantin::cli {
namespace {

std::optional<double> parse_decimal(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  if (error != std::errc{} || end != last || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::string not_understood(const std::string& text, std::string_view wanted) {
  return "'" + text + "' is not " + std::string{wanted};
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  const std::size_t slash = text.find('/');
  const std::optional<double> numerator = parse_decimal(text.substr(0, slash));
  if (slash == std::string_view::npos || !numerator) return numerator;
  const std::optional<double> denominator = parse_decimal(text.substr(slash + 1));
  if (!denominator || !std::isfinite(*numerator / *denominator)) return std::nullopt;
  return *numerator / *denominator;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    const std::size_t comma = text.find(',');
    const std::optional<double> number = parse_number(text.substr(0, comma));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

std::optional<UpAxis> parse_up_axis(std::string_view text) {
  if (text == "X" || text == "x") return UpAxis::X;
  if (text == "Y" || text == "y") return UpAxis::Y;
  if (text == "Z" || text == "z") return UpAxis::Z;
  return std::nullopt;
}

std::optional<JointArgument> parse_joint(std::string_view text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string_view::npos || equals == 0) return std::nullopt;
  const std::optional<std::vector<double>> value = parse_numbers(text.substr(equals + 1));
  if (!value) return std::nullopt;
  return JointArgument{std::string{text.substr(0, equals)}, *value};
}

std::optional<ToggleArgument> parse_toggle(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::size_t equals = text.rfind('=');
  if (colon == std::string_view::npos || equals == std::string_view::npos || equals < colon + 2)
    return std::nullopt;
  const std::optional<double> time = parse_number(text.substr(0, colon));
  if (!time || *time < 0) return std::nullopt;
  ToggleArgument toggle{*time, std::string{text.substr(colon + 1, equals - colon - 1)}};
  for (const Drive drive : {Drive::Physics, Drive::Scene}) {
    if (text.substr(equals + 1) != to_string(drive)) continue;
    toggle.drive = drive;
    return toggle;
  }
  return std::nullopt;
}

std::string complaint_about_positive(const std::string& text) {
  const std::optional<double> number = parse_number(text);
  return number && *number > 0 ? "" : not_understood(text, "a number greater than 0 (\"0.005\", \"1/240\")");
}

std::string complaint_about_number(const std::string& text) {
  return parse_number(text) ? "" : not_understood(text, "a finite number");
}

std::string complaint_about_vector(const std::string& text) {
  const std::optional<std::vector<double>> numbers = parse_numbers(text);
  return numbers && numbers->size() == 3 ? "" : not_understood(text, "three numbers X,Y,Z (\"0,0,-9.81\")");
}

std::string complaint_about_up_axis(const std::string& text) {
  return parse_up_axis(text) ? "" : not_understood(text, "one of X, Y, Z");
}

std::string complaint_about_joint(const std::string& text) {
  return parse_joint(text) ? ""
                           : not_understood(text, "NAME=VALUE (\"elbow=0.5\"; \"wrist=1,0,0,0\" for a ball)");
}

std::string complaint_about_toggle(const std::string& text) {
  return parse_toggle(text) ? ""
                            : not_understood(text, "T:PATH=simulated or T:PATH=animated with a time T >= 0");
}

std::string complaint_about_trajectory_file(const std::string& text) {
  const std::string extension = std::filesystem::path{text}.extension().string();
  return extension == ".csv" || extension == ".json"
             ? ""
             : not_understood(text, "a file name that ends in .csv or .json");
}

}  // namespace pantin::cli
