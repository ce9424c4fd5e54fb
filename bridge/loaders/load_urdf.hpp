#pragma once
// Reads a robot description (URDF 1.0) with a pre-flight over its XML, then by urdfdom.
#include <filesystem>

#include <pantin/bridge/loaders/load_model.hpp>

namespace pantin {

/// See load_model.
[[nodiscard]] Loaded<Model> load_urdf(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace pantin
