#include <pantin/bridge/loaders/import_place.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace pantin {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "pantin-import";

/// Tries candidates until one is a file.
class Search {
 public:
  void try_file(const fs::path& file) {
    if (file.empty() || !found_.path.empty()) return;
    const fs::path candidate = file.lexically_normal();
    if (std::find(found_.tried.begin(), found_.tried.end(), candidate) != found_.tried.end()) return;
    std::error_code ignored;
    if (fs::is_regular_file(candidate, ignored)) found_.path = candidate;
    found_.tried.push_back(candidate);
  }
  /// libexec may be a sibling of the folder (bin, lib) or of the one above (lib/x86_64-linux-gnu).
  void try_beside(const fs::path& program) {
    if (!program.is_absolute()) return;
    const fs::path folder = program.parent_path();
    try_file(folder / ".." / "libexec" / kName);
    try_file(folder / ".." / ".." / "libexec" / kName);
  }
  [[nodiscard]] ImportHelper take() { return std::move(found_); }

 private:
  ImportHelper found_{};
};

/// The shared library, or the program, that holds this function.
fs::path own_library() {
  Dl_info about{};
  if (dladdr(reinterpret_cast<const void*>(&find_import_helper), &about) == 0 || about.dli_fname == nullptr)
    return {};
  std::error_code ignored;
  return fs::canonical(about.dli_fname, ignored);
}

}  // namespace

ImportHelper find_import_helper(const fs::path& asked) {
  Search search;
  const char* set = std::getenv("PANTIN_IMPORT");
  if (!asked.empty()) {
    search.try_file(asked);
  } else if (set != nullptr && *set != '\0') {
    search.try_file(set);
  } else {
    std::error_code ignored;
    search.try_beside(fs::read_symlink("/proc/self/exe", ignored));
    search.try_beside(own_library());
    search.try_file(PANTIN_IMPORT_PATH);
  }
  return search.take();
}

}  // namespace pantin
