#pragma once
// Runs one program to its end, or ends it: what it writes to descriptor 3 is its result, what it writes to
// standard output and error is noise. Knows nothing of models.
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace pantin {

struct ProcessLimits {
  double wall_s{10};                               ///< elapsed time [s], > 0
  std::size_t result_bytes{std::size_t{1} << 31};  ///< more ends the program
  std::size_t noise_bytes{std::size_t{1} << 16};   ///< the rest is read and dropped
};

enum class ProcessEnd {
  NotStarted,  ///< `detail` is errno
  Exited,      ///< `detail` is the exit code
  Signalled,   ///< `detail` is the signal
  TimedOut,    ///< killed at wall_s
  TooMuch,     ///< killed at result_bytes
  Unseen,      ///< ended, but somebody else (a handler of SIGCHLD) took its status
};

struct ProcessResult {
  ProcessEnd end{ProcessEnd::NotStarted};
  int detail{0};
  std::string result{};
  std::string noise{};
};

/// Runs `program` with `arguments` (without the name), standard input empty. No other descriptor reaches it,
/// none stays open here, no zombie is left, and any number of threads may call. Throws std::bad_alloc at
/// most, after the program was ended.
[[nodiscard]] ProcessResult run_process(const std::filesystem::path& program,
                                        std::span<const std::string> arguments, const ProcessLimits& limits);

}  // namespace pantin
