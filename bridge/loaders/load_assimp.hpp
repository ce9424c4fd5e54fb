#pragma once
// Reads what assimp reads beside OBJ, STL, PLY and glTF, which have readers of their own: COLLADA, FBX, BVH,
// 3DS, ... assimp runs in pantin-import, a process of its own (import_settings.hpp), so that a damaged file
// that crashes it, hangs it or eats the memory is a diagnostic here. Numbers come in single precision.
#include <filesystem>
#include <span>
#include <string_view>

#include <pantin/bridge/loaders/load_model.hpp>

namespace pantin {

/// See load_model. The model keeps its own up axis (Model::up_axis; nothing is turned) and is in metres: a
/// unit of u metres multiplies translations, vertices and translation keys, and no matrix gets a scale. Where
/// a format says neither, the customary ones are taken (assimp_frame.hpp lists them) and noted. What the
/// parser prints stands in the notes. Errors also where the helper is missing, crashes (its signal is named)
/// or meets a limit (which is named).
[[nodiscard]] Loaded<Model> load_assimp(const std::filesystem::path& file, const LoadOptions& options = {});

/// Extensions of the formats that pantin-import knows, with the point, in lower case, sorted.
[[nodiscard]] std::span<const std::string_view> assimp_extensions();

/// Whether files of this extension are among them. Not for ".xml", which may be anything.
[[nodiscard]] bool assimp_reads(const std::filesystem::path& file);

}  // namespace pantin
