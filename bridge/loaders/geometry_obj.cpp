// Wavefront OBJ: vertices, faces, objects and groups (Object Files, Wavefront Technologies, appendix B1).
#include <algorithm>

#include <pantin/bridge/loaders/geometry_file.hpp>

namespace pantin::geometry_loader {
namespace {

/// A polygon: its corners' place in a common list, as names of vertices may come before the vertices.
struct Face {
  std::size_t first{0};
  std::size_t count{0};
  std::uint64_t line{0};
};

struct Group {
  std::string name{};
  std::vector<Face> faces{};
  std::uint64_t line{0};
};

class Reader {
 public:
  Content read(std::string_view text) {
    std::string joined;  // of lines that end with a backslash
    std::uint64_t line = 0;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      std::string_view one = text.substr(at, end - at);
      at = end + 1;
      ++line;
      if (one.ends_with('\r')) one.remove_suffix(1);
      if (one.ends_with('\\') && at < text.size()) {
        joined += std::string{one.substr(0, one.size() - 1)} + ' ';
        continue;
      }
      if (joined.empty()) {
        statement(one, line);
      } else {
        statement(joined + std::string{one}, line);
        joined.clear();
      }
    }
    return finish();
  }

 private:
  void statement(std::string_view text, std::uint64_t line) {
    Words words{text.substr(0, text.find('#')), line};
    const std::string_view kind = words.next();
    if (kind == "v") {
      for (Eigen::Index i = 0; i < 3; ++i) place_[i] = words.number("a coordinate");
      vertices_.push_back(place_);
      if (!words.next().empty()) content_.not_needed["weights or colours of vertices"].add(1, line);
    } else if (kind == "f") {
      face(words);
    } else if (kind == "o" || kind == "g") {
      groups_.push_back({.name = std::string{words.rest_of_line()}, .line = line});
    } else if (!kind.empty()) {
      other(kind, line);
    }
  }

  void face(Words& words) {
    Face face{.first = corners_.size(), .line = words.line()};
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      const auto index = integer_of(word.substr(0, word.find('/')));
      if (!index || *index == 0)
        throw Damage{face.line, "'" + std::string{word.substr(0, 40)} + "' is no corner of a face"};
      // Negative ones count back from the last vertex so far.
      corners_.push_back(*index > 0 ? *index - 1 : static_cast<std::int64_t>(vertices_.size()) + *index);
      if (++face.count > kMostCorners) {
        throw Damage{face.line, "a face has more than " + std::to_string(kMostCorners) + " corners"};
      }
    }
    if (face.count == 0) throw Damage{face.line, "a face has no corner"};
    if (face.count < 3) {
      content_.dropped["points or lines"].add(1, face.line);
    } else {
      groups_.back().faces.push_back(face);
    }
  }

  void other(std::string_view kind, std::uint64_t line) {
    struct Known {
      std::string_view word;
      const char* what;
    };
    static constexpr std::array kNotNeeded{
        Known{"vn", "normals"}, Known{"vt", "texture coordinates"}, Known{"usemtl", "uses of materials"},
        Known{"mtllib", "libraries of materials"}, Known{"s", "smoothing groups"}};
    const auto* known =
        std::find_if(kNotNeeded.begin(), kNotNeeded.end(), [&](const Known& k) { return k.word == kind; });
    if (known != kNotNeeded.end()) {
      content_.not_needed[known->what].add(1, line);
    } else if (kind == "l" || kind == "p") {
      content_.dropped["points or lines"].add(1, line);
    } else {
      content_.dropped["statements '" + std::string{kind.substr(0, 20)} + '\''].add(1, line);
    }
  }

  Content finish() {
    if (vertices_.size() >= ~std::uint32_t{0}) throw Damage{0, "has too many vertices"};
    std::vector<std::uint32_t> place(vertices_.size());  // of a vertex in the present part
    std::vector<std::size_t> part_of(vertices_.size(), 0);
    std::size_t number = 0;
    std::vector<std::uint32_t> polygon;
    for (const Group& group : groups_) {
      ++number;
      Part part{.name = group.name};
      for (const Face& face : group.faces) {
        polygon.clear();
        for (std::size_t i = 0; i < face.count; ++i) {
          const std::int64_t corner = corners_[face.first + i];
          if (corner < 0 || corner >= static_cast<std::int64_t>(vertices_.size())) {
            throw Damage{face.line, "a face names vertex " + std::to_string(corner + 1) + " of " +
                                        std::to_string(vertices_.size())};
          }
          const auto vertex = static_cast<std::size_t>(corner);
          if (part_of[vertex] != number) {
            part_of[vertex] = number;
            place[vertex] = static_cast<std::uint32_t>(part.mesh.vertices.size());
            part.mesh.vertices.push_back(vertices_[vertex]);
          }
          polygon.push_back(place[vertex]);
        }
        if (face.count > 3)
          content_.not_needed["polygons as such: they are cut into triangles"].add(1, face.line);
        triangulate(polygon, part.mesh.vertices, part.mesh.triangles);
      }
      clean(part.mesh, content_);
      if (!part.mesh.triangles.empty()) content_.parts.push_back(std::move(part));
      else if (group.line > 0) content_.not_needed["groups without triangles"].add(1, group.line);
    }
    if (const auto unused = std::count(part_of.begin(), part_of.end(), std::size_t{0}); unused > 0)
      content_.not_needed["vertices without triangle"].add(static_cast<std::size_t>(unused));
    return std::move(content_);
  }

  std::vector<Vector3> vertices_{};
  std::vector<std::int64_t> corners_{};
  std::vector<Group> groups_{Group{}};
  Vector3 place_{Vector3::Zero()};
  Content content_{};
};

}  // namespace

Content read_obj(std::string_view text) { return Reader{}.read(text); }

}  // namespace pantin::geometry_loader
