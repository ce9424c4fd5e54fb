#pragma once
// Numbers in URDF attributes, read strictly: no decimal comma, no unit, no NaN or infinity, no more and no
// fewer than asked for, whatever the locale.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <pantin/bridge/loaders/urdf_ledger.hpp>

namespace tinyxml2 {
class XMLElement;
}

namespace pantin::urdf_loader {

/// A number as a whole; nothing where `text` is anything else, or too large for a double. Too small becomes
/// 0.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The shortest text that reads back as the same double.
[[nodiscard]] std::string number_text(double value);

/// Reads attribute `name` into all of `out` and rewrites it with single spaces, as urdfdom needs it. False
/// where the attribute is missing (no finding) or bad (an error in the ledger about `subject`).
bool read_numbers(tinyxml2::XMLElement& element, const char* name, std::span<double> out,
                  const std::string& subject, Ledger& ledger);

/// Overwrites an attribute with numbers.
void write_numbers(tinyxml2::XMLElement& element, const char* name, std::span<const double> values);

/// Whether the element has the attribute at all, readable or not.
[[nodiscard]] bool has_attribute(const tinyxml2::XMLElement& element, const char* name);

}  // namespace pantin::urdf_loader
