#include <pantin/bridge/writers/link_keys.hpp>

namespace pantin {

LinkKeys::LinkKeys(const Scene& scene) : scene_{&scene} {
  for (const NodeId id : scene.subtree(scene.root())) {
    const Link* link = scene.link(id);
    if (link == nullptr) continue;
    linked_.push_back(id);
    if (link->name.empty()) continue;
    const auto [entry, is_new] = by_name_.try_emplace(link->name, id);
    if (!is_new) entry->second = NodeId{};
  }
  std::erase_if(by_name_, [](const auto& entry) { return !entry.second; });
}

std::string LinkKeys::key(NodeId id) const {
  if (const Link* link = scene_->link(id)) {
    const auto entry = by_name_.find(link->name);
    if (entry != by_name_.end() && entry->second == id) return link->name;
  }
  return scene_->path(id);
}

NodeId LinkKeys::find(std::string_view key) const {
  const auto entry = by_name_.find(std::string{key});
  return entry != by_name_.end() ? entry->second : scene_->find(key);
}

std::vector<std::string> LinkKeys::all() const {
  std::vector<std::string> keys;
  keys.reserve(linked_.size());
  for (const NodeId id : linked_) keys.push_back(key(id));
  return keys;
}

}  // namespace pantin
