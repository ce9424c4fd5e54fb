#pragma once
// A parsed JSON document that knows where each of its values stands, so that every finding about one can be
// given as a JSON pointer. Flat arrays instead of nested containers: depth costs no stack, neither in
// building nor in destruction.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pantin::gltf {

enum class JsonKind : std::uint8_t { Null, Boolean, Number, Text, Array, Object };

/// "null", "true or false", "a number", "a text", "an array", "an object".
[[nodiscard]] std::string_view to_string(JsonKind kind) noexcept;

class JsonTree;

/// A value of a tree. Cheap to copy; valid while the tree stays where it is.
class JsonValue {
 public:
  [[nodiscard]] JsonKind kind() const noexcept;
  [[nodiscard]] std::size_t size() const noexcept;  ///< elements or members; 0 for anything else
  [[nodiscard]] JsonValue at(std::size_t i) const;  ///< element or (in order of keys) member i < size()
  [[nodiscard]] std::optional<JsonValue> find(std::string_view key) const;  ///< member of an object
  [[nodiscard]] double number() const noexcept;           ///< finite; 0 for anything but a number
  [[nodiscard]] bool boolean() const noexcept;            ///< false for anything but a boolean
  [[nodiscard]] std::string_view text() const noexcept;   ///< UTF-8; empty for anything but a text
  [[nodiscard]] std::string_view key() const noexcept;    ///< its name as a member; else empty
  [[nodiscard]] std::size_t position() const noexcept;    ///< its place among the parent's values
  [[nodiscard]] std::optional<JsonValue> parent() const;  ///< nothing for the root
  [[nodiscard]] std::uint32_t index() const noexcept { return entry_; }  ///< among all values of the tree
  /// RFC 6901, "" for the root; very long keys and pointers are shortened.
  [[nodiscard]] std::string pointer() const;

 private:
  friend class JsonTree;
  JsonValue(const JsonTree& tree, std::uint32_t entry) : tree_{&tree}, entry_{entry} {}
  const JsonTree* tree_;
  std::uint32_t entry_;
};

/// Why a text is not JSON.
struct JsonError {
  std::size_t line{1};  ///< counted from 1
  std::string text{};
};

class JsonTree {
 public:
  /// Parses strict JSON (RFC 8259) in UTF-8 of less than 2^31 bytes. Never throws for bad text: `error` says
  /// what is wrong and nothing is returned.
  [[nodiscard]] static std::optional<JsonTree> parse(std::string_view text, JsonError& error);

  [[nodiscard]] JsonValue root() const { return {*this, 0}; }
  /// All values, those that hold others before these; index 0 is the root.
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] JsonValue value(std::size_t index) const {
    return {*this, static_cast<std::uint32_t>(index)};
  }
  /// A member whose key already stands in its object, if there is one: readers disagree on what it means.
  [[nodiscard]] std::optional<JsonValue> first_duplicate() const;

 private:
  friend class JsonValue;
  friend class JsonBuilder;
  struct Entry {
    JsonKind kind{JsonKind::Null};
    std::uint32_t parent{0};    // the root is its own
    std::uint32_t position{0};  // among the parent's values
    std::uint32_t key{0};       // in texts_; 0 = none
    std::uint32_t first{0};     // Array, Object: in children_; Text: in texts_
    std::uint32_t count{0};     // Array, Object
    double number{0};           // Number, Boolean
  };
  [[nodiscard]] std::string_view key_of(std::uint32_t entry) const { return texts_[entries_[entry].key]; }

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> children_;  // members of an object sorted by key
  std::vector<std::string> texts_;
};

/// At most `bytes` bytes of UTF-8, cut between characters and ended by "..." where something is left out.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t bytes = 60);

}  // namespace pantin::gltf
