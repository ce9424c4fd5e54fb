#pragma once
// Finds what a user may have meant by a name that does not exist.
#include <string>
#include <string_view>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/scenegraph/scene.hpp>

namespace pantin::cli {

/// At most three of the candidates: those that end in '/' and the wanted name first, then the nearest by
/// single-letter edits, as far as they share most of their letters.
[[nodiscard]] std::vector<std::string> near_names(std::string_view wanted,
                                                  const std::vector<std::string>& candidates);

/// "did you mean 'a' or 'b'?"; without near names, the first few candidates; what to do where there are none.
[[nodiscard]] std::string suggestion(std::string_view wanted, const std::vector<std::string>& candidates);

/// The paths of all nodes of a scene but the root.
[[nodiscard]] std::vector<std::string> all_paths(const Scene& scene);

/// An error about an argument: place is the command line, subject the option with its argument.
[[nodiscard]] Diagnostic argument_error(std::string_view option, std::string_view argument,
                                        std::string problem, std::string remedy);

/// The error for a path that no node of the scene has.
[[nodiscard]] Diagnostic unknown_path(const Scene& scene, std::string_view option, std::string_view path);

}  // namespace pantin::cli
