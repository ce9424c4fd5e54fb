#pragma once
// Reads the meshes that the scene's nodes carry: positions and triangles, the primitives of a mesh in one.
// Nodes that carry the same mesh share it.
#include "gltf_accessors.hpp"
#include "gltf_nodes.hpp"

namespace pantin::gltf {

void read_meshes(const Document& document, const SceneNodes& nodes, Accessors& accessors, Model& model);

}  // namespace pantin::gltf
