#pragma once
// Reads whatever assimp reads (OBJ, STL, PLY, COLLADA, FBX, 3DS, ...). assimp runs in this process and is not shielded:
// a damaged file may take the process down.
#include <filesystem>
#include <memory>

#include <pantin/bridge/loaders/load_model.hpp>

namespace pantin {

/// See load_model. Unit and up axis of the file are applied or kept explicitly and reported.
[[nodiscard]] Loaded<Model> load_assimp(const std::filesystem::path& file, const LoadOptions& options = {});

/// All triangles of a mesh file in one mesh, in the file's own frame and unit, node transforms applied: the geometry of
/// a URDF <mesh>.
[[nodiscard]] Loaded<std::shared_ptr<const TriangleMesh>> load_mesh(const std::filesystem::path& file);

/// Whether assimp has an importer for files of this extension.
[[nodiscard]] bool assimp_reads(const std::filesystem::path& file);

}  // namespace pantin
