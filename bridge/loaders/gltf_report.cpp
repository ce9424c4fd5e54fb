#include "gltf_report.hpp"

namespace pantin::gltf {
namespace {

/// More errors than this are counted but not told one by one.
constexpr std::size_t kToldErrors = 20;
/// More kinds of notes and warnings than this share one entry.
constexpr std::size_t kToldKinds = 200;

constexpr const char* kOtherKinds = "there are findings of further kinds";

std::string singular(std::string_view collection) {
  if (collection == "meshes") return "mesh";
  if (collection.size() > 1 && collection.back() == 's') collection.remove_suffix(1);
  return shortened(collection);
}

}  // namespace

std::string subject_of(const JsonValue& value) {
  JsonValue item = value;
  std::optional<JsonValue> collection = item.parent();
  if (!collection) return "document";
  while (const std::optional<JsonValue> above = collection->parent()) {
    if (!above->parent()) break;
    item = *collection;
    collection = above;
  }
  if (!collection->parent()) return "'" + shortened(item.key()) + "'";
  if (collection->kind() != JsonKind::Array) return "'" + shortened(collection->key()) + "'";
  std::string subject = singular(collection->key()) + ' ' + std::to_string(item.position());
  const std::optional<JsonValue> name = item.find("name");
  if (name && !name->text().empty()) subject += " '" + shortened(name->text()) + "'";
  return subject;
}

std::string Report::place(const JsonValue& at) const {
  const std::string pointer = at.pointer();
  return pointer.empty() ? file_ : file_ + '#' + pointer;
}

void Report::add_error(Diagnostic diagnostic) {
  if (++errors_ <= kToldErrors) findings_.push_back({std::move(diagnostic)});
}

void Report::refuse(const JsonValue& at, std::string problem, std::string remedy) {
  add_error({Severity::Error, place(at), subject_of(at), std::move(problem), std::move(remedy)});
  throw Refused{};
}

void Report::refuse_file(std::string problem, std::string remedy, std::size_t line) {
  const std::string place = line > 0 ? file_ + ':' + std::to_string(line) : file_;
  add_error({Severity::Error, place, "file", std::move(problem), std::move(remedy)});
  throw Refused{};
}

void Report::refuse_with(Diagnostic diagnostic) {
  add_error(std::move(diagnostic));
  throw Refused{};
}

void Report::count_in(const std::string& kind, std::size_t count, Diagnostic diagnostic) {
  if (const auto found = kinds_.find(kind); found != kinds_.end()) {
    findings_[found->second].count += count;
    return;
  }
  if (kinds_.size() >= kToldKinds && kind != kOtherKinds)
    return count_in(kOtherKinds, count,
                    {Severity::Warning, file_, "file", kOtherKinds, "mend the ones told first"});
  kinds_.emplace(kind, findings_.size());
  findings_.push_back({std::move(diagnostic), count});
}

void Report::tally(Severity severity, std::string subject, const JsonValue& at, const std::string& problem,
                   std::string remedy, std::size_t count) {
  const std::string kind = subject + '\n' + problem;
  count_in(kind, count, {severity, place(at), std::move(subject), problem, std::move(remedy)});
}

void Report::tally(Severity severity, const JsonValue& at, const std::string& problem, std::string remedy) {
  count_in(problem, 1, {severity, place(at), subject_of(at), problem, std::move(remedy)});
}

void Report::drop(Severity severity, std::string subject, const JsonValue& at, const std::string& problem,
                  std::string remedy, std::size_t count) {
  marks_.drop(at, problem);
  tally(severity, std::move(subject), at, problem, std::move(remedy), count);
}

void Report::drop(Severity severity, const JsonValue& at, const std::string& problem, std::string remedy) {
  marks_.drop(at, problem);
  tally(severity, at, problem, std::move(remedy));
}

void Report::convert(Severity severity, const JsonValue& at, const std::string& problem, std::string remedy) {
  marks_.convert(at, problem);
  tally(severity, at, problem, std::move(remedy));
}

void Report::supply(const JsonValue& at, std::string_view key, std::string why) {
  supplied_.push_back({.fate = Fate::Defaulted,
                       .place = place(at),
                       .subject = subject_of(at),
                       .item = at.pointer() + '/' + std::string{key},
                       .why = std::move(why)});
}

void Report::mention(Severity severity, std::string subject, std::string problem, std::string remedy) {
  const std::string kind = subject + '\n' + problem;
  count_in(kind, 1, {severity, file_, std::move(subject), std::move(problem), std::move(remedy)});
}

void Report::stop_at_errors() const {
  if (has_errors()) throw Refused{};
}

std::vector<Diagnostic> Report::take() {
  std::vector<Diagnostic> result;
  for (Finding& finding : findings_) {
    if (finding.count > 1)
      finding.diagnostic.problem += " (" + std::to_string(finding.count) + " times, first here)";
    result.push_back(std::move(finding.diagnostic));
  }
  if (errors_ > kToldErrors)
    result.push_back({Severity::Error, file_, "file",
                      "has " + std::to_string(errors_ - kToldErrors) + " more errors",
                      "mend the ones above first"});
  findings_.clear();
  return result;
}

}  // namespace pantin::gltf
