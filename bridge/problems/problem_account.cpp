#include "problem_account.hpp"

#include <map>

#include "rigid_ref_parts.hpp"

namespace pantin::reference {
namespace {

constexpr const char* kNotNeeded = "not needed to solve it";
constexpr const char* kUnseen = "is not read here";

/// A value whose turn has not come.
struct Open {
  const JsonValue* value;
  std::string pointer;
  std::string subject;
  const char* why;  ///< it is dropped, with what it is in; null if not
};

const char* why_dropped(const JsonValue& value) {
  switch (value.use) {
    case JsonUse::Read:
      return nullptr;
    case JsonUse::NotNeeded:
      return kNotNeeded;
    case JsonUse::Unknown:
      return "the reader does not know this key";
    case JsonUse::Unseen:
      break;
  }
  return kUnseen;
}

/// "body 'arm'" for the elements of the lists in a problem; what is deeper belongs to them.
std::string subject_in(const std::string& key, const JsonValue& element) {
  static const std::map<std::string, const char*> kParts{
      {"bodies", "body"},   {"particles", "particle"}, {"kinematic_bodies", "kinematic body"},
      {"joints", "joint"},  {"forces", "force"},       {"contacts", "contact"},
      {"samples", "sample"}};
  const auto part = kParts.find(key);
  return part == kParts.end() ? "problem" : subject_of(part->second, element);
}

}  // namespace

void settle(const JsonValue& root, const std::string& file, std::vector<Diagnostic>& ledger,
            Account* account) {
  std::map<std::string, std::size_t> not_needed;
  std::vector<Open> open{{&root, "", "problem", nullptr}};
  while (!open.empty()) {
    const Open at = std::move(open.back());
    open.pop_back();
    if (account != nullptr && !at.pointer.empty())
      account->push_back({.fate = at.why != nullptr ? Fate::Dropped : Fate::Read,
                          .place = file + '#' + at.pointer,
                          .subject = at.subject,
                          .item = at.pointer,
                          .why = at.why != nullptr ? at.why : ""});
    const bool is_top = at.pointer.find('/', 1) == std::string::npos;
    for (std::size_t i = at.value->elements.size(); i-- > 0;) {
      const JsonValue& element = at.value->elements[i];
      if (element.kind != JsonKind::Object) continue;  // a number in a list is a part of it
      open.push_back({&element, at.pointer + '/' + std::to_string(i),
                      is_top && !at.pointer.empty() ? subject_in(at.pointer.substr(1), element) : at.subject,
                      at.why != nullptr ? at.why : why_dropped(element)});
    }
    for (std::size_t i = at.value->members.size(); i-- > 0;) {
      const auto& [key, member] = at.value->members[i];
      Open below{&member, at.pointer + '/' + pointer_token(key), at.subject, at.why};
      if (below.why == nullptr) {
        below.why = why_dropped(member);
        if (member.use == JsonUse::NotNeeded) ++not_needed[key];
        if (member.use == JsonUse::Unseen)
          ledger.push_back({Severity::Warning, file + '#' + below.pointer, at.subject,
                            '\'' + key + "' " + kUnseen + ": dropped", "check its spelling"});
      }
      open.push_back(std::move(below));
    }
  }
  std::string list;
  for (const auto& [key, count] : not_needed)
    list += (list.empty() ? "'" : ", '") + key + '\'' +
            (count > 1 ? " (" + std::to_string(count) + " times)" : "");
  if (!list.empty())
    ledger.push_back(
        {Severity::Note, file, "problem", std::string{kNotNeeded} + " and dropped: " + list, ""});
}

}  // namespace pantin::reference
