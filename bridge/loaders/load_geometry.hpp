#pragma once
// Reads mesh files that hold triangles and nothing else: OBJ, STL and PLY, by readers of our own. They are
// small, in double precision, name line or byte of what is wrong, and take no process of their own, which the
// dozens of meshes of a robot would each start.
#include <filesystem>

#include <pantin/bridge/loaders/load_model.hpp>

namespace pantin {

/// See load_model. One part (object or group of OBJ, solid of STL): one node that carries it, named like it;
/// several: children of a node named like the file. Units are metres and the up axis Z (OBJ: Y), as none of
/// these formats says; noted. Polygons are cut into triangles; colours, normals, texture coordinates and
/// materials are dropped with a note, points and lines with a warning.
[[nodiscard]] Loaded<Model> load_geometry(const std::filesystem::path& file, const LoadOptions& options = {});

/// Whether the extension is .obj, .stl or .ply, in any case.
[[nodiscard]] bool geometry_reads(const std::filesystem::path& file);

}  // namespace pantin
