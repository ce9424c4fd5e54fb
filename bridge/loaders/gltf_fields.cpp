#include "gltf_fields.hpp"

#include <cmath>

namespace pantin::gltf {

void check_kind(Report& report, const JsonValue& value, JsonKind kind) {
  if (value.kind() != kind)
    report.refuse(
        value,
        std::string{to_string(value.kind())} + " stands where " + std::string{to_string(kind)} + " must be",
        "write " + std::string{to_string(kind)});
}

JsonValue expect(Report& report, const JsonValue& value, JsonKind kind) {
  check_kind(report, value, kind);
  report.marks().read(value);
  return value;
}

JsonValue require(Report& report, const JsonValue& object, std::string_view key) {
  expect(report, object, JsonKind::Object);
  if (const std::optional<JsonValue> found = object.find(key)) return *found;
  report.refuse(object, "'" + std::string{key} + "' is missing", "add it: glTF 2.0 requires it here");
}

std::optional<JsonValue> member(Report& report, const JsonValue& object, std::string_view key,
                                JsonKind kind) {
  const std::optional<JsonValue> found = object.find(key);
  if (found) expect(report, *found, kind);
  return found;
}

double to_number(Report& report, const JsonValue& value) {
  return expect(report, value, JsonKind::Number).number();
}

std::uint64_t to_size(Report& report, const JsonValue& value) {
  const double number = to_number(report, value);
  if (!(number >= 0 && number <= 9007199254740992.0 && number == std::floor(number)))
    report.refuse(value, "the number is not a whole number from 0 to 2^53",
                  "write an index, count or offset");
  return static_cast<std::uint64_t>(number);
}

std::uint64_t size_or(Report& report, const JsonValue& object, std::string_view key, std::uint64_t fallback) {
  const std::optional<JsonValue> found = object.find(key);
  return found ? to_size(report, *found) : fallback;
}

std::string_view text_or_empty(Report& report, const JsonValue& object, std::string_view key) {
  const std::optional<JsonValue> found = member(report, object, key, JsonKind::Text);
  return found ? found->text() : std::string_view{};
}

bool flag_or_false(Report& report, const JsonValue& object, std::string_view key) {
  const std::optional<JsonValue> found = member(report, object, key, JsonKind::Boolean);
  return found && found->boolean();
}

void to_numbers(Report& report, const JsonValue& value, double* numbers, std::size_t count) {
  expect(report, value, JsonKind::Array);
  if (value.size() != count)
    report.refuse(value,
                  "has " + std::to_string(value.size()) + " numbers instead of " + std::to_string(count),
                  "write exactly " + std::to_string(count));
  for (std::size_t i = 0; i < count; ++i) numbers[i] = to_number(report, value.at(i));
}

}  // namespace pantin::gltf
