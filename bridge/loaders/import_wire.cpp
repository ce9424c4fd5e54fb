#include <pantin/bridge/loaders/import_wire.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include <pantin/scenegraph/expects.hpp>

namespace pantin {
namespace {

constexpr std::string_view kMagic = "PANTIMPT";
constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kByteOrder = 0x01020304;
constexpr std::size_t kHeader = 24;  ///< magic, version, byte order, length of the rest

using SharedMesh = std::shared_ptr<const TriangleMesh>;

class Writer {
 public:
  template <class Number>
  void number(Number value) {
    append(&value, sizeof value);
  }
  void count(std::size_t value) { number(static_cast<std::uint64_t>(value)); }
  void text(std::string_view value) {
    count(value.size());
    append(value.data(), value.size());
  }
  void matrix(const Affine& M) { append(M.matrix().data(), 16 * sizeof(double)); }
  void append(const void* data, std::size_t bytes) { out_.append(static_cast<const char*>(data), bytes); }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

void write_mesh(Writer& out, const TriangleMesh& mesh) {
  out.count(mesh.vertices.size());
  for (const Vector3& v : mesh.vertices) out.append(v.data(), 3 * sizeof(double));
  out.count(mesh.triangles.size());
  for (const auto& t : mesh.triangles) out.append(t.data(), sizeof t);
}

void write_model(Writer& out, const Model& model) {
  out.text(model.name);
  out.text(model.format);
  out.number(static_cast<std::uint8_t>(model.up_axis));
  out.number(model.unit_m);
  std::map<SharedMesh, std::uint64_t> places;
  std::vector<SharedMesh> meshes;
  for (const ModelNode& node : model.nodes) {
    for (const ModelMesh& mesh : node.meshes) {
      if (places.try_emplace(mesh.mesh, meshes.size()).second) meshes.push_back(mesh.mesh);
    }
  }
  out.count(meshes.size());
  for (const SharedMesh& mesh : meshes) write_mesh(out, *mesh);
  out.count(model.nodes.size());
  for (const ModelNode& node : model.nodes) {
    PANTIN_EXPECTS(!node.link && !node.mass && node.shapes.empty(),
                   "node '" + node.name + "' has a link, mass or shape, which foreign formats do not give");
    out.text(node.name);
    out.number(node.parent);
    out.matrix(node.M_PN);
    out.count(node.meshes.size());
    for (const ModelMesh& mesh : node.meshes) {
      out.text(mesh.name);
      out.number(places.at(mesh.mesh));
      out.matrix(mesh.M_NS);
    }
  }
  out.count(model.clips.size());
  for (const Clip& clip : model.clips) {
    out.text(clip.name);
    out.number(clip.duration);
    out.count(clip.tracks.size());
    for (const Track& track : clip.tracks) {
      out.number(track.target);
      out.number(static_cast<std::uint8_t>(track.channel));
      out.number(static_cast<std::uint8_t>(track.interpolation));
      out.count(track.times.size());
      out.append(track.times.data(), track.times.size() * sizeof(double));
      out.count(track.values.size());
      out.append(track.values.data(), track.values.size() * sizeof(double));
    }
  }
}

/// What is wrong with the bytes.
struct Damage {
  const char* what;
};

/// Takes bytes from the front; throws Damage where they are not there.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_{bytes} {}

  template <class Number>
  Number number() {
    Number value{};
    copy(&value, sizeof value);
    return value;
  }
  double finite() {
    const auto value = number<double>();
    if (!std::isfinite(value)) throw Damage{"a number is not finite"};
    return value;
  }
  /// A number of items of at least `bytes` each: more than the rest can hold is a lie.
  std::size_t count(std::size_t bytes) {
    const auto value = number<std::uint64_t>();
    if (value > rest_.size() / bytes) throw Damage{"a count is beyond the end"};
    return static_cast<std::size_t>(value);
  }
  std::string text() {
    const std::size_t size = count(1);
    std::string value{rest_.substr(0, size)};
    rest_.remove_prefix(size);
    return value;
  }
  template <class Enum>
  Enum one_of(Enum last) {
    const auto value = number<std::uint8_t>();
    if (value > static_cast<std::uint8_t>(last)) throw Damage{"an enumerator is unknown"};
    return static_cast<Enum>(value);
  }
  Affine matrix() {
    Affine M = Affine::Identity();
    copy(M.matrix().data(), 16 * sizeof(double));
    if (!M.matrix().allFinite()) throw Damage{"a matrix is not finite"};
    if (M.matrix().row(3) != Eigen::RowVector4d{0, 0, 0, 1}) throw Damage{"a matrix is not affine"};
    return M;
  }
  void copy(void* to, std::size_t bytes) {
    if (bytes > rest_.size()) throw Damage{"it ends too early"};
    if (bytes > 0) std::memcpy(to, rest_.data(), bytes);  // nothing has no place either
    rest_.remove_prefix(bytes);
  }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

SharedMesh read_mesh(Reader& in) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices.resize(in.count(3 * sizeof(double)));
  for (Vector3& v : mesh->vertices) {
    in.copy(v.data(), 3 * sizeof(double));
    if (!v.allFinite()) throw Damage{"a vertex is not finite"};
  }
  mesh->triangles.resize(in.count(sizeof mesh->triangles[0]));
  for (auto& triangle : mesh->triangles) {
    in.copy(triangle.data(), sizeof triangle);
    for (const std::uint32_t index : triangle) {
      if (index >= mesh->vertices.size()) throw Damage{"a triangle names a vertex that does not exist"};
    }
  }
  return mesh;
}

ModelNode read_node(Reader& in, std::size_t position, const std::vector<SharedMesh>& meshes,
                    const std::string& place) {
  ModelNode node{.name = in.text(), .parent = in.number<std::int32_t>(), .M_PN = in.matrix(), .place = place};
  if (node.parent < -1 || (node.parent >= 0 && static_cast<std::size_t>(node.parent) >= position))
    throw Damage{"a node stands before its parent"};
  const std::size_t count = in.count(2 * sizeof(std::uint64_t));
  for (std::size_t i = 0; i < count; ++i) {
    std::string name = in.text();
    const auto mesh = in.number<std::uint64_t>();
    if (mesh >= meshes.size()) throw Damage{"a node names a mesh that does not exist"};
    node.meshes.push_back({std::move(name), meshes[mesh], in.matrix()});
  }
  return node;
}

std::vector<double> read_numbers(Reader& in) {
  std::vector<double> numbers(in.count(sizeof(double)));
  in.copy(numbers.data(), numbers.size() * sizeof(double));
  return numbers;
}

Clip read_clip(Reader& in, std::size_t nodes) {
  Clip clip{.name = in.text(), .duration = in.finite()};
  const std::size_t count = in.count(sizeof(std::uint32_t));
  for (std::size_t i = 0; i < count; ++i) {
    Track track{.target = in.number<std::uint32_t>(),
                .channel = in.one_of(Channel::Scale),
                .interpolation = in.one_of(Interpolation::CubicSpline)};
    track.width = track.channel == Channel::Rotation ? 4 : 3;
    track.times = read_numbers(in);
    track.values = read_numbers(in);
    if (track.target >= nodes) throw Damage{"a track names a node that does not exist"};
    if (!problem_with(track).empty()) throw Damage{"a track is unusable"};
    clip.tracks.push_back(std::move(track));
  }
  return clip;
}

Model read_model(Reader& in, const std::string& place) {
  Model model{.name = in.text(), .format = in.text(), .up_axis = in.one_of(UpAxis::Z), .unit_m = in.finite()};
  if (!(model.unit_m > 0)) throw Damage{"its unit is not positive"};
  std::vector<SharedMesh> meshes(in.count(2 * sizeof(std::uint64_t)));
  for (SharedMesh& mesh : meshes) mesh = read_mesh(in);
  const std::size_t nodes = in.count(16 * sizeof(double));
  if (nodes == 0) throw Damage{"it has no node"};
  for (std::size_t i = 0; i < nodes; ++i) model.nodes.push_back(read_node(in, i, meshes, place));
  const std::size_t clips = in.count(2 * sizeof(std::uint64_t));
  for (std::size_t i = 0; i < clips; ++i) model.clips.push_back(read_clip(in, nodes));
  return model;
}

Loaded<Model> read_all(std::string_view bytes, const std::string& place) {
  Reader header{bytes.substr(0, kHeader)};
  std::string magic(kMagic.size(), '\0');
  header.copy(magic.data(), magic.size());
  if (magic != kMagic) throw Damage{"it is not one"};
  if (header.number<std::uint32_t>() != kVersion) throw Damage{"it is of another version"};
  if (header.number<std::uint32_t>() != kByteOrder) throw Damage{"it is of another byte order"};
  if (header.number<std::uint64_t>() != bytes.size() - kHeader)
    throw Damage{"its length is not what it says"};
  Reader in{bytes.substr(kHeader)};
  Loaded<Model> loaded;
  const std::size_t notes = in.count(4 * sizeof(std::uint64_t));
  for (std::size_t i = 0; i < notes; ++i) {
    const auto severity = in.one_of(Severity::Error);
    Diagnostic note{.severity = severity, .place = in.text(), .subject = in.text()};
    note.problem = in.text();
    note.remedy = in.text();
    loaded.notes.push_back(std::move(note));
  }
  if (in.number<std::uint8_t>() != 0) loaded.value = read_model(in, place);
  if (in.left() != 0) throw Damage{"something stands behind its end"};
  if (loaded.value.has_value() == has_error(loaded.notes)) throw Damage{"value and errors contradict"};
  return loaded;
}

}  // namespace

std::string encode(const Loaded<Model>& loaded) {
  Writer body;
  body.count(loaded.notes.size());
  for (const Diagnostic& note : loaded.notes) {
    body.number(static_cast<std::uint8_t>(note.severity));
    for (const std::string* text : {&note.place, &note.subject, &note.problem, &note.remedy})
      body.text(*text);
  }
  body.number(static_cast<std::uint8_t>(loaded.value.has_value()));
  if (loaded.value) write_model(body, *loaded.value);
  const std::string rest = body.take();
  Writer all;
  all.append(kMagic.data(), kMagic.size());
  all.number(kVersion);
  all.number(kByteOrder);
  all.count(rest.size());
  all.append(rest.data(), rest.size());
  return all.take();
}

Loaded<Model> decode(std::string_view bytes, const std::string& place) {
  try {
    return read_all(bytes, place);
  } catch (const Damage& damage) {
    return {
        {},
        {{Severity::Error, place, "file", std::string{"pantin-import gave no usable answer: "} + damage.what,
          "use the pantin-import that was built with this library"}}};
  }
}

}  // namespace pantin
