#pragma once
// Reads whatever assimp reads (OBJ, STL, PLY, COLLADA, FBX, 3DS, ...). assimp runs in this process and is not
// shielded: a damaged file may take the process down. Numbers come in single precision, as assimp delivers
// them.
#include <filesystem>
#include <memory>

#include <pantin/bridge/loaders/load_model.hpp>

namespace pantin {

/// See load_model. The model keeps its own up axis (Model::up_axis; nothing is turned) and is in metres: a
/// unit of u metres multiplies translations, vertices and translation keys, and no matrix gets a scale. Where
/// a format says neither, the customary ones are taken (assimp_frame.hpp lists them) and noted.
[[nodiscard]] Loaded<Model> load_assimp(const std::filesystem::path& file, const LoadOptions& options = {});

/// All triangles of a mesh file in one mesh, node transforms applied: the geometry of a URDF <mesh>. As ROS
/// does, the unit that the file states is applied, its up axis is not: vertices stand in the axes that they
/// were written in.
[[nodiscard]] Loaded<std::shared_ptr<const TriangleMesh>> load_mesh(const std::filesystem::path& file);

/// Whether assimp has an importer for files of this extension. Not for ".xml", which may be anything.
[[nodiscard]] bool assimp_reads(const std::filesystem::path& file);

}  // namespace pantin
