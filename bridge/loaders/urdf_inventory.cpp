#include <pantin/bridge/loaders/urdf_inventory.hpp>

#include <tinyxml2.h>

#include <cstdint>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include <pantin/bridge/loaders/urdf_document.hpp>
#include <pantin/bridge/loaders/urdf_numbers.hpp>

namespace pantin::urdf_loader {
namespace {

using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

/// Next node in document order, below or after `node`.
const XMLNode* next_in_order(const XMLNode* node) {
  if (const XMLNode* child = node->FirstChild()) return child;
  for (; node != nullptr; node = node->Parent()) {
    if (const XMLNode* sibling = node->NextSibling()) return sibling;
  }
  return nullptr;
}

/// Names of a hostile file may be megabytes long, and come up in many entries.
std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 100;
  return text.size() > kMost ? text.substr(0, kMost) + "..." : text;
}

/// Whether both say the same, be it in other digits.
bool same_value(const std::string& a, const std::string& b) {
  if (a == b) return true;
  std::istringstream words_a{a}, words_b{b};
  std::string word_a, word_b;
  while (true) {
    const bool more_a = static_cast<bool>(words_a >> word_a), more_b = static_cast<bool>(words_b >> word_b);
    if (more_a != more_b) return false;
    if (!more_a) return true;
    const std::optional<double> x = parse_number(word_a), y = parse_number(word_b);
    if (word_a != word_b && !(x && y && *x == *y)) return false;
  }
}

}  // namespace

std::size_t number_of(const XMLElement& element) {
  return static_cast<std::size_t>(reinterpret_cast<std::uintptr_t>(element.GetUserData()));
}

void drop(XMLElement& element, std::string why, Ledger& ledger) {
  ledger.lose({number_of(element), {}, std::move(why)});
  element.GetDocument()->DeleteNode(&element);
}

void drop_attribute(XMLElement& element, const std::string& name, std::string why, Ledger& ledger) {
  ledger.lose({number_of(element), name, std::move(why)});
  element.DeleteAttribute(name.c_str());
}

Inventory::Inventory(tinyxml2::XMLDocument& document) : items_(1) {
  std::map<std::pair<std::size_t, std::string>, std::size_t> alike;  // siblings of a tag so far
  for (const XMLNode* node = document.FirstChild(); node != nullptr; node = next_in_order(node)) {
    const XMLElement* element = node->ToElement();
    if (element == nullptr && node->ToText() == nullptr) continue;
    const XMLElement* above = node->Parent()->ToElement();
    Item item{.parent = above != nullptr ? number_of(*above) : 0, .line = node->GetLineNum()};
    const bool is_part = items_[item.parent].parent == 0;  // a link, a joint, or the robot
    item.is_text = element == nullptr;
    item.segment = item.is_text ? "text()" : shortened(element->Name());
    if (is_part) {
      item.subject = shortened(item.is_text ? "text" : urdf_loader::subject_of(*element));
    } else if (const std::size_t before = alike[{item.parent, item.segment}]++; before > 0) {
      item.segment += '[' + std::to_string(before) + ']';
    }
    if (element != nullptr) {
      const_cast<XMLElement*>(element)->SetUserData(
          reinterpret_cast<void*>(static_cast<std::uintptr_t>(items_.size())));
      for (const tinyxml2::XMLAttribute* a = element->FirstAttribute(); a != nullptr; a = a->Next())
        item.attributes.push_back({a->Name(), a->Value(), a->GetLineNum()});
    }
    items_.push_back(std::move(item));
  }
}

const std::string& Inventory::subject_of(std::size_t number) const {
  while (items_[number].subject.empty() && number != 0) number = items_[number].parent;
  return items_[number].subject;
}

std::string Inventory::path_of(std::size_t number) const {
  std::string path = items_[number].segment;
  for (std::size_t i = items_[number].parent; items_[number].subject.empty() && i != 0;
       i = items_[i].parent) {
    path.insert(0, items_[i].segment + '/');
    if (!items_[i].subject.empty()) break;
  }
  return path;
}

/// One settling: what is left, what was told, and where the entries go.
class Inventory::Settlement {
 public:
  Settlement(const Inventory& inventory, const tinyxml2::XMLDocument& left, Ledger& ledger, Account* account)
      : inventory_{inventory},
        items_{inventory.items_},
        ledger_{ledger},
        account_{account},
        left_(items_.size()),
        why_(items_.size()) {
    for (const XMLNode* node = left.FirstChild(); node != nullptr; node = next_in_order(node)) {
      if (const XMLElement* element = node->ToElement()) left_[number_of(*element)] = element;
    }
    for (const Ledger::Loss& loss : ledger.losses())
      losses_.emplace(std::pair{loss.element, loss.attribute}, &loss.why);
    for (const Ledger::Supplied& supplied : ledger.supplied()) supplied_.emplace(supplied.element, &supplied);
  }

  void settle() {
    for (std::size_t i = 1; i < items_.size(); ++i) {
      const Item& item = items_[i];
      why_[i] = why_lost(i);
      tell(why_[i] != nullptr ? Fate::Dropped : Fate::Read, i, item.line, "",
           why_[i] != nullptr ? *why_[i] : "");
      for (const Attribute& attribute : item.attributes) settle(i, attribute);
      if (why_[i] == nullptr) tell_supplied(i);
    }
  }

 private:
  /// Null where the element is in the model.
  const std::string* why_lost(std::size_t i) {
    static const std::string kText = "text between the elements means nothing";
    if (const std::string* above = why_[items_[i].parent]) return above;
    if (items_[i].is_text) return &kText;
    if (const auto told = losses_.find({i, {}}); told != losses_.end()) return told->second;
    return left_[i] != nullptr ? nullptr : &untold(i, "<" + inventory_.path_of(i) + ">");
  }

  void settle(std::size_t i, const Attribute& attribute) {
    const std::string* why = why_[i];
    if (const auto told = losses_.find({i, attribute.name}); why == nullptr && told != losses_.end())
      why = told->second;
    const char* now = why == nullptr ? left_[i]->Attribute(attribute.name.c_str()) : nullptr;
    if (why == nullptr && now == nullptr) why = &untold(i, "attribute '" + attribute.name + '\'');
    if (why != nullptr) return tell(Fate::Dropped, i, attribute.line, '@' + attribute.name, *why);
    if (same_value(attribute.value, now)) return tell(Fate::Read, i, attribute.line, '@' + attribute.name);
    tell(Fate::Converted, i, attribute.line, '@' + attribute.name, "to '" + std::string{now} + '\'');
  }

  /// What was put into the copy, or is taken where the file says nothing.
  void tell_supplied(std::size_t i) {
    const Item& item = items_[i];
    const auto tell_new = [&](const XMLElement& element, const std::string& path) {
      for (const tinyxml2::XMLAttribute* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
        bool is_old = losses_.contains({i, a->Name()});  // urdfdom wants it, and nobody reads it
        for (const Attribute& old : item.attributes) is_old = is_old || old.name == a->Name();
        if (!is_old || number_of(element) == 0)
          tell(Fate::Defaulted, i, item.line, path + '@' + a->Name(),
               '\'' + std::string{a->Value()} + "' is used");
      }
    };
    tell_new(*left_[i], "");
    for (const XMLElement* e = left_[i]->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      if (number_of(*e) == 0) tell_new(*e, std::string{"/"} + e->Name());
    }
    const auto [first, last] = supplied_.equal_range(i);
    for (auto at = first; at != last; ++at)
      tell(Fate::Defaulted, i, item.line, at->second->item, at->second->why);
  }

  const std::string& untold(std::size_t i, const std::string& what) {
    static const std::string kLeftOut = "left out on reading";
    ledger_.warning(
        {items_[i].line, inventory_.subject_of(i), what + " is dropped", "check whether it matters"});
    return kLeftOut;
  }

  void tell(Fate fate, std::size_t i, int line, const std::string& suffix, std::string why = "") {
    if (account_ == nullptr) return;
    account_->push_back({.fate = fate,
                         .place = ledger_.place(line),
                         .subject = inventory_.subject_of(i),
                         .item = inventory_.path_of(i) + suffix,
                         .why = std::move(why)});
  }

  const Inventory& inventory_;
  const std::vector<Item>& items_;
  Ledger& ledger_;
  Account* account_;
  std::vector<const XMLElement*> left_;  ///< by number; null = gone
  std::vector<const std::string*> why_;  ///< by number; null = in the model
  std::map<std::pair<std::size_t, std::string>, const std::string*> losses_{};
  std::multimap<std::size_t, const Ledger::Supplied*> supplied_{};
};

void Inventory::settle(const tinyxml2::XMLDocument& left, Ledger& ledger, Account* account) const {
  Settlement{*this, left, ledger, account}.settle();
}

}  // namespace pantin::urdf_loader
