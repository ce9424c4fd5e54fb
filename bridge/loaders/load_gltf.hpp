#pragma once
// Reads glTF 2.0 and GLB, in double precision from its own JSON: nodes, triangle meshes, animations of
// translation, rotation and scale with all three interpolations, and the masses of KHR_physics_rigid_bodies
// (review draft). What is left out (appearance, skins, morph targets, unknown extensions and properties)
// stands in the ledger, a line a kind.
#include <filesystem>

#include <pantin/bridge/loaders/load_model.hpp>

namespace pantin {

/// See load_model. +Y is up, lengths are metres. The first bytes decide between text and GLB. Buffers are
/// read only from the file itself and from its folder; a model may hold up to 2^28 bytes of JSON and 2^27
/// numbers.
[[nodiscard]] Loaded<Model> load_gltf(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace pantin
