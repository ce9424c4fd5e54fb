#pragma once
// Ledgers as JSON: on their own inside another document, and of several files as `pantin check` gives them.
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/writers/json_stream.hpp>

namespace pantin {

/// [{"severity", "place", "subject", "problem", "remedy"}, ...] as the next value of the stream.
void write_ledger(JsonStream& json, std::span<const Diagnostic> ledger);

/// What a check found out about one file.
struct CheckedFile {
  std::string file{};  ///< as it was named
  bool ok{false};
  std::vector<Diagnostic> ledger{};
};

/// [{"file", "ok", "ledger"}, ...]
void write_check_json(std::ostream& out, std::span<const CheckedFile> files);

/// {"ledger"}: what a command has to say that came to nothing else.
void write_failure_json(std::ostream& out, std::span<const Diagnostic> ledger);

}  // namespace pantin
