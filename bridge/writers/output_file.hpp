#pragma once
// A file that appears whole or not at all: written under a temporary name in the same folder, renamed at the
// end.
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <ostream>

#include <pantin/bridge/diagnostic.hpp>

namespace pantin {

/// Removes the temporary files of all that is open: for handlers of signals that end the process.
/// Async-signal-safe.
void remove_unfinished_files() noexcept;

class OutputFile {
 public:
  /// Opens a temporary file beside `file`, following a symbolic link. No value and an error where that cannot
  /// be done, also where `file` exists and is no regular file. Never throws.
  [[nodiscard]] static Loaded<OutputFile> open(const std::filesystem::path& file);

  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) noexcept;
  ~OutputFile();  ///< removes the temporary file unless it was committed

  [[nodiscard]] std::ostream& stream() noexcept;
  /// Puts the file in place. An error if anything written before or now did not arrive on the disk.
  [[nodiscard]] std::optional<Diagnostic> commit();

 private:
  struct Impl;
  explicit OutputFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace pantin
