#pragma once
// Reads one JSON object key by key and says what is wrong with each at its JSON pointer. Private to the
// reader of reference problems. A value that cannot be read becomes a default and an error stands in the
// ledger: so one pass finds everything that is wrong.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/physics/pose.hpp>

#include "json_document.hpp"

namespace pantin::reference {

class ObjectReader {
 public:
  /// `value` must be an object; otherwise that is the error and everything reads as absent without further
  /// errors. `place` is file#/pointer, `subject` who the object is in messages.
  ObjectReader(const JsonValue& value, std::string place, std::string subject,
               std::vector<Diagnostic>& ledger);
  /// Warns of the keys that nobody asked for.
  ~ObjectReader();
  ObjectReader(const ObjectReader&) = delete;
  ObjectReader& operator=(const ObjectReader&) = delete;

  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  // Required: absent is an error.
  [[nodiscard]] double number(std::string_view key);
  [[nodiscard]] std::string text(std::string_view key);
  [[nodiscard]] Vector3 vector3(std::string_view key);
  [[nodiscard]] Vector3 unit_vector3(std::string_view key);
  [[nodiscard]] Quaternion quaternion(std::string_view key);  ///< [w, x, y, z], unit within 1e-9; normalised
  [[nodiscard]] Matrix3 matrix3(std::string_view key);        ///< rows
  [[nodiscard]] const std::vector<JsonValue>& list(std::string_view key);
  // Optional: absent is nothing.
  [[nodiscard]] std::optional<double> number_if(std::string_view key);
  [[nodiscard]] std::optional<std::string> text_if(std::string_view key);
  [[nodiscard]] std::optional<Vector3> vector3_if(std::string_view key);
  [[nodiscard]] std::optional<Quaternion> quaternion_if(std::string_view key);
  [[nodiscard]] const JsonValue* object_if(std::string_view key);
  [[nodiscard]] const std::vector<JsonValue>& list_if(std::string_view key);

  /// Keys that are known and not needed.
  void skip(std::initializer_list<std::string_view> keys);
  /// All keys: for objects whose keys are names.
  void skip_all();

  void set_subject(std::string subject) { subject_ = std::move(subject); }
  [[nodiscard]] const std::string& subject() const { return subject_; }
  [[nodiscard]] const JsonValue& value() const { return value_; }
  [[nodiscard]] std::string place(std::string_view key) const { return place_ + '/' + pointer_token(key); }
  void error(std::string_view key, std::string problem, std::string remedy) const;
  void warn(std::string_view key, std::string problem, std::string remedy) const;

 private:
  [[nodiscard]] const JsonValue* find(std::string_view key) const;
  const JsonValue* take(std::string_view key, JsonKind kind);  ///< null where absent or of another kind
  const JsonValue* take_required(std::string_view key, JsonKind kind);
  /// Whether it may be computed with; an error where it may not.
  bool is_sensible(std::string_view key, const JsonValue& number);
  std::optional<Eigen::VectorXd> numbers(std::string_view key, const JsonValue& list, std::size_t count);
  void missing(std::string_view key);

  const JsonValue& value_;
  std::string place_, subject_;
  std::vector<Diagnostic>& ledger_;
};

/// The 'type' of an object; nothing, and an error, where it has none or it is no text.
[[nodiscard]] std::optional<std::string> read_type(ObjectReader& reader);
/// Names a type that the reader does not know; the other keys mean nothing then.
void refuse_type(ObjectReader& reader, const std::optional<std::string>& type, const char* known);

/// How much a quaternion or an axis in a file may miss unit length: what twelve printed digits leave.
inline constexpr double kUnitTolerance = 1e-9;

}  // namespace pantin::reference
