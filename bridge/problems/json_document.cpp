#include "json_document.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace pantin::reference {
namespace {

/// Builds the tree from the parser's events. Returning false stops the parser.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Builder(JsonValue& root) : root_{root} {}

  bool null() override { return add({}); }
  bool boolean(bool value) override { return add({.kind = JsonKind::Boolean, .boolean = value}); }
  bool number_integer(number_integer_t value) override { return add_number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return add_number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return add_number(value); }
  bool string(string_t& value) override { return add({.kind = JsonKind::Text, .text = std::move(value)}); }
  bool binary(binary_t&) override { return fail("holds binary data, which is not JSON"); }
  bool start_object(std::size_t) override { return open(JsonKind::Object); }
  bool start_array(std::size_t) override { return open(JsonKind::Array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    const auto& members = open_.back()->members;
    if (std::any_of(members.begin(), members.end(), [&](const auto& m) { return m.first == name; })) {
      return fail("key '" + name + "' stands twice in one object");
    }
    key_ = std::move(name);
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    position_ = position;
    return fail(plain(error.what()));
  }

  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] std::size_t position() const { return position_; }  ///< in bytes; 0 = not known

 private:
  bool add_number(double value) { return add({.kind = JsonKind::Number, .number = value}); }
  bool add(JsonValue value) { return place(std::move(value)) != nullptr; }
  JsonValue* place(JsonValue value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    JsonValue& parent = *open_.back();
    if (parent.kind == JsonKind::Object) {
      return &parent.members.emplace_back(std::move(key_), std::move(value)).second;
    }
    return &parent.elements.emplace_back(std::move(value));
  }
  bool open(JsonKind kind) {
    if (open_.size() >= kMaxJsonDepth) {
      return fail("is nested deeper than " + std::to_string(kMaxJsonDepth) + " levels");
    }
    // Pointers stay valid: a container grows only while it is the innermost open one.
    open_.push_back(place({.kind = kind}));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }
  bool fail(std::string problem) {
    problem_ = std::move(problem);
    return false;
  }
  /// The parser's message without its number and place, which are given otherwise.
  static std::string plain(std::string what) {
    for (const std::string_view end : {"] ", ": "}) {
      const std::size_t at = what.find(end);
      if (at != std::string::npos) what.erase(0, at + end.size());
    }
    return what;
  }

  JsonValue& root_;
  std::vector<JsonValue*> open_;
  std::string key_;
  std::string problem_;
  std::size_t position_{0};
};

}  // namespace

std::string_view to_string(JsonKind kind) noexcept {
  switch (kind) {
    case JsonKind::Null:
      return "null";
    case JsonKind::Boolean:
      return "true or false";
    case JsonKind::Number:
      return "a number";
    case JsonKind::Text:
      return "a text";
    case JsonKind::Array:
      return "a list";
    case JsonKind::Object:
      break;
  }
  return "an object";
}

std::string pointer_token(std::string_view key) {
  std::string token;
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

Loaded<JsonValue> parse_json(std::string_view text, const std::string& file) {
  JsonValue root;
  Builder builder{root};
  if (nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) return {std::move(root), {}};
  std::string place = file;
  if (builder.position() > 0) {
    const auto end =
        text.begin() + static_cast<std::ptrdiff_t>(std::min(builder.position() - 1, text.size()));
    place += ':' + std::to_string(1 + std::count(text.begin(), end, '\n'));
  }
  return {{}, {{Severity::Error, std::move(place), "JSON", builder.problem(), "mend the file"}}};
}

}  // namespace pantin::reference
