#pragma once
// Gathers what the glTF reader has to say. Findings of one kind are counted and told once, with the first
// place. Inside the reader a refusal travels as `Refused`; load_gltf lets none of them out.
#include <map>
#include <string>
#include <vector>

#include <pantin/bridge/account.hpp>
#include <pantin/bridge/diagnostic.hpp>

#include "gltf_json.hpp"
#include "gltf_marks.hpp"

namespace pantin::gltf {

/// Thrown once an error stands in the report, to leave the part being read.
struct Refused {};

class Report {
 public:
  explicit Report(std::string file) : file_{std::move(file)} {}

  /// An error about the value `at`; its subject is the item of the document that holds the value.
  [[noreturn]] void refuse(const JsonValue& at, std::string problem, std::string remedy);
  /// An error about the file as a whole, `line` counted from 1, 0 = none.
  [[noreturn]] void refuse_file(std::string problem, std::string remedy, std::size_t line = 0);

  /// An error found by others.
  [[noreturn]] void refuse_with(Diagnostic diagnostic);

  /// A finding that may occur many times: equal subject and problem are told once, with count and first
  /// place.
  void tally(Severity severity, std::string subject, const JsonValue& at, const std::string& problem,
             std::string remedy, std::size_t count = 1);
  /// The same, told of the item that holds the first such value.
  void tally(Severity severity, const JsonValue& at, const std::string& problem, std::string remedy);
  /// The same as both, of a value that is left out with all that it holds.
  void drop(Severity severity, std::string subject, const JsonValue& at, const std::string& problem,
            std::string remedy, std::size_t count = 1);
  void drop(Severity severity, const JsonValue& at, const std::string& problem, std::string remedy);
  /// The same as the second, of a value that is in the model as another.
  void convert(Severity severity, const JsonValue& at, const std::string& problem, std::string remedy);
  /// Something that the file does not say and that has a value nevertheless; `key` is where it would stand.
  void supply(const JsonValue& at, std::string_view key, std::string why);
  [[nodiscard]] Marks& marks() noexcept { return marks_; }
  [[nodiscard]] const std::vector<AccountEntry>& supplied() const noexcept { return supplied_; }
  /// A finding about the file as a whole.
  void mention(Severity severity, std::string subject, std::string problem, std::string remedy);

  /// Runs `part`; false if it was refused, so that the next one can be read and told of as well.
  template <class Part>
  bool try_part(const Part& part) {
    try {
      part();
      return true;
    } catch (const Refused&) {
      return false;
    }
  }

  [[nodiscard]] bool has_errors() const noexcept { return errors_ > 0; }
  [[nodiscard]] std::size_t error_count() const noexcept { return errors_; }
  /// Leaves the part being read if anything was refused so far.
  void stop_at_errors() const;
  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] std::string place(const JsonValue& at) const;
  /// Everything found, in the order of first occurrence.
  [[nodiscard]] std::vector<Diagnostic> take();

 private:
  struct Finding {
    Diagnostic diagnostic;
    std::size_t count{1};
  };
  void count_in(const std::string& kind, std::size_t count, Diagnostic diagnostic);
  void add_error(Diagnostic diagnostic);

  std::string file_;
  std::vector<Finding> findings_;
  std::map<std::string, std::size_t> kinds_;  // kind -> position in findings_
  std::size_t errors_{0};
  Marks marks_{};
  std::vector<AccountEntry> supplied_{};
};

/// "node 3 'crate'", "accessor 7", "asset", ...: the item of the document's top level that holds the value.
[[nodiscard]] std::string subject_of(const JsonValue& value);

}  // namespace pantin::gltf
