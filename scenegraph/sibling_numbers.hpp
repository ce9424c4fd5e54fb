#pragma once
// Private to scenegraph. The [k] of equal and of empty siblings in paths: siblings are counted once for each
// parent that is asked about, and the counts kept as long as nothing is renamed or moved.
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <pantin/scenegraph/scene_storage.hpp>

namespace pantin {

class SiblingNumbers {
 public:
  /// Which of the siblings of its name the node at this position is; nothing where it is the only one and has
  /// a name.
  [[nodiscard]] std::optional<std::size_t> of(std::uint32_t at, const SceneStorage& nodes,
                                              const std::vector<std::string>& names);
  void clear();

 private:
  void count_children(std::uint32_t parent, const SceneStorage& nodes, const std::vector<std::string>& names);

  std::unordered_set<std::uint32_t> counted_{};               ///< parents, by position
  std::unordered_map<std::uint32_t, std::size_t> numbers_{};  ///< of the nodes that have one
};

}  // namespace pantin
