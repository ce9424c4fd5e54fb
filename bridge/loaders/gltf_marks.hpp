#pragma once
// What became of the values of one document: each typed read leaves a mark, and so does everything that is
// left out on purpose. What has no mark in the end was overlooked.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "gltf_json.hpp"

namespace pantin::gltf {

class Marks {
 public:
  /// The value was read; what it holds has marks of its own.
  void read(const JsonValue& value) { at(value).is_read = true; }
  /// It was read, and another value is in the model.
  void convert(const JsonValue& value, const std::string& why);
  /// It is left out with all that it holds, whether that was read or not.
  void drop(const JsonValue& value, const std::string& why);
  /// The object's members are those that glTF 2.0 knows: what is not read of them is not needed.
  void know(const JsonValue& object) { at(object).is_known = true; }

  [[nodiscard]] bool is_read(const JsonValue& value) const { return state(value).is_read; }
  [[nodiscard]] bool is_known(const JsonValue& value) const { return state(value).is_known; }
  [[nodiscard]] bool is_dropped(const JsonValue& value) const { return state(value).is_dropped; }
  /// Why it was converted or dropped; empty where it was neither.
  [[nodiscard]] const std::string& why(const JsonValue& value) const { return reasons_[state(value).why]; }

 private:
  struct State {
    std::uint32_t why{0};  // in reasons_
    bool is_read{false}, is_known{false}, is_dropped{false};
  };
  State& at(const JsonValue& value);
  [[nodiscard]] State state(const JsonValue& value) const;
  [[nodiscard]] std::uint32_t reason(const std::string& why);

  std::vector<State> states_{};  // by JsonValue::index()
  std::vector<std::string> reasons_{std::string{}};
  std::map<std::string, std::uint32_t> positions_{};  // in reasons_
};

}  // namespace pantin::gltf
