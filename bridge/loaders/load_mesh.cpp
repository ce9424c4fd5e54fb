#include <pantin/bridge/loaders/load_mesh.hpp>

#include <utility>

namespace pantin {
namespace {

/// All triangles in the frame of the file.
TriangleMesh all_triangles(const Model& model) {
  std::vector<Affine> M_FN;  // node in the file's frame
  M_FN.reserve(model.nodes.size());
  TriangleMesh all;
  for (const ModelNode& node : model.nodes) {
    M_FN.push_back(node.parent < 0 ? node.M_PN : M_FN[static_cast<std::size_t>(node.parent)] * node.M_PN);
    for (const ModelMesh& part : node.meshes) {
      const Affine M_FS = M_FN.back() * part.M_NS;
      const bool mirrored = M_FS.linear().determinant() < 0;
      const auto first = static_cast<std::uint32_t>(all.vertices.size());
      for (const Vector3& v : part.mesh->vertices) all.vertices.push_back(M_FS * v);
      for (auto [a, b, c] : part.mesh->triangles) {
        if (mirrored) std::swap(b, c);
        all.triangles.push_back({first + a, first + b, first + c});
      }
    }
  }
  return all;
}

/// Whether whoever names a mesh file in a robot has to know.
bool matters(const Diagnostic& note) {
  return note.severity != Severity::Note || note.subject == "parser" ||
         note.problem.starts_with("lengths are multiplied");
}

}  // namespace

Loaded<std::shared_ptr<const TriangleMesh>> load_mesh(const std::filesystem::path& file,
                                                      const LoadOptions& options) {
  LoadOptions plain = options;
  plain.geometry = true;
  plain.mesh_reader = [](const std::filesystem::path& other) {  // a robot is no mesh, nor are its meshes
    return Loaded<std::shared_ptr<const TriangleMesh>>{
        {}, {{Severity::Error, other.string(), "file", "is named by a robot that is named as a mesh", ""}}};
  };
  Loaded<Model> model = load_model(file, plain);
  Loaded<std::shared_ptr<const TriangleMesh>> loaded;
  for (Diagnostic& note : model.notes) {
    if (matters(note)) loaded.notes.push_back(std::move(note));
  }
  if (!model.value) return loaded;
  const auto failure = [&](const char* problem, const char* remedy) {
    loaded.notes.push_back({Severity::Error, file.string(), "file", problem, remedy});
    return loaded;
  };
  auto mesh = std::make_shared<const TriangleMesh>(all_triangles(*model.value));
  if (mesh->triangles.empty()) return failure("holds no triangle", "check that it holds a mesh");
  for (const Vector3& v : mesh->vertices) {
    if (!v.allFinite()) return failure("has vertices that are not finite", "check the matrices of its nodes");
  }
  loaded.value = std::move(mesh);
  return loaded;
}

}  // namespace pantin
