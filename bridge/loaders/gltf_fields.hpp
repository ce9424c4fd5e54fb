#pragma once
// Typed reading of JSON members for the glTF reader: what is missing or of the wrong type is refused by its
// place, and what is read is marked so.
#include <array>
#include <cstdint>

#include "gltf_report.hpp"

namespace pantin::gltf {

/// Refuses a value of another kind, without reading it.
void check_kind(Report& report, const JsonValue& value, JsonKind kind);
/// The value itself if it is of this kind; else refused.
JsonValue expect(Report& report, const JsonValue& value, JsonKind kind);
/// A member that must be there.
[[nodiscard]] JsonValue require(Report& report, const JsonValue& object, std::string_view key);
/// A member of a kind, or nothing.
[[nodiscard]] std::optional<JsonValue> member(Report& report, const JsonValue& object, std::string_view key,
                                              JsonKind kind);

[[nodiscard]] double to_number(Report& report, const JsonValue& value);
/// A whole number from 0 to 2^53.
[[nodiscard]] std::uint64_t to_size(Report& report, const JsonValue& value);
/// Member `key` as such a number, or `fallback` where there is none.
[[nodiscard]] std::uint64_t size_or(Report& report, const JsonValue& object, std::string_view key,
                                    std::uint64_t fallback);
/// A text member, or "".
[[nodiscard]] std::string_view text_or_empty(Report& report, const JsonValue& object, std::string_view key);
[[nodiscard]] bool flag_or_false(Report& report, const JsonValue& object, std::string_view key);

/// Fills `numbers` from an array of exactly that many.
void to_numbers(Report& report, const JsonValue& value, double* numbers, std::size_t count);

template <std::size_t N>
[[nodiscard]] std::optional<std::array<double, N>> numbers(Report& report, const JsonValue& object,
                                                           std::string_view key) {
  const std::optional<JsonValue> value = object.find(key);
  if (!value) return std::nullopt;
  std::array<double, N> result{};
  to_numbers(report, *value, result.data(), N);
  return result;
}

}  // namespace pantin::gltf
