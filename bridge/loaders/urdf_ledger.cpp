#include <pantin/bridge/loaders/urdf_ledger.hpp>

#include <algorithm>
#include <utility>

namespace pantin::urdf_loader {

void Ledger::add(Severity severity, Finding finding) {
  has_error_ = has_error_ || severity == Severity::Error;
  entries_.push_back({finding.line,
                      {severity, place(finding.line), std::move(finding.subject), std::move(finding.problem),
                       std::move(finding.remedy)}});
}

void Ledger::alike(Severity severity, const std::string& kind, Finding finding, std::size_t most) {
  if (severity == Severity::Note) most = 1;
  Kind& seen = kinds_[kind];
  if (seen.shown == most) {
    ++seen.more;
    has_error_ = has_error_ || severity == Severity::Error;
    return;
  }
  ++seen.shown;
  seen.last_entry = entries_.size();
  add(severity, std::move(finding));
}

std::string Ledger::place(int line) const { return line > 0 ? file_ + ':' + std::to_string(line) : file_; }

std::vector<Diagnostic> Ledger::take() {
  for (const auto& [kind, seen] : kinds_) {
    if (seen.more == 0) continue;
    entries_[seen.last_entry].diagnostic.problem += " (and " + std::to_string(seen.more) + " more alike)";
  }
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.line < b.line; });
  std::vector<Diagnostic> all;
  all.reserve(entries_.size());
  for (Entry& entry : entries_) all.push_back(std::move(entry.diagnostic));
  *this = Ledger{file_};
  return all;
}

}  // namespace pantin::urdf_loader
