#pragma once
// Which way is up in a file and how long its unit is. The rules, in one place:
// - COLLADA says both. assimp works them into the top node (a turn to Y up, a scale to metres), which holds
// nothing
//   else; they are read back from it and taken out again.
// - FBX says both in its settings; assimp leaves the content alone.
// - Other formats say neither: Y is up (what assimp's importers turn their scenes to), but Z for the formats
// of
//   printers and scanners (STL, PLY, 3MF, AMF); the unit is a metre.
#include <string_view>

#include <pantin/bridge/loaders/assimp_scene.hpp>

namespace pantin::assimp_loader {

[[nodiscard]] FileFrame frame_of(const aiScene& scene, std::string_view extension);

/// The findings that tell what was stated, taken or defaulted.
[[nodiscard]] std::vector<Diagnostic> notes_about(const FileFrame& frame, const std::string& place);

}  // namespace pantin::assimp_loader
