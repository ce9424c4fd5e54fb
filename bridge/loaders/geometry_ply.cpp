// PLY, text and binary of both byte orders (The PLY Polygon File Format, G. Turk 1994).
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <pantin/bridge/loaders/geometry_file.hpp>

namespace pantin::geometry_loader {
namespace {

enum class Type { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };
enum class Form { Text, Little, Big };

struct Property {
  std::string name{};
  Type type{Type::Float};
  std::optional<Type> count{};  ///< of a list's length
};
struct Element {
  std::string name{};
  std::uint64_t count{0};
  std::vector<Property> properties{};
};
struct Header {
  Form form{Form::Text};
  std::vector<Element> elements{};
  std::uint64_t comments{0};
};

std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

Type type_of(Words& words) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};
  const std::string_view word = words.next();
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (word == kNames[i][0] || word == kNames[i][1]) return static_cast<Type>(i);
  }
  throw Damage{words.line(), '\'' + std::string{word.substr(0, 40)} + "' is no type of a property"};
}

void read_property(Words& words, Header& header) {
  if (header.elements.empty()) throw Damage{words.line(), "a property stands before the first element"};
  Property property;
  Words ahead = words;
  if (ahead.next() == "list") {
    words = ahead;
    property.count = type_of(words);
    if (*property.count == Type::Float || *property.count == Type::Double)
      throw Damage{words.line(), "the length of a list is no integer"};
  }
  property.type = type_of(words);
  property.name = words.rest_of_line();
  header.elements.back().properties.push_back(std::move(property));
}

void read_format(Words& words, Header& header) {
  const std::string_view form = words.next();
  if (form == "ascii") {
    header.form = Form::Text;
  } else if (form == "binary_little_endian") {
    header.form = Form::Little;
  } else if (form == "binary_big_endian") {
    header.form = Form::Big;
  } else {
    throw Damage{words.line(), "format '" + std::string{form.substr(0, 40)} + "' is not known"};
  }
  if (const std::string_view version = words.next(); version != "1.0")
    throw Damage{words.line(), "version '" + std::string{version.substr(0, 40)} + "' of PLY is not known"};
}

/// Leaves `words` behind "end_header".
Header read_header(Words& words) {
  if (words.next() != "ply") throw Damage{1, "does not begin with 'ply'"};
  Header header;
  bool has_format = false;
  for (std::string_view word = words.next(); word != "end_header"; word = words.next()) {
    if (word == "format") {
      read_format(words, header);
      has_format = true;
    } else if (word == "comment" || word == "obj_info") {
      words.rest_of_line();
    } else if (word == "element") {
      Element element{.name = std::string{words.next()}};
      const auto count = integer_of(words.next());
      if (!count || *count < 0)
        throw Damage{words.line(), "element '" + element.name.substr(0, 40) + "' has no number"};
      element.count = static_cast<std::uint64_t>(*count);
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      read_property(words, header);
    } else {
      throw Damage{words.line(),
                   word.empty() ? "the header does not end"
                                : '\'' + std::string{word.substr(0, 40)} + "' is no statement of a header"};
    }
  }
  if (!has_format) throw Damage{words.line(), "the header does not say the format"};
  return header;
}

/// The values behind the header, one after another.
class Values {
 public:
  Values(std::string_view bytes, const Words& header, Form form)
      : bytes_{bytes}, words_{header}, form_{form} {
    if (form != Form::Text) at_ = std::min(bytes.find('\n', header.position()), bytes.size() - 1) + 1;
  }
  double next(Type type) {
    if (form_ == Form::Text) return words_.number("a number");
    std::array<char, 8> raw{};
    const std::size_t size = size_of(type);
    if (bytes_.size() - at_ < size)
      throw Damage{0, "ends at byte " + std::to_string(bytes_.size()) + ", too early"};
    std::memcpy(raw.data(), bytes_.data() + at_, size);
    if ((form_ == Form::Big) != (std::endian::native == std::endian::big))
      std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
    at_ += size;
    const double value = decoded(raw, type);
    if (!std::isfinite(value)) throw damage("a number is not finite");
    return value;
  }
  /// What is wrong with the value read last, with its place.
  [[nodiscard]] Damage damage(const std::string& problem) const {
    if (form_ == Form::Text) return {words_.line(), problem};
    return {0, problem + " before byte " + std::to_string(at_)};
  }
  /// Whether as many values can be left: a byte each at least, in text with a blank before it.
  [[nodiscard]] bool may_hold(std::uint64_t values) const {
    return values <= bytes_.size() - std::min(bytes_.size(), form_ == Form::Text ? words_.position() : at_);
  }

 private:
  template <class Number>
  static double as(const std::array<char, 8>& raw) {
    Number value{};
    std::memcpy(&value, raw.data(), sizeof value);
    return static_cast<double>(value);
  }
  static double decoded(const std::array<char, 8>& raw, Type type) {
    switch (type) {
      case Type::Int8:
        return as<std::int8_t>(raw);
      case Type::UInt8:
        return as<std::uint8_t>(raw);
      case Type::Int16:
        return as<std::int16_t>(raw);
      case Type::UInt16:
        return as<std::uint16_t>(raw);
      case Type::Int32:
        return as<std::int32_t>(raw);
      case Type::UInt32:
        return as<std::uint32_t>(raw);
      case Type::Float:
        return as<float>(raw);
      case Type::Double:
        return as<double>(raw);
    }
    return 0;
  }

  std::string_view bytes_;
  Words words_;
  Form form_;
  std::size_t at_{0};
};

std::uint64_t list_length(Values& values, const Property& property) {
  const double length = values.next(*property.count);
  if (!(length >= 0) || length != std::floor(length) || length > 4e9)
    throw values.damage("a list has no length");
  if (!values.may_hold(static_cast<std::uint64_t>(length)))
    throw values.damage("a list is longer than the file");
  return static_cast<std::uint64_t>(length);
}

void skip(Values& values, const Property& property) {
  const std::uint64_t count = property.count ? list_length(values, property) : 1;
  for (std::uint64_t i = 0; i < count; ++i) (void)values.next(property.type);
}

void read_vertices(Values& values, const Element& element, TriangleMesh& mesh, Content& content) {
  constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
  std::vector<Eigen::Index> axis_of;
  std::array<int, 3> seen{};
  for (const Property& property : element.properties) {
    const auto* found = std::find(kAxes.begin(), kAxes.end(), property.name);
    const bool is_axis = found != kAxes.end() && !property.count;
    axis_of.push_back(is_axis ? found - kAxes.begin() : -1);
    if (is_axis) ++seen[static_cast<std::size_t>(found - kAxes.begin())];
    if (!is_axis)
      content.not_needed["property '" + property.name.substr(0, 40) + "' of vertices"].add(element.count);
  }
  if (seen != std::array{1, 1, 1}) throw Damage{0, "has vertices without x, y or z"};
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Vector3 p = Vector3::Zero();
    for (std::size_t k = 0; k < axis_of.size(); ++k) {
      if (axis_of[k] < 0) skip(values, element.properties[k]);
      else p[axis_of[k]] = values.next(element.properties[k].type);
    }
    mesh.vertices.push_back(p);
  }
}

std::uint32_t index_of(double number, const Values& values, const TriangleMesh& mesh) {
  if (number >= 0 && number == std::floor(number) && number < static_cast<double>(mesh.vertices.size()))
    return static_cast<std::uint32_t>(number);
  throw values.damage("a face names a vertex that is not one of " + std::to_string(mesh.vertices.size()));
}

void read_faces(Values& values, const Element& element, TriangleMesh& mesh, Content& content) {
  std::vector<std::uint32_t> polygon;
  bool has_corners = false;
  for (const Property& property : element.properties) {
    const bool is_corners =
        property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
    has_corners = has_corners || is_corners;
    if (!is_corners)
      content.not_needed["property '" + property.name.substr(0, 40) + "' of faces"].add(element.count);
  }
  if (!has_corners && element.count > 0) throw Damage{0, "has faces without vertex_indices"};
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (!property.count || (property.name != "vertex_indices" && property.name != "vertex_index")) {
        skip(values, property);
        continue;
      }
      const std::uint64_t corners = list_length(values, property);
      if (corners > kMostCorners)
        throw values.damage("a face has more than " + std::to_string(kMostCorners) + " corners");
      polygon.clear();
      for (std::uint64_t k = 0; k < corners; ++k)
        polygon.push_back(index_of(values.next(property.type), values, mesh));
      if (corners < 3) content.dropped["points or lines"].add(1);
      if (corners > 3) content.not_needed["polygons as such: they are cut into triangles"].add(1);
      if (corners >= 3) triangulate(polygon, mesh.vertices, mesh.triangles);
    }
  }
}

}  // namespace

Content read_ply(std::string_view bytes) {
  Words words{bytes};
  const Header header = read_header(words);
  Values values{bytes, words, header.form};
  Content content;
  Part part;
  for (const Element& element : header.elements) {
    if (element.count == 0 || element.properties.empty()) continue;
    if (!values.may_hold(element.count))
      throw Damage{0, "says that it has " + std::to_string(element.count) + " of element '" +
                          element.name.substr(0, 40) + "', more than it can hold"};
    if (element.name == "vertex") {
      if (!part.mesh.vertices.empty()) throw Damage{0, "has vertices twice"};
      read_vertices(values, element, part.mesh, content);
    } else if (element.name == "face") {
      read_faces(values, element, part.mesh, content);
    } else {
      content.dropped["element '" + element.name.substr(0, 40) + '\''].add(element.count);
      for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) skip(values, property);
      }
    }
  }
  clean(part.mesh, content);
  if (!part.mesh.triangles.empty()) content.parts.push_back(std::move(part));
  return content;
}

}  // namespace pantin::geometry_loader
