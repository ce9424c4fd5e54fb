#include <pantin/scenegraph/sibling_numbers.hpp>

#include <string_view>

namespace pantin {

std::optional<std::size_t> SiblingNumbers::of(std::uint32_t at, const SceneStorage& nodes,
                                              const std::vector<std::string>& names) {
  const std::uint32_t parent = nodes.parent(at);
  if (counted_.insert(parent).second) count_children(parent, nodes, names);
  const auto number = numbers_.find(at);
  return number == numbers_.end() ? std::nullopt : std::optional{number->second};
}

void SiblingNumbers::clear() {
  counted_.clear();
  numbers_.clear();
}

void SiblingNumbers::count_children(std::uint32_t parent, const SceneStorage& nodes,
                                    const std::vector<std::string>& names) {
  struct Name {
    std::uint32_t first{0};
    std::size_t count{0};
  };
  std::unordered_map<std::string_view, Name> seen;
  nodes.for_each_child(parent, [&](std::uint32_t child) {
    const auto [entry, is_new] = seen.try_emplace(names[nodes.order()[child].index], Name{child, 0});
    const std::size_t number = entry->second.count++;
    if (number == 1) numbers_.try_emplace(entry->second.first, 0);
    if (number > 0 || entry->first.empty()) numbers_.try_emplace(child, number);
    return true;
  });
}

}  // namespace pantin
