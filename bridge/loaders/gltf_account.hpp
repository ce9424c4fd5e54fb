#pragma once
// The end of reading a document: every value of it must have been read or left out with a finding. What
// neither is true of is told here, so that nothing can be overlooked.
#include <pantin/bridge/account.hpp>

#include "gltf_document.hpp"

namespace pantin::gltf {

/// Tells of what is left, summed up where glTF 2.0 knows it and a warning where it does not; then gives
/// `account` an entry for every member of an object and every object or array in an array. It may be null.
void settle(const Document& document, Account* account);

}  // namespace pantin::gltf
