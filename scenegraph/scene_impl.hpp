#pragma once
// Private to scenegraph. What a Scene owns.
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include <pantin/scenegraph/dirty_set.hpp>
#include <pantin/scenegraph/scene.hpp>
#include <pantin/scenegraph/scene_storage.hpp>
#include <pantin/scenegraph/sibling_numbers.hpp>
#include <pantin/scenegraph/sweep.hpp>

namespace pantin {

struct Scene::Impl {
  static constexpr std::uint32_t kNone = SceneStorage::kNone;

  SweepKernel kernel{};
  SceneStorage nodes{};
  DirtySet dirty{};
  std::vector<std::string> names{std::string{}};    ///< by index of the id
  std::unordered_map<std::uint32_t, Link> links{};  ///< by index of the id; few nodes have one
  std::vector<IndexRange> changed{};
  std::size_t pending{0};  ///< edits since the last update; 0: nothing to do
  bool all_changed{
      false};  ///< positions or worlds were touched between updates: the next one reports everything
  std::size_t climbed{0};  ///< steps that edits climbed through dirty ancestors since the last sweep
  std::vector<std::uint32_t> scratch{};  ///< positions, reused by members that write

  std::uint64_t shape{0};          ///< counts changes of names, and of who hangs where and lies where
  mutable std::mutex numbering{};  ///< const reads may come from several threads, and these write
  mutable SiblingNumbers numbers{};
  mutable std::uint64_t numbered_shape{0};

  /// Position of a node; that it is alive is a contract.
  [[nodiscard]] std::uint32_t at(NodeId id) const {
    if (!nodes.contains(id)) reject(id);
    return nodes.position(id);
  }
  void reject(NodeId id) const;  ///< breaks the contract, in words
  [[nodiscard]] NodeId id(std::uint32_t at) const { return nodes.order()[at]; }
  [[nodiscard]] const std::string& name(std::uint32_t at) const { return names[id(at).index]; }
  [[nodiscard]] std::string path(std::uint32_t at) const;
  /// The path in quotes, or "the root": for messages.
  [[nodiscard]] std::string called(std::uint32_t at) const;
  /// How far up a node's world matrix is out of date.
  struct Climb {
    std::size_t steps{0};  ///< ancestors looked at, itself included
    std::size_t stale{0};  ///< steps up to and including the topmost dirty one; 0 if the world is up to date
  };
  [[nodiscard]] Climb climb(std::uint32_t at) const;
  /// M_WN of the node `at`, given its climb.
  [[nodiscard]] Matrix34 read_through(std::uint32_t at, std::size_t stale) const;

  void mark(std::uint32_t at) {
    dirty.grow(nodes.end());
    if (dirty.mark(at)) ++pending;
  }
  void set_local(std::uint32_t at, const Matrix34& M_PN);
  void set_local(std::uint32_t at, const Affine& M_PN) { set_local(at, Matrix34::from(M_PN)); }
  void compact();
  /// Keeps memory and walks linear under endless creating and removing without updates.
  void compact_if_mostly_holes();
  /// For edits that read worlds: reads through, but sweeps once the climbing would cost more than that.
  [[nodiscard]] Matrix34 world_for_edit(std::uint32_t at);
  void sweep_dirty();
  void compute_worlds();  ///< of what `changed` lists
  [[nodiscard]] bool was_swept(std::uint32_t at) const;
};

}  // namespace pantin
