#pragma once
// EXT_mesh_gpu_instancing: a node that carries its mesh many times.
#include <optional>
#include <vector>

#include <pantin/scenegraph/affine.hpp>

#include "gltf_accessors.hpp"

namespace pantin::gltf {

/// Where in the node each copy of its mesh stands, as T R S of the extension's attributes TRANSLATION,
/// ROTATION and SCALE; other attributes are noted. Nothing for a node without the extension.
[[nodiscard]] std::optional<std::vector<Affine>> read_instances(const JsonValue& node,
                                                                const Document& document,
                                                                Accessors& accessors);

}  // namespace pantin::gltf
