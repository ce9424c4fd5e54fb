#pragma once
// The sources as text, and the rule of layers: who may include what.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pantin::test {

struct SourceFile {
  std::string path{};  ///< from the top of the sources, with /
  std::string text{};
};

/// All files of these folders (from the top of the sources) with one of these extensions, in the order of
/// their paths.
[[nodiscard]] std::vector<SourceFile> files_in(const std::vector<std::string>& folders,
                                               const std::vector<std::string>& extensions);

/// The lines of a text.
[[nodiscard]] std::vector<std::string> lines_of(std::string_view text);

/// An #include as written: <name> or "name".
struct Include {
  std::string name{};
  bool quoted{false};
};
[[nodiscard]] std::vector<Include> includes_of(std::string_view text);

/// Which rule an include in this file breaks, if any.
[[nodiscard]] std::optional<std::string> broken_rule(const std::string& path, const Include& include);

/// The conditions of the preprocessor in a text: the lines #if, #ifdef, #ifndef, #elif.
[[nodiscard]] std::vector<std::string> conditions_of(std::string_view text);

}  // namespace pantin::test
