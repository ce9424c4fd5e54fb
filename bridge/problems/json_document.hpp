#pragma once
// A JSON document as a plain tree, for readers that want to say where a value stands. Private to the reader
// of reference problems; the parser stays in the source file.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>

namespace pantin::reference {

enum class JsonKind { Null, Boolean, Number, Text, Array, Object };
/// "null", "true or false", "a number", "a text", "a list", "an object".
[[nodiscard]] std::string_view to_string(JsonKind kind) noexcept;

/// What a reader made of a value.
enum class JsonUse : char {
  Unseen,     ///< nobody asked for it
  Read,       ///< with what it holds, unless that says otherwise
  NotNeeded,  ///< known, and left out
  Unknown,    ///< left out, which was told
};

struct JsonValue {
  JsonKind kind{JsonKind::Null};
  bool boolean{false};
  double number{0};  ///< finite
  std::string text{};
  std::vector<JsonValue> elements{};
  std::vector<std::pair<std::string, JsonValue>> members{};  ///< in the order of the file, keys unique
  mutable JsonUse use{JsonUse::Unseen};  ///< kept by the reader, and no part of what the value says
};

/// Deepest nesting that is read; a document of plain data needs less than ten.
inline constexpr int kMaxJsonDepth = 64;

/// Parses RFC 8259 JSON. Errors stand at `file:line`: bad syntax, numbers beyond double, nesting deeper than
/// kMaxJsonDepth, a key twice in one object.
[[nodiscard]] Loaded<JsonValue> parse_json(std::string_view text, const std::string& file);

/// `key` as a token of a JSON pointer: ~ becomes ~0 and / becomes ~1 (RFC 6901, section 3).
[[nodiscard]] std::string pointer_token(std::string_view key);

}  // namespace pantin::reference
