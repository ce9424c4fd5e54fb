#pragma once
// Reads glTF 2.0 and GLB, in double precision from its own JSON.
#include <filesystem>

#include <pantin/bridge/loaders/load_model.hpp>

namespace pantin {

/// See load_model.
[[nodiscard]] Loaded<Model> load_gltf(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace pantin
