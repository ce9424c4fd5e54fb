#include <pantin/bridge/loaders/urdf_numbers.hpp>

#include <tinyxml2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace pantin::urdf_loader {
namespace {

constexpr std::string_view kBlank = " \t\r\n\f\v";

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t begin = text.find_first_not_of(kBlank); begin != std::string_view::npos;) {
    const std::size_t end = text.find_first_of(kBlank, begin);
    words.push_back(text.substr(begin, end == std::string_view::npos ? end : end - begin));
    begin = text.find_first_not_of(kBlank, end);
  }
  return words;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 60;
  return '\'' + (text.size() > kMost ? std::string{text.substr(0, kMost)} + "..." : std::string{text}) + '\'';
}

std::string remedy_for(std::string_view word) {
  if (word.find("${") != std::string_view::npos || word.find("$(") != std::string_view::npos) {
    return "expand the xacro file first: xacro FILE > robot.urdf";
  }
  if (word.find(',') != std::string_view::npos)
    return "write decimals with a point and values with spaces between";
  return "write a finite decimal number";
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // from_chars does not say which way: with a negative exponent it was too small (a mantissa of hundreds of
    // digits that would make this wrong is nothing that a robot holds, and is refused below).
    const std::size_t exponent = text.find_first_of("eE");
    const bool tiny = exponent != std::string_view::npos && text.substr(exponent + 1).starts_with('-');
    return tiny && text.size() < 300 ? std::optional{0.0} : std::nullopt;
  }
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

bool read_numbers(tinyxml2::XMLElement& element, const char* name, std::span<double> out,
                  const std::string& subject, Ledger& ledger) {
  const char* text = element.Attribute(name);
  if (text == nullptr) return false;
  const std::string attribute = std::string{"attribute "} + name + " of <" + element.Name() + ">";
  const std::vector<std::string_view> words = split(text);
  if (words.size() != out.size()) {
    const std::string needed = std::to_string(out.size()) + (out.size() == 1 ? " number" : " numbers");
    ledger.error(
        {element.GetLineNum(), subject,
         attribute + " needs " + needed + ", has " + std::to_string(words.size()) + ": " + shortened(text),
         std::string_view{text}.find(',') != std::string_view::npos
             ? remedy_for(text)
             : "write " + needed + (out.size() > 1 ? " with spaces between" : "")});
    return false;
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::optional<double> value = parse_number(words[i]);
    if (!value) {
      ledger.error({element.GetLineNum(), subject,
                    attribute + " is not a finite number: " + shortened(words[i]), remedy_for(words[i])});
      return false;
    }
    out[i] = *value;
  }
  write_numbers(element, name, out);
  return true;
}

void write_numbers(tinyxml2::XMLElement& element, const char* name, std::span<const double> values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ' ';
    text += number_text(value);
  }
  element.SetAttribute(name, text.c_str());
}

bool has_attribute(const tinyxml2::XMLElement& element, const char* name) {
  return element.Attribute(name) != nullptr;
}

}  // namespace pantin::urdf_loader
