#pragma once
// How the links of a scene are called in text: by their own name where no other link of the scene has it,
// else by the path of the node that they move.
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <pantin/scenegraph/scene.hpp>

namespace pantin {

/// The keys of all links that the scene has at construction.
class LinkKeys {
 public:
  explicit LinkKeys(const Scene& scene);

  /// The key of the link at a node; the node's path if it had none at construction.
  [[nodiscard]] std::string key(NodeId id) const;
  /// The same where the node's path is known; a path costs most of it.
  [[nodiscard]] std::string key(NodeId id, const std::string& path) const;
  /// The node whose link has this key, or whose path this is; null if there is none. A path need not be a
  /// link's.
  [[nodiscard]] NodeId find(std::string_view key) const;
  /// All keys, in the scene's order.
  [[nodiscard]] std::vector<std::string> all() const;

 private:
  [[nodiscard]] bool has_own_name(NodeId id) const;

  const Scene* scene_;
  std::vector<NodeId> linked_{};
  std::unordered_map<std::string, NodeId> by_name_{};  ///< unique names only
};

}  // namespace pantin
