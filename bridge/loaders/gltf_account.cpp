#include "gltf_account.hpp"

#include <map>
#include <vector>

namespace pantin::gltf {
namespace {

constexpr const char* kNotNeeded = "not needed for physics";

bool is_container(const JsonValue& value) {
  return value.kind() == JsonKind::Array || value.kind() == JsonKind::Object;
}

/// A number in a list of numbers is a part of the list, not an element of its own.
bool is_element(const JsonValue& value) {
  const std::optional<JsonValue> parent = value.parent();
  return parent && (parent->kind() == JsonKind::Object || is_container(value));
}

class Settlement {
 public:
  explicit Settlement(const Document& document)
      : document_{document}, report_{document.report()}, touched_(document.value_count(), false) {
    // Parents come before what they hold: backwards, a value is complete when its turn comes.
    for (std::size_t i = touched_.size(); i-- > 0;) {
      const JsonValue value = document.value(i);
      if (report_.marks().is_read(value)) touched_[i] = true;
      if (const std::optional<JsonValue> parent = value.parent(); parent && touched_[i])
        touched_[parent->index()] = true;
    }
  }

  void tell_overlooked() {
    std::map<std::string, std::size_t> not_needed;
    std::vector<bool> is_told(touched_.size(), false);
    for (std::size_t i = 0; i < touched_.size(); ++i) {
      const JsonValue value = document_.value(i);
      const std::optional<JsonValue> parent = value.parent();
      is_told[i] = report_.marks().is_dropped(value) || (parent && is_told[parent->index()]);
      if (is_told[i] || touched_[i] || !is_element(value)) continue;
      is_told[i] = true;
      if (is_container(value) && value.size() == 0) {
        report_.marks().drop(value, "is empty");
      } else if (report_.marks().is_known(value) || report_.marks().is_known(*parent)) {
        ++not_needed[parent->kind() == JsonKind::Array ? "of '" + shortened(parent->key()) + "' unused"
                                                       : "'" + shortened(value.key()) + "'"];
        report_.marks().drop(value, kNotNeeded);
      } else {
        report_.drop(Severity::Warning, "property '" + shortened(value.key()) + "'", value,
                     "is not read here: dropped", "check its spelling and where it stands");
      }
    }
    std::string list;
    for (const auto& [what, count] : not_needed)
      list += (list.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
    if (!list.empty())
      report_.mention(Severity::Note, "file", std::string{kNotNeeded} + " and dropped: " + list, "");
  }

  void give_account(Account& account) const {
    std::vector<const std::string*> why(touched_.size(), nullptr);  // it was dropped
    for (std::size_t i = 0; i < touched_.size(); ++i) {
      const JsonValue value = document_.value(i);
      const Marks& marks = report_.marks();
      if (const std::optional<JsonValue> parent = value.parent()) why[i] = why[parent->index()];
      if (why[i] == nullptr && marks.is_dropped(value)) why[i] = &marks.why(value);
      if (!is_element(value)) continue;
      const bool is_converted = why[i] == nullptr && !marks.why(value).empty();
      account.push_back({.fate = why[i] != nullptr ? Fate::Dropped
                                 : is_converted    ? Fate::Converted
                                                   : Fate::Read,
                         .place = report_.place(value),
                         .subject = subject_of(value),
                         .item = value.pointer(),
                         .why = why[i] != nullptr ? *why[i] : marks.why(value)});
    }
    for (const AccountEntry& entry : report_.supplied()) account.push_back(entry);
  }

 private:
  const Document& document_;
  Report& report_;
  std::vector<bool> touched_;  // read, or holds something that was
};

}  // namespace

void settle(const Document& document, Account* account) {
  Settlement settlement{document};
  settlement.tell_overlooked();
  if (account != nullptr) settlement.give_account(*account);
}

}  // namespace pantin::gltf
