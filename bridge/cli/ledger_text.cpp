#include <pantin/bridge/cli/ledger_text.hpp>

#include <iostream>
#include <map>
#include <tuple>

namespace pantin::cli {

void Ledger::add(Diagnostic note) {
  if (strict_ && note.severity == Severity::Warning) note.severity = Severity::Error;
  if (seen_.insert(to_string(note)).second) notes_.push_back(std::move(note));
}

void Ledger::add(const std::vector<Diagnostic>& notes) {
  for (const Diagnostic& note : notes) add(note);
}

void make_strict(std::vector<Diagnostic>& notes) {
  for (Diagnostic& note : notes)
    if (note.severity == Severity::Warning) note.severity = Severity::Error;
}

void print_errors(const std::vector<Diagnostic>& notes) {
  for (const Diagnostic& note : notes)
    if (note.severity == Severity::Error) std::cerr << to_string(note) << '\n';
  std::cerr.flush();
}

void print_remarks(std::ostream& out, std::span<const Diagnostic> notes) {
  struct Group {
    const Diagnostic* first{nullptr};
    std::size_t count{0};
  };
  std::vector<Group> groups;
  std::map<std::tuple<Severity, std::string_view, std::string_view>, std::size_t> index;
  for (const Diagnostic& note : notes) {
    if (note.severity == Severity::Error) continue;
    const auto [entry, is_new] = index.try_emplace({note.severity, note.problem, note.remedy}, groups.size());
    if (is_new) groups.push_back({&note, 0});
    ++groups[entry->second].count;
  }
  for (const Group& group : groups) {
    out << "  " << to_string(*group.first);
    if (group.count > 1) out << " (and " << group.count - 1 << " more like it)";
    out << '\n';
  }
}

}  // namespace pantin::cli
