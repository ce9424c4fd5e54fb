#pragma once
// The part of the extension KHR_physics_rigid_bodies (review draft) that is read: the mass of a node. Its
// colliders, triggers, joints and start velocities are told of as not read.
#include <pantin/physics/mass_properties.hpp>

#include "gltf_document.hpp"

namespace pantin::gltf {

/// The `motion` of a node as mass properties in the node's axes; nothing where the file gives no mass. Where
/// it gives no moments of inertia they are zero here.
[[nodiscard]] std::optional<MassProperties> read_motion(Report& report, const JsonValue& node);

/// Tells of the materials, joints and filters that the extension keeps at the document's top.
void note_physics_lists(const Document& document);

}  // namespace pantin::gltf
