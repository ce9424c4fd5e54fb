#pragma once
// Reads animations into clips: channels of translation, rotation and scale with all three interpolations.
// glTF 2.0, 3.11 and appendix C.
#include "gltf_accessors.hpp"
#include "gltf_nodes.hpp"

namespace pantin::gltf {

void read_animations(const Document& document, const SceneNodes& nodes, Accessors& accessors, Model& model);

}  // namespace pantin::gltf
