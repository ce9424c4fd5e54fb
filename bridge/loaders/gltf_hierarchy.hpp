#pragma once
// Which nodes of a glTF document make up the loaded scene, in which order, and below which parent.
#include "gltf_document.hpp"

namespace pantin::gltf {

struct Hierarchy {
  std::vector<std::int32_t> parents{};    ///< of each node of the document, -1 = none
  std::vector<std::uint32_t> order{};     ///< nodes of the scene, depth first, parents before children
  std::vector<std::int32_t> positions{};  ///< of each node of the document in `order`, -1 = not in the scene
};

/// Refuses nodes with two parents, cycles, and scenes of nodes that are children. Takes the default scene,
/// else the first, else (no scenes) all nodes without parent.
[[nodiscard]] Hierarchy read_hierarchy(const Document& document);

}  // namespace pantin::gltf
