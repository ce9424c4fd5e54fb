#pragma once
// A model for people: what `pantin info` prints.
#include <ostream>
#include <string>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/writers/model_json.hpp>

namespace pantin::cli {

/// Head, a row for each node, clips, ledger.
void print_model(std::ostream& out, const std::string& file, const ModelInScene& view,
                 const std::vector<Diagnostic>& ledger);

/// "urdf, 7 nodes, 6 links, 2.3 kg": a model in one line.
[[nodiscard]] std::string outline(const Model& model);

}  // namespace pantin::cli
