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
  return has_own_name(id) ? scene_->link(id)->name : scene_->path(id);
}

std::string LinkKeys::key(NodeId id, const std::string& path) const {
  return has_own_name(id) ? scene_->link(id)->name : path;
}

bool LinkKeys::has_own_name(NodeId id) const {
  const Link* link = scene_->link(id);
  if (link == nullptr) return false;
  const auto entry = by_name_.find(link->name);
  return entry != by_name_.end() && entry->second == id;
}

NodeId LinkKeys::find(std::string_view key) const {
  const auto entry = by_name_.find(std::string{key});
  return entry != by_name_.end() ? entry->second : scene_->find(key);
}

std::vector<std::string> LinkKeys::all() const {
  std::vector<std::string> keys;
  keys.reserve(linked_.size());
  const std::vector<std::string> paths = scene_->paths(linked_);
  for (std::size_t i = 0; i < linked_.size(); ++i) keys.push_back(key(linked_[i], paths[i]));
  return keys;
}

}  // namespace pantin
