#include <pantin/bridge/loaders/assimp_model.hpp>

#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <exception>
#include <iterator>
#include <utility>

#include <pantin/bridge/input_file.hpp>
#include <pantin/bridge/loaders/assimp_animation.hpp>
#include <pantin/bridge/loaders/assimp_frame.hpp>
#include <pantin/bridge/loaders/assimp_mesh.hpp>
#include <pantin/bridge/loaders/assimp_scene.hpp>

namespace pantin::assimp_loader {
namespace {

using Notes = std::vector<Diagnostic>;

/// A node with the position of its parent in the list; -1 = top.
struct Placed {
  const aiNode* node;
  std::int32_t parent;
};

/// All nodes, parents first, in depth-first order.
std::vector<Placed> in_order(const aiScene& scene) {
  std::vector<Placed> order;
  std::vector<Placed> open{{scene.mRootNode, -1}};
  while (!open.empty()) {
    const Placed placed = open.back();
    open.pop_back();
    const auto position = static_cast<std::int32_t>(order.size());
    order.push_back(placed);
    for (unsigned i = placed.node->mNumChildren; i-- > 0;)
      open.push_back({placed.node->mChildren[i], position});
  }
  return order;
}

/// The node's matrix in metres, without what assimp worked into the top node.
Affine local_of(const Placed& placed, const FileFrame& frame) {
  if (placed.parent < 0 && frame.top_is_correction) return Affine::Identity();
  return matrix_of(*placed.node, frame.unit_m);
}

void note_others(std::size_t others, const std::string& place, Notes& notes) {
  if (others == 0) return;
  notes.push_back(
      {Severity::Warning, place, "meshes", std::to_string(others) + " points or lines are dropped", ""});
}

/// Each of assimp's meshes as triangles; null with a finding where it is unusable or has no triangle.
std::vector<std::shared_ptr<const TriangleMesh>> meshes_of(const aiScene& scene, double unit_m,
                                                           const std::string& place, Notes& notes) {
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;
  std::size_t others = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    auto triangles = std::make_shared<TriangleMesh>();
    const auto problem = append_triangles(*scene.mMeshes[i], Affine::Identity(), unit_m, *triangles, others);
    if (problem) {
      notes.push_back({Severity::Warning, place, "mesh '" + name_of(*scene.mMeshes[i]) + '\'',
                       *problem + "; dropped", ""});
    }
    if (triangles->triangles.empty()) triangles.reset();
    meshes.push_back(std::move(triangles));
  }
  note_others(others, place, notes);
  return meshes;
}

Model model_of(const ReadScene& read, const std::filesystem::path& file, bool geometry, Notes& notes) {
  const std::string place = file.string();
  Model model{.name = file.stem().string(),
              .format = read.extension,
              .up_axis = read.frame.up_axis,
              .unit_m = read.frame.unit_m};
  const auto meshes = geometry ? meshes_of(*read.scene, model.unit_m, place, notes)
                               : std::vector<std::shared_ptr<const TriangleMesh>>{};
  for (const Placed& placed : in_order(*read.scene)) {
    ModelNode node{.name = name_of(*placed.node),
                   .parent = placed.parent,
                   .M_PN = local_of(placed, read.frame),
                   .place = place};
    if (!node.M_PN.matrix().allFinite()) {
      notes.push_back({Severity::Error, place, "node '" + node.name + '\'', "has a matrix that is not finite",
                       "mend the file"});
    }
    for (unsigned i = 0; i < placed.node->mNumMeshes; ++i) {
      const unsigned index = placed.node->mMeshes[i];
      if (index >= meshes.size() || meshes[index] == nullptr) continue;
      node.meshes.push_back({name_of(*read.scene->mMeshes[index]), meshes[index], Affine::Identity()});
    }
    model.nodes.push_back(std::move(node));
  }
  add_clips(*read.scene, place, model, notes);
  return model;
}

void append(Notes& notes, Notes more) { std::move(more.begin(), more.end(), std::back_inserter(notes)); }

Diagnostic unexpected(const std::filesystem::path& file, const std::exception& e) {
  return {Severity::Error, file.string(), "file", std::string{"cannot be read: "} + e.what(), ""};
}

}  // namespace

Loaded<Model> read_model(const std::filesystem::path& file, bool geometry) {
  Loaded<Model> loaded;
  try {
    ReadScene read = read_scene(file, geometry);
    loaded.notes = std::move(read.notes);
    if (read.scene == nullptr) return loaded;
    append(loaded.notes, notes_about(read.frame, file.string()));
    if (!read.left_out.text.empty()) {
      loaded.notes.push_back({Severity::Note, file.string(), "file",
                              "not needed for physics and dropped: " + read.left_out.text, ""});
    }
    if (!geometry && read.scene->HasMeshes()) {
      loaded.notes.push_back(
          {Severity::Note, file.string(), "file", "meshes are not read, as asked for", ""});
    }
    loaded.value = model_of(read, file, geometry, loaded.notes);
  } catch (const std::exception& e) {
    loaded.notes.push_back(unexpected(file, e));
  }
  if (has_error(loaded.notes)) loaded.value.reset();
  return loaded;
}

}  // namespace pantin::assimp_loader
