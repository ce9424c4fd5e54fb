#include "gltf_meshes.hpp"

#include <map>

#include "gltf_instancing.hpp"

namespace pantin::gltf {
namespace {

enum class PrimitiveMode { Triangles = 4, Strip = 5, Fan = 6 };

class MeshReader {
 public:
  MeshReader(const Document& document, Accessors& accessors)
      : document_{document}, report_{document.report()}, accessors_{accessors} {}

  /// Null where nothing of the mesh is a triangle.
  std::shared_ptr<const TriangleMesh> read(const JsonValue& mesh) {
    const JsonValue primitives = expect(report_, require(report_, mesh, "primitives"), JsonKind::Array);
    mesh_ = std::make_shared<TriangleMesh>();
    first_vertices_.clear();
    for (std::size_t i = 0; i < primitives.size(); ++i) read_primitive(primitives.at(i));
    return mesh_->triangles.empty() ? nullptr : std::move(mesh_);
  }

 private:
  /// The part of the mesh's vertices that one primitive uses.
  struct Vertices {
    std::uint32_t first{0};
    std::uint32_t count{0};
  };

  void read_primitive(const JsonValue& primitive) {
    expect(report_, primitive, JsonKind::Object);
    const std::uint64_t mode = size_or(report_, primitive, "mode", 4);
    if (mode > 6) report_.refuse(*primitive.find("mode"), "there is no such mode", "write 0 to 6");
    const JsonValue attributes = expect(report_, require(report_, primitive, "attributes"), JsonKind::Object);
    const std::optional<JsonValue> positions = attributes.find("POSITION");
    if (mode < 4 || !positions) {
      report_.drop(Severity::Warning, primitive,
                   mode < 4 ? "points and lines have no volume: not loaded"
                            : "a primitive without POSITION is not loaded",
                   "");
      return;
    }
    const Vertices vertices = read_vertices(*positions);
    add_triangles(primitive, static_cast<PrimitiveMode>(mode), read_indices(primitive, vertices));
  }

  /// Primitives that share an accessor share its vertices.
  Vertices read_vertices(const JsonValue& value) {
    const std::size_t index = document_.index(value, Collection::Accessors);
    if (const auto found = first_vertices_.find(index); found != first_vertices_.end()) return found->second;
    const AccessorData data =
        accessors_.read(document_.item(Collection::Accessors, index), AccessorUse::Position);
    const Vertices vertices{static_cast<std::uint32_t>(mesh_->vertices.size()),
                            static_cast<std::uint32_t>(data.count)};
    mesh_->vertices.reserve(mesh_->vertices.size() + data.count);
    for (std::size_t i = 0; i < data.count; ++i)
      mesh_->vertices.emplace_back(data.numbers[3 * i], data.numbers[3 * i + 1], data.numbers[3 * i + 2]);
    first_vertices_.emplace(index, vertices);
    return vertices;
  }

  /// Positions in the mesh's vertices.
  std::vector<std::uint32_t> read_indices(const JsonValue& primitive, const Vertices& vertices) {
    std::vector<std::uint32_t> indices;
    const std::optional<JsonValue> accessor = document_.referred(primitive, "indices", Collection::Accessors);
    if (!accessor) {
      accessors_.charge(primitive, vertices.count);
      for (std::uint32_t i = 0; i < vertices.count; ++i) indices.push_back(vertices.first + i);
      return indices;
    }
    const AccessorData data = accessors_.read(*accessor, AccessorUse::Index);
    indices.reserve(data.count);
    for (std::size_t i = 0; i < data.count; ++i) {
      if (data.numbers[i] >= vertices.count)
        report_.refuse(*accessor,
                       "index " + std::to_string(i) + " is " +
                           std::to_string(static_cast<std::uint64_t>(data.numbers[i])) + ", but there are " +
                           std::to_string(vertices.count) + " vertices",
                       "export the model again");
      indices.push_back(vertices.first + static_cast<std::uint32_t>(data.numbers[i]));
    }
    return indices;
  }

  /// glTF 2.0, 3.7.2.1. Strips turn every second triangle round; those with two equal corners are their
  /// seams.
  void add_triangles(const JsonValue& primitive, PrimitiveMode mode, const std::vector<std::uint32_t>& v) {
    const bool is_list = mode == PrimitiveMode::Triangles;
    if (is_list ? v.size() % 3 != 0 : v.size() < 3)
      report_.tally(Severity::Warning, primitive, "it ends within a triangle, which is not loaded",
                    "export the model again");
    if (is_list) {
      for (std::size_t i = 0; i + 2 < v.size(); i += 3)
        mesh_->triangles.push_back({v[i], v[i + 1], v[i + 2]});
      return;
    }
    for (std::size_t i = 0; i + 2 < v.size(); ++i) {
      const std::array<std::uint32_t, 3> triangle =
          mode == PrimitiveMode::Fan ? std::array{v[i + 1], v[i + 2], v[0]}
                                     : std::array{v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]};
      if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
        mesh_->triangles.push_back(triangle);
    }
  }

  const Document& document_;
  Report& report_;
  Accessors& accessors_;
  std::shared_ptr<TriangleMesh> mesh_;
  std::map<std::size_t, Vertices> first_vertices_;  // by accessor
};

}  // namespace

void read_meshes(const Document& document, const SceneNodes& nodes, Accessors& accessors, Model& model) {
  Report& report = document.report();
  MeshReader reader{document, accessors};
  std::vector<std::shared_ptr<const TriangleMesh>> meshes(document.count(Collection::Meshes));
  std::vector<bool> is_read(meshes.size(), false);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    report.try_part([&] {
      const JsonValue node = document.item(Collection::Nodes, nodes.hierarchy.order[i]);
      const std::optional<JsonValue> value = node.find("mesh");
      if (!value) return;
      const std::size_t index = document.index(*value, Collection::Meshes);
      const JsonValue mesh = document.item(Collection::Meshes, index);
      if (!is_read[index]) {
        is_read[index] = true;
        meshes[index] = reader.read(mesh);
      }
      if (!meshes[index]) return;
      const std::string name{text_or_empty(report, mesh, "name")};
      const auto instances = read_instances(node, document, accessors);
      for (const Affine& M_NS : instances.value_or(std::vector{Affine::Identity()}))
        model.nodes[i].meshes.push_back({name, meshes[index], M_NS});
    });
  }
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (!is_read[i])
      report.drop(Severity::Note, "meshes", document.item(Collection::Meshes, i),
                  "on no node of the scene: not loaded", "");
  report.stop_at_errors();
}

}  // namespace pantin::gltf
