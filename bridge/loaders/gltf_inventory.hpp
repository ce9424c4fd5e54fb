#pragma once
// Goes through a whole document and tells of everything that the reader leaves out: appearance, deformation,
// unknown extensions and properties, data of applications. What is only left out of a part that is read, that
// part tells.
#include "gltf_document.hpp"

namespace pantin::gltf {

void take_inventory(const Document& document);

/// Tells of an `extras` member.
void note_extras(Report& report, const JsonValue& extras);

}  // namespace pantin::gltf
