#include <pantin/bridge/cli/text_table.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <pantin/bridge/diagnostic.hpp>

namespace pantin::cli {
namespace {

constexpr std::size_t kWidestPadding = 80;  // longer cells stand out rather than widen all rows

/// Characters on the screen: bytes that do not continue a UTF-8 sequence.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::string short_number(double number) {
  std::array<char, 32> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::general, 6);
  return {text.data(), error == std::errc{} ? end : text.data()};
}

std::string short_seconds(double seconds) {
  const double whole = std::round(1 / seconds);
  const bool is_decimal = std::abs(seconds * 1e4 - std::round(seconds * 1e4)) < 1e-9;
  if (seconds < 1 && !is_decimal && std::abs(seconds * whole - 1) < 1e-12)
    return "1/" + short_number(whole) + " s";
  return short_number(seconds) + " s";
}

std::string counted(std::size_t count, const char* singular, const char* plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

void TextTable::print(std::ostream& out, const std::string& indent) const {
  std::vector<std::vector<std::string>> shown = rows_;
  std::vector<std::size_t> widths;
  for (std::vector<std::string>& row : shown) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = printable(row[i]);
      widths[i] = std::max(widths[i], std::min(width_of(row[i]), kWidestPadding));
    }
  }
  for (const std::vector<std::string>& row : shown) {
    std::string line = indent;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += row[i];
      if (i + 1 < row.size()) line.append(widths[i] - std::min(width_of(row[i]), widths[i]) + 2, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << '\n';
  }
}

}  // namespace pantin::cli
