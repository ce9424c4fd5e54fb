#pragma once
// Writes JSON as it becomes known, so that a long run needs no more memory than one sample. Texts and numbers
// are formatted by nlohmann-json: numbers read back to the same double, bytes that are not UTF-8 become
// U+FFFD.
#include <cstdint>
#include <ostream>
#include <span>
#include <string_view>
#include <vector>

#include <pantin/scenegraph/affine.hpp>

namespace pantin {

/// How the values of an array or object are laid out.
enum class JsonLayout {
  Compact,  ///< on one line
  Lines,    ///< each on a line of its own
};

/// A value follows `key` in an object, nothing in an array. Objects and arrays have to be closed in order;
/// one that is open inside another belongs to it.
class JsonStream {
 public:
  explicit JsonStream(std::ostream& out) : out_{out} {}

  JsonStream& begin_object(JsonLayout layout = JsonLayout::Compact);
  JsonStream& end_object();
  JsonStream& begin_array(JsonLayout layout = JsonLayout::Compact);
  JsonStream& end_array();
  JsonStream& key(std::string_view name);

  JsonStream& value(double number);  ///< null where it is not finite
  JsonStream& value(std::int64_t number);
  JsonStream& value(std::size_t number) { return value(static_cast<std::int64_t>(number)); }
  JsonStream& value(bool truth);
  JsonStream& value(std::string_view text);
  JsonStream& value(const char* text) { return value(std::string_view{text}); }
  JsonStream& null();
  JsonStream& value(std::span<const double> numbers);  ///< an array
  JsonStream& value(const Vector3& v);                 ///< [x, y, z]
  JsonStream& value(const Quaternion& q);              ///< [w, x, y, z]
  JsonStream& value(const Matrix3& m);                 ///< three rows
  JsonStream& value(const Affine& M);                  ///< four rows, the last one [0, 0, 0, 1]

  /// key and value in one.
  template <class T>
  JsonStream& member(std::string_view name, const T& content) {
    return key(name).value(content);
  }

 private:
  struct Open {
    JsonLayout layout{JsonLayout::Compact};
    bool empty{true};
  };
  void separate();
  void open(char bracket, JsonLayout layout);
  void close(char bracket);

  std::ostream& out_;
  std::vector<Open> open_{};
  bool after_key_{false};
};

}  // namespace pantin
