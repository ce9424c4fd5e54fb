#pragma once
// What the readers of OBJ, STL and PLY have in common: parts of triangles, what was left out, how damage is
// said, and words and numbers of text.
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pantin/physics/shape.hpp>

namespace pantin::geometry_loader {

/// A named piece of a file: an object or group of OBJ, a solid of STL.
struct Part {
  std::string name{};  ///< may be empty
  TriangleMesh mesh{};
};

/// How often something came up, and where first.
struct Tally {
  std::size_t count{0};
  std::uint64_t line{0};  ///< in text, from 1; 0 = not known
  void add(std::size_t more, std::uint64_t its_line = 0) {
    if (count == 0) line = its_line;
    count += more;
  }
};

struct Content {
  std::vector<Part> parts{};                  ///< each with a triangle at least
  std::map<std::string, Tally> not_needed{};  ///< what physics has no use for: "normals" -> 12
  std::map<std::string, Tally> dropped{};     ///< what was lost: "points or lines" -> 2
};

/// Thrown by the readers where a file is damaged; ends in load_geometry.
struct Damage {
  std::uint64_t line{0};  ///< in text, from 1; 0 = none
  std::string problem{};  ///< in binary it names the byte
};

/// Triangles of one polygon: ears are clipped in its plane (Newell's normal), so that concave ones come out
/// right; what is left of one that crosses itself is cut as a fan. Appends to `out`.
void triangulate(std::span<const std::uint32_t> corners, std::span<const Vector3> vertices,
                 std::vector<std::array<std::uint32_t, 3>>& out);
inline constexpr std::size_t kMostCorners = 1000;  ///< of one polygon, as time grows with their square

/// Takes away triangles with two equal corners and vertices that none uses, and counts both.
void clean(TriangleMesh& mesh, Content& content);

/// A decimal number as a whole, finite, whatever the locale; a leading + is allowed.
[[nodiscard]] std::optional<double> number_of(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> integer_of(std::string_view word);

/// Words of a text, between blanks, with their lines.
class Words {
 public:
  explicit Words(std::string_view text, std::uint64_t line = 1) : text_{text}, line_{line} {}
  /// The next word; empty at the end.
  std::string_view next();
  /// What follows the last word on its line, without blanks at both ends; the next word is on another line.
  std::string_view rest_of_line();
  /// The next number; Damage says that `what` was wanted where there is none.
  double number(const char* what);
  [[nodiscard]] std::uint64_t line() const { return line_; }  ///< of the last word
  [[nodiscard]] std::size_t position() const { return at_; }  ///< behind the last word

 private:
  std::string_view text_;
  std::size_t at_{0};
  std::uint64_t line_;
};

[[nodiscard]] Content read_obj(std::string_view text);   ///< throws Damage
[[nodiscard]] Content read_stl(std::string_view bytes);  ///< throws Damage
[[nodiscard]] Content read_ply(std::string_view bytes);  ///< throws Damage

}  // namespace pantin::geometry_loader
