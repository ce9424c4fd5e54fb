#pragma once
// Ledgers for people: findings that say the same are one line with a count, errors go to standard error.
#include <ostream>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>

namespace pantin::cli {

/// Collects findings of a command; one that says exactly what another said is not taken twice.
class Ledger {
 public:
  /// Under --strict warnings become errors as they come in.
  explicit Ledger(bool strict) : strict_{strict} {}

  void add(Diagnostic note);
  void add(const std::vector<Diagnostic>& notes);
  [[nodiscard]] const std::vector<Diagnostic>& notes() const noexcept { return notes_; }
  [[nodiscard]] bool has_error() const noexcept { return pantin::has_error(notes_); }

 private:
  bool strict_;
  std::vector<Diagnostic> notes_{};
  std::unordered_set<std::string> seen_{};
};

/// Warnings become errors.
void make_strict(std::vector<Diagnostic>& notes);

/// Errors to standard error, one a line.
void print_errors(const std::vector<Diagnostic>& notes);
/// What is no error to `out`, one line for all findings of the same problem and remedy.
void print_remarks(std::ostream& out, std::span<const Diagnostic> notes);

}  // namespace pantin::cli
