#pragma once
// Ledgers as JSON: on their own inside another document, and of several files as `pantin check` gives them.
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include <pantin/bridge/account.hpp>
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
  Account account{};  ///< of every element and attribute; empty where it cannot be used
};

/// How much of an account is written.
enum class AccountDetail {
  Counts,  ///< {"read", "converted", "defaulted", "dropped"}
  Every,   ///< these, and every entry
};

/// [{"file", "ok", "ledger", "counts", "account"}, ...]; `account` only where all of it is asked for.
void write_check_json(std::ostream& out, std::span<const CheckedFile> files, AccountDetail detail);

/// {"ledger"}: what a command has to say that came to nothing else.
void write_failure_json(std::ostream& out, std::span<const Diagnostic> ledger);

}  // namespace pantin
