#pragma once
// What a loader, the hand-over or a command has to say about its input. Nothing is dropped silently: what was
// converted, defaulted or dropped stands in the ledger, a list of these.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pantin {

enum class Severity {
  Note,     ///< converted or defaulted as documented
  Warning,  ///< dropped, doubtful or kept though unphysical; an error under --strict
  Error,    ///< the input cannot be used
};

/// One finding: where, about what, what is wrong, what to do.
struct Diagnostic {
  Severity severity{Severity::Error};
  std::string place{};    ///< "file:line", "file#/json/pointer", or a node path
  std::string subject{};  ///< "joint 'grip'", "node 'arm/hand'", ...
  std::string problem{};  ///< "mimic names 'palm', which does not exist"
  std::string remedy{};   ///< may be empty
};

/// "note", "warning", "error".
[[nodiscard]] std::string_view to_string(Severity severity) noexcept;
/// "place: severity: subject: problem; remedy" on one line; control characters of the input are escaped.
[[nodiscard]] std::string to_string(const Diagnostic& diagnostic);

/// Text of the input made fit for one line of a terminal: control characters are escaped.
[[nodiscard]] std::string printable(std::string_view text);

[[nodiscard]] bool has_error(const std::vector<Diagnostic>& notes) noexcept;

/// A value and its ledger. No value where one of the notes is an error.
template <class T>
struct Loaded {
  std::optional<T> value{};
  std::vector<Diagnostic> notes{};
};

}  // namespace pantin
