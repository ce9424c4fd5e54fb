#pragma once
// urdfdom, kept quiet: its messages go into the ledger instead of the console.
#include <memory>
#include <string>

#include <pantin/bridge/loaders/urdf_ledger.hpp>

namespace urdf {
class ModelInterface;
}

namespace pantin::urdf_loader {

/// Parses `xml` by urdfdom; null and an error in the ledger where it refuses. Calls in several threads wait
/// for each other, because urdfdom reports through one global handler.
[[nodiscard]] std::shared_ptr<urdf::ModelInterface> parse_urdf(const std::string& xml, Ledger& ledger);

}  // namespace pantin::urdf_loader
