#pragma once
// The hierarchy: named nodes, each with a local matrix against its parent and a world matrix derived from it.
// Nothing else hangs in here except links; masses, shapes and meshes belong to others, who hold NodeIds.
//
// Storage: dense arrays, parents before children. A freshly built or compacted scene is one depth-first run,
// in which a subtree is a contiguous range; appended and moved subtrees are tail segments (each depth-first
// in itself) that `update` sweeps in order and compacts past a threshold. No function recurses over the tree.
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pantin/scenegraph/affine.hpp>
#include <pantin/scenegraph/index_range.hpp>
#include <pantin/scenegraph/instruction_set.hpp>
#include <pantin/scenegraph/link.hpp>
#include <pantin/scenegraph/node_id.hpp>
#include <pantin/scenegraph/scene_memory.hpp>

namespace pantin {

/// What a re-parented node keeps.
enum class Keep {
  Local,  ///< the local matrix: the node jumps with its new parent
  World,  ///< the world matrix: the local is recomputed, exact under scale, shear and mirror
};

struct NodeLocal {
  NodeId node{};
  Affine M_PN{Affine::Identity()};
};

/// Owns all nodes. One root exists from the start, has no parent, an empty name and an empty path; its local
/// matrix is its world matrix. Const members may be called from several threads at once. Every NodeId
/// argument must be alive, or the contract is broken. Ids are of this scene alone: those of another cannot be
/// told apart.
class Scene {
 public:
  Scene();
  /// A scene whose updates use these instructions, which must run here. Results have the same bits with all.
  explicit Scene(InstructionSet set);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  [[nodiscard]] NodeId root() const noexcept;
  [[nodiscard]] std::size_t size() const noexcept;                ///< nodes, the root included
  [[nodiscard]] bool contains(NodeId id) const noexcept;          ///< false for null and removed ids
  [[nodiscard]] InstructionSet instruction_set() const noexcept;  ///< in use; never Best
  [[nodiscard]] SceneMemory memory() const;                       ///< visits all names and links

  /// Makes room for so many nodes in all, so that creating them moves nothing.
  void reserve(std::size_t nodes);
  /// Adds a node as the last child of `parent`. `M_PN` must be finite.
  NodeId create(NodeId parent, std::string_view name, const Affine& M_PN = Affine::Identity());
  /// Removes the node and all below it, with their links. Not the root.
  void remove(NodeId id);
  /// Hangs `child` with all below it under `parent`, as last child. A cycle breaks the contract; so does
  /// Keep::World under a singular parent (its message names both nodes).
  void set_parent(NodeId child, NodeId parent, Keep keep);

  [[nodiscard]] NodeId parent(NodeId id) const;                   ///< null for the root
  [[nodiscard]] std::vector<NodeId> children(NodeId id) const;    ///< in order
  [[nodiscard]] std::vector<NodeId> subtree(NodeId id) const;     ///< itself first, parents before children
  [[nodiscard]] bool is_above(NodeId ancestor, NodeId id) const;  ///< true also for the node itself

  [[nodiscard]] const std::string& name(NodeId id) const;
  void rename(NodeId id, std::string_view name);

  /// Names joined by '/' from the child of the root; '~1' stands for '/' and '~0' for '~' inside a name;
  /// siblings of equal name, and empty names, get '[k]' (k-th of that name among its siblings, from 0). Where
  /// a name itself ends in such an index, '~2' stands for its '[': a node called "x[1]" is "x~21]", while
  /// "x[1]" is the second "x". Empty for the root.
  [[nodiscard]] std::string path(NodeId id) const;
  /// The paths of many nodes, in one pass. Siblings are counted once for each parent; `path` keeps the counts
  /// until a node is created, removed, renamed or moved.
  [[nodiscard]] std::vector<std::string> paths(std::span<const NodeId> ids) const;
  /// The node of that path, as `path` gives it ('[0]' may be left out); null if there is none; the root for
  /// "".
  [[nodiscard]] NodeId find(std::string_view path) const;

  [[nodiscard]] const Link* link(NodeId id) const;         ///< nullptr where there is none
  void set_link(NodeId id, Link link);                     ///< also sets the local matrix from link.value
  void clear_link(NodeId id);                              ///< the local matrix stays
  void set_link_value(NodeId id, const LinkValue& value);  ///< sets the local matrix; needs a link
  /// Stores a measured value without touching the local matrix: for writers that own the matrix.
  void note_link_value(NodeId id, const LinkValue& value);

  [[nodiscard]] Affine local(NodeId id) const;
  void set_local(NodeId id, const Affine& M_PN);  ///< finite
  /// Many at once; of several for one node the last counts.
  void set_locals(std::span<const NodeLocal> locals);
  /// The same without copies: M_PN of ids[k] is by rows in locals[k]; as many of either.
  void set_locals(std::span<const NodeId> ids, std::span<const Matrix34> locals);
  /// M_WN, never stale: reads through changed ancestors without writing, with the bits that `update` would
  /// give. O(1) if nothing changed before the node in `order()` since the last update, else O(depth).
  [[nodiscard]] Affine world(NodeId id) const;

  /// Brings `worlds()` up to date; about a nanosecond when nothing changed. Puts the nodes into depth-first
  /// order again once there are more holes than a quarter, or more tails than a 256th, of the positions (and
  /// 32 of each).
  void update();
  /// Puts the nodes into depth-first order now and gives back room to spare, but for one node in 64: at most
  /// 220 bytes a node for matrices, topology and ids. Worth calling once after loading.
  void compact();
  /// World matrices as of the last update, parents first. Here and in `order()` an entry of a removed node
  /// stays as a hole until the next re-ordering. Valid until the next create, reserve, remove, set_parent,
  /// compact or update.
  [[nodiscard]] std::span<const Matrix34> worlds() const noexcept;
  /// Local matrices as they are now, each where its node stands in `worlds()`, and valid as long.
  [[nodiscard]] std::span<const Matrix34> locals() const noexcept;
  /// Whose matrix each entry of `worlds()` is; null in a hole.
  [[nodiscard]] std::span<const NodeId> order() const noexcept;
  [[nodiscard]] std::size_t index_of(NodeId id) const;  ///< position in `order()` now
  /// What the last update swept, ascending; everything if it, or an edit before it, put the nodes into
  /// another order. Valid as long as `worlds()`.
  [[nodiscard]] std::span<const IndexRange> changed() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pantin
