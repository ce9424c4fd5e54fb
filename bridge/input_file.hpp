#pragma once
// Opening input: what can be wrong with a file before its content matters, said the same way by every loader.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <pantin/bridge/diagnostic.hpp>

namespace pantin {

/// Why a file cannot be read: missing, a folder, not a regular file (a device or pipe may never end), empty,
/// larger than `max_bytes`, not permitted. Nothing where it can. Never throws.
[[nodiscard]] std::optional<Diagnostic> problem_with_file(const std::filesystem::path& file,
                                                          std::uintmax_t max_bytes);

/// The bytes of a file, or the error of problem_with_file.
[[nodiscard]] Loaded<std::string> read_file(const std::filesystem::path& file, std::uintmax_t max_bytes);

/// ".stl" of "Part.STL": the extension in lower case (ASCII), with its point; empty if there is none.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);

}  // namespace pantin
