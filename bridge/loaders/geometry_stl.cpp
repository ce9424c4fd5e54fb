// STL, text and binary (StereoLithography Interface Specification, 3D Systems 1989). Corners at exactly the
// same place become one vertex, as the format repeats them for each triangle.
#include <bit>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include <pantin/bridge/loaders/geometry_file.hpp>

namespace pantin::geometry_loader {
namespace {

constexpr std::size_t kHeader = 84;  ///< 80 of text and the number of triangles
constexpr std::size_t kFacet = 50;   ///< normal and corners as 12 floats, 2 bytes of attributes

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies in memory");

struct PlaceHash {
  std::size_t operator()(const std::array<std::uint64_t, 3>& bits) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t part : bits) hash = (hash ^ part) * 0x9E3779B97F4A7C15ull + (hash >> 29);
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }
};

/// Triangles given by the places of their corners.
class Soup {
 public:
  explicit Soup(std::string name) : part_{.name = std::move(name)} {}
  void add(const std::array<Vector3, 3>& corners) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 p = corners[i] + Vector3::Zero();  // -0 becomes 0
      const std::array<std::uint64_t, 3> bits{std::bit_cast<std::uint64_t>(p.x()),
                                              std::bit_cast<std::uint64_t>(p.y()),
                                              std::bit_cast<std::uint64_t>(p.z())};
      const auto next = static_cast<std::uint32_t>(part_.mesh.vertices.size());
      const auto [known, is_new] = places_.try_emplace(bits, next);
      if (is_new) part_.mesh.vertices.push_back(p);
      triangle[i] = known->second;
    }
    part_.mesh.triangles.push_back(triangle);
  }
  void finish(Content& content) {
    clean(part_.mesh, content);
    if (!part_.mesh.triangles.empty()) content.parts.push_back(std::move(part_));
  }

 private:
  Part part_;
  std::unordered_map<std::array<std::uint64_t, 3>, std::uint32_t, PlaceHash> places_{};
};

std::uint32_t stated_facets(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
  return count;
}

Content read_binary(std::string_view bytes) {
  if (bytes.size() < kHeader)
    throw Damage{0, "is neither text nor long enough for the header of a binary STL"};
  const std::uint64_t count = stated_facets(bytes);
  if (count > (bytes.size() - kHeader) / kFacet) {
    throw Damage{0, "says at byte 80 that it has " + std::to_string(count) + " triangles, but holds " +
                        std::to_string((bytes.size() - kHeader) / kFacet)};
  }
  Content content;
  Soup soup{{}};
  std::size_t attributes = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 12> numbers{};
    std::uint16_t attribute = 0;
    const std::size_t at = kHeader + i * kFacet;
    std::memcpy(numbers.data(), bytes.data() + at, sizeof numbers);
    std::memcpy(&attribute, bytes.data() + at + sizeof numbers, sizeof attribute);
    if (attribute != 0) ++attributes;
    std::array<Vector3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float x = numbers[3 + 3 * k + axis];
        if (!std::isfinite(x)) {
          throw Damage{0, "has a coordinate that is not finite at byte " +
                              std::to_string(at + sizeof(float) * (3 + 3 * k + axis))};
        }
        corners[k][static_cast<Eigen::Index>(axis)] = static_cast<double>(x);
      }
    }
    soup.add(corners);
  }
  if (count > 0) content.not_needed["normals"].add(static_cast<std::size_t>(count));
  if (attributes > 0) content.not_needed["attributes of facets"].add(attributes);
  if (const std::size_t more = bytes.size() - kHeader - count * kFacet; more > 0)
    content.dropped["bytes behind the last triangle"].add(more);
  soup.finish(content);
  return content;
}

/// Whether the words are the same but for the case of ASCII letters; `wanted` is in lower case.
bool same(std::string_view word, std::string_view wanted) {
  if (word.size() != wanted.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] - 'A' + 'a') : word[i];
    if (c != wanted[i]) return false;
  }
  return true;
}

void want(Words& words, std::string_view wanted) {
  const std::string_view word = words.next();
  if (same(word, wanted)) return;
  throw Damage{words.line(), '\'' + std::string{wanted} + "' is wanted, but " +
                                 (word.empty() ? std::string{"the file ends"}
                                               : '\'' + std::string{word.substr(0, 40)} + "' stands there")};
}

void read_facet(Words& words, Soup& soup) {
  words.rest_of_line();  // the normal, which the order of the corners says too, and some write as nan
  want(words, "outer");
  want(words, "loop");
  std::array<Vector3, 3> corners;
  for (Vector3& corner : corners) {
    want(words, "vertex");
    for (double& x : corner) x = words.number("a coordinate");
  }
  want(words, "endloop");
  want(words, "endfacet");
  soup.add(corners);
}

Content read_text(std::string_view text) {
  Content content;
  Words words{text};
  std::size_t normals = 0;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (!same(word, "solid")) {
      throw Damage{words.line(),
                   "'solid' is wanted, but '" + std::string{word.substr(0, 40)} + "' stands there"};
    }
    Soup soup{std::string{words.rest_of_line()}};
    for (word = words.next(); same(word, "facet"); word = words.next()) {
      read_facet(words, soup);
      ++normals;
    }
    if (!same(word, "endsolid")) {
      throw Damage{words.line(),
                   "'facet' or 'endsolid' is wanted, but " +
                       (word.empty() ? std::string{"the file ends"}
                                     : '\'' + std::string{word.substr(0, 40)} + "' stands there")};
    }
    words.rest_of_line();
    soup.finish(content);
  }
  if (normals > 0) content.not_needed["normals"].add(normals);
  return content;
}

/// Binary files may begin with "solid" too: their length decides.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= kHeader && bytes.size() == kHeader + std::uint64_t{kFacet} * stated_facets(bytes))
    return true;
  Words words{bytes.substr(0, 512)};
  return !same(words.next(), "solid");
}

}  // namespace

Content read_stl(std::string_view bytes) { return is_binary(bytes) ? read_binary(bytes) : read_text(bytes); }

}  // namespace pantin::geometry_loader
