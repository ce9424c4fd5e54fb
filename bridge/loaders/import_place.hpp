#pragma once
// Where pantin-import is.
#include <filesystem>
#include <vector>

namespace pantin {

/// The helper program, or where it was looked for.
struct ImportHelper {
  std::filesystem::path path{};                ///< an existing regular file; empty if there is none
  std::vector<std::filesystem::path> tried{};  ///< in order; each once
};

/// In this order: `asked` if it is not empty; PANTIN_IMPORT if it is set; libexec/pantin-import beside the
/// folder of the running program, and beside that of the shared library that holds this function; the place
/// it was configured for. What is asked for or set is used or nothing: a wrong path does not fall back.
[[nodiscard]] ImportHelper find_import_helper(const std::filesystem::path& asked);

}  // namespace pantin
