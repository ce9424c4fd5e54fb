#pragma once
// The answer of pantin-import as bytes: a header (what it is, version, byte order, length), the ledger, and
// the model flat. Both ends are of one build; the version is checked all the same, and the reader trusts
// nothing: the writer may have been damaged by the file it read.
#include <string>
#include <string_view>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/model.hpp>

namespace pantin {

/// Nodes with name, parent, matrix and meshes, and clips; what foreign formats do not give (links, masses,
/// shapes) must be absent. Meshes that several nodes share are written once.
[[nodiscard]] std::string encode(const Loaded<Model>& loaded);

/// The same back; every count, index, enumerator and number is checked, and places of nodes are `place`.
/// Where something is wrong: no value, and one error at `place` that says what.
[[nodiscard]] Loaded<Model> decode(std::string_view bytes, const std::string& place);

}  // namespace pantin
