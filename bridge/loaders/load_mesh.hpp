#pragma once
// The geometry of a mesh file that a robot names.
#include <filesystem>
#include <memory>

#include <pantin/bridge/loaders/load_model.hpp>

namespace pantin {

/// All triangles of a file of any known format in one mesh, node transforms applied: the geometry of a URDF
/// <mesh>. As ROS does, the unit that the file states is applied, its up axis is not: vertices stand in the
/// axes that they were written in. Mirroring nodes keep triangles facing outward. Notes about what such files
/// usually do not say, or what physics does not need, are left out.
[[nodiscard]] Loaded<std::shared_ptr<const TriangleMesh>> load_mesh(const std::filesystem::path& file,
                                                                    const LoadOptions& options = {});

}  // namespace pantin
