#pragma once
// Brings links to values named on the command line, and what mimics them along.
#include <string>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/scenegraph/scene.hpp>

namespace pantin::cli {

/// Applies arguments NAME=VALUE (parse_joint accepts them) to the scene, which they leave untouched if one is
/// wrong: a name that no link has, a number of values that does not fit, a link that is fixed. NAME is a
/// LinkKeys key. `models` holds the nodes of each model: a link that mimics another of its own model follows
/// it, also over several links, unless it is named itself. A value outside the limits is set, with a warning.
[[nodiscard]] std::vector<Diagnostic> configure_links(Scene& scene, const std::vector<std::string>& arguments,
                                                      const std::vector<std::vector<NodeId>>& models);

}  // namespace pantin::cli
