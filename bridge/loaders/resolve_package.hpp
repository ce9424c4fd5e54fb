#pragma once
// Finds the files that a robot description names: package://NAME/..., file://..., or a path relative to it.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pantin {

/// A file name resolved, or where it was looked for.
struct ResolvedFile {
  std::filesystem::path path{};                ///< an existing regular file; empty if there is none
  std::string package{};                       ///< NAME of package://NAME/...; empty for other names
  std::vector<std::filesystem::path> tried{};  ///< candidates that do not exist, in order; each once
  std::string problem{};                       ///< why no file was found; empty if one was
};

/// Resolves `uri` as used in `model`. For package://NAME/REST, in this order:
/// 1. each of `package_paths`, 2. each folder of ROS_PACKAGE_PATH: either holds a folder NAME or is the
/// package itself;
/// 3. share/NAME below each folder of AMENT_PREFIX_PATH;
/// 4. the model's folder and all above: each may be the package, or hold a folder NAME.
/// A folder is the package NAME if it is called so or its package.xml says so. Percent escapes are decoded in
/// file:// names. Never throws.
[[nodiscard]] ResolvedFile resolve_package(std::string_view uri, const std::filesystem::path& model,
                                           std::span<const std::filesystem::path> package_paths);

/// The candidates as text, at most three and the number of the others.
[[nodiscard]] std::string tried_text(const ResolvedFile& file);

}  // namespace pantin
