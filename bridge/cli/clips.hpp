#pragma once
// Finding clips of a model by what a user calls them.
#include <optional>
#include <string_view>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/model.hpp>

namespace pantin::cli {

/// Position of the first clip of that name, else of the k-th one where the name is "[k]"; nothing if there is
/// none.
[[nodiscard]] std::optional<std::size_t> find_clip(const Model& model, std::string_view name);

/// The error for a clip that a model does not have.
[[nodiscard]] Diagnostic unknown_clip(const Model& model, std::string_view option, std::string_view name);

}  // namespace pantin::cli
