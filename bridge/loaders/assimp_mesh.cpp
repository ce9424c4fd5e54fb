#include <pantin/bridge/loaders/assimp_mesh.hpp>

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <limits>
#include <utility>

namespace pantin::assimp_loader {

Affine matrix_of(const aiNode& node, double unit_m) {
  const aiMatrix4x4& m = node.mTransformation;
  Affine M = Affine::Identity();
  M.linear() << m.a1, m.a2, m.a3, m.b1, m.b2, m.b3, m.c1, m.c2, m.c3;
  M.translation() << m.a4, m.b4, m.c4;
  M.translation() *= unit_m;
  return M;
}

std::string name_of(const aiNode& node) { return {node.mName.data, node.mName.length}; }
std::string name_of(const aiMesh& mesh) { return {mesh.mName.data, mesh.mName.length}; }

std::optional<std::string> append_triangles(const aiMesh& mesh, const Affine& M, double unit_m,
                                            TriangleMesh& out, std::size_t& others) {
  const std::size_t first = out.vertices.size();
  const std::size_t first_triangle = out.triangles.size();
  if (first + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max()) return "has too many vertices";
  const auto undo = [&](std::string why) {
    out.vertices.resize(first);
    out.triangles.resize(first_triangle);
    return why;
  };
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    const Vector3 p_S{unit_m * static_cast<double>(v.x), unit_m * static_cast<double>(v.y),
                      unit_m * static_cast<double>(v.z)};
    const Vector3 p = M * p_S;
    if (!p.allFinite()) return undo("has a vertex that is not finite");
    out.vertices.push_back(p);
  }
  const bool mirrored = M.linear().determinant() < 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) {
      ++others;
      continue;
    }
    std::array<std::uint32_t, 3> triangle{};
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices) return undo("has a face with a vertex out of range");
      triangle[k] = static_cast<std::uint32_t>(first + face.mIndices[k]);
    }
    if (mirrored) std::swap(triangle[1], triangle[2]);
    out.triangles.push_back(triangle);
  }
  return std::nullopt;
}

}  // namespace pantin::assimp_loader
