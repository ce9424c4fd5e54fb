#pragma once
// A Model out of whatever assimp reads. Part of pantin-import, not of the library: assimp's crashes end the
// process that calls this. Numbers come in single precision, as assimp delivers them.
#include <filesystem>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/model.hpp>

namespace pantin::assimp_loader {

/// See load_assimp. Without `geometry` the hierarchy alone.
[[nodiscard]] Loaded<Model> read_model(const std::filesystem::path& file, bool geometry);

}  // namespace pantin::assimp_loader
