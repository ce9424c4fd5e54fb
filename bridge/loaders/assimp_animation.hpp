#pragma once
// Clips out of assimp's animations.
#include <string>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/model.hpp>

struct aiScene;

namespace pantin::assimp_loader {

/// Every animation of the scene as a clip over `model.nodes`, in seconds and metres. assimp delivers
/// interpolated keys only, so all tracks are linear. Channels find their node by name: of several, the first
/// in the order of `model.nodes`, with a warning; a channel without node or with unusable keys is dropped
/// with a warning.
void add_clips(const aiScene& scene, const std::string& place, Model& model, std::vector<Diagnostic>& notes);

}  // namespace pantin::assimp_loader
