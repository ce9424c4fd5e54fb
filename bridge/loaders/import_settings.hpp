#pragma once
// What a file may cost the helper process that parses it, and where that helper is.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace pantin {

/// Formats other than URDF, glTF, OBJ, STL and PLY are parsed by a small program, pantin-import, in a process
/// of its own, so that a damaged file that crashes or hangs their parser ends that process and not this one.
struct ImportSettings {
  std::filesystem::path helper{};  ///< the program; empty = environment variable PANTIN_IMPORT, else
                                   ///< ../libexec/pantin-import seen from the running program or shared
                                   ///< library, else where it was configured to be installed
  double cpu_s{0};                 ///< CPU time [s], > 0; 0 = 4 s and one more for each megabyte of the file
  double wall_s{0};                ///< elapsed time [s], > 0; 0 = four times the CPU time
  std::uint64_t memory_bytes{0};   ///< address space, >= 64 MiB; 0 = 512 MiB and 100 bytes for each of the
                                   ///< file; not limited in builds with address or thread sanitizer
};

/// Why settings cannot be used; nothing where they can.
[[nodiscard]] std::optional<std::string> problem_with(const ImportSettings& settings);

}  // namespace pantin
