#pragma once
// Private to scenegraph. The dense arrays behind a Scene, their tables of ids, and the shape of the tree.
//
// A position is an index into the arrays. Parents always have lower positions than their children. The arrays
// are a sequence of runs; each run is in depth-first order, so a subtree is the contiguous range [position,
// position + extent) of its run. The first run holds the root; every later one, a tail, holds one subtree
// whose parent lies in an earlier run. New nodes extend the last run if their parent is on its rightmost path
// (so a scene built depth-first is one run), else they open a tail; a moved subtree is copied to the end,
// together with the tails below it. Positions that a removed or moved subtree leaves are holes: their id is
// null, and the size of the first one says how many to skip. The children of a node are those in its own run,
// then the tails hung under it, which is also their order, because children are only ever added as last ones.
//
// Nodes on the rightmost path of the last run are open: their size is stored as 0 and reaches to the end. So
// adding a node need not touch all its ancestors; a node is closed once, when the path leaves it.
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <pantin/scenegraph/affine.hpp>
#include <pantin/scenegraph/node_id.hpp>
#include <pantin/scenegraph/scene_memory.hpp>

namespace pantin {

class SceneStorage {
 public:
  static constexpr std::uint32_t kNone = 0xffff'ffff;

  SceneStorage();  ///< with a root at position 0

  /// Adds a node as last child of the one at `parent`; its world is the identity until swept.
  NodeId append(std::uint32_t parent, const Matrix34& local);
  /// Turns `positions`, which `collect(top)` gave, into holes and frees their ids.
  void remove(std::uint32_t top, std::span<const std::uint32_t> positions);
  /// Copies `positions`, which `collect(top)` gave, to the end as last child of `parent`, leaving holes;
  /// where `top` is now. `parent` is not among them.
  std::uint32_t relocate(std::uint32_t top, std::span<const std::uint32_t> positions, std::uint32_t parent);
  /// Rebuilds all arrays as one run without holes, with little room to spare. Entry i of the result is where
  /// the node now at i was before.
  std::vector<std::uint32_t> compact();

  [[nodiscard]] bool contains(NodeId id) const noexcept {
    return (id.generation & 1) != 0 && id.index < slots_.size() &&
           slots_[id.index].generation == id.generation;
  }
  /// Position of a node that is alive.
  [[nodiscard]] std::uint32_t position(NodeId id) const noexcept { return slots_[id.index].position; }

  [[nodiscard]] std::uint32_t end() const noexcept { return static_cast<std::uint32_t>(parent_.size()); }
  [[nodiscard]] std::size_t holes() const noexcept { return holes_; }
  [[nodiscard]] std::size_t alive() const noexcept { return parent_.size() - holes_; }
  /// Makes room for so many nodes in all.
  void reserve(std::size_t nodes);
  /// Adds what its arrays and tables hold.
  void add_bytes(SceneMemory& memory) const noexcept;

  [[nodiscard]] std::uint32_t parent(std::uint32_t at) const noexcept {
    return parent_[at];
  }  ///< kNone for the root
  [[nodiscard]] std::uint32_t extent(std::uint32_t at) const noexcept {
    return size_[at] == kOpen ? end() - at : size_[at];
  }
  [[nodiscard]] bool is_hole(std::uint32_t at) const noexcept { return !order_[at]; }
  [[nodiscard]] const std::vector<NodeId>& order() const noexcept { return order_; }
  [[nodiscard]] const std::vector<std::uint32_t>& parents() const noexcept { return parent_; }
  [[nodiscard]] const std::vector<Matrix34>& locals() const noexcept { return local_; }
  [[nodiscard]] std::vector<Matrix34>& locals() noexcept { return local_; }
  [[nodiscard]] const std::vector<Matrix34>& worlds() const noexcept { return world_; }
  [[nodiscard]] std::vector<Matrix34>& worlds() noexcept { return world_; }

  /// Where the k-th tail begins, k < tails(); ascending. It may be a hole.
  [[nodiscard]] std::uint32_t tail(std::size_t k) const noexcept { return tails_[k].top; }
  [[nodiscard]] std::size_t tails() const noexcept { return tails_.size(); }

  /// Appends the positions of the subtree at `top` to `out`, depth-first, children in order, without holes.
  void collect(std::uint32_t top, std::vector<std::uint32_t>& out) const;
  /// Whether `ancestor` is `at` or above it; O(1) within a run, O(log tails) for each run in between.
  [[nodiscard]] bool is_above(std::uint32_t ancestor, std::uint32_t at) const noexcept;

  /// Calls visit(position) for the children in order, until it returns false.
  template <class Visit>
  void for_each_child(std::uint32_t at, Visit visit) const {
    const std::uint32_t last = at + extent(at);
    for (std::uint32_t child = at + 1; child < last; child += extent(child))
      if (!is_hole(child) && !visit(child)) return;
    for (std::uint32_t k = first_tail(at); k != kNone; k = tails_[k].next)
      if (!is_hole(tails_[k].top) && !visit(tails_[k].top)) return;
  }

 private:
  static constexpr std::uint32_t kOpen = 0;
  static constexpr std::size_t kNodesPerSpare = 64;  ///< compacting leaves room for one more node for so many

  /// Entry of the id table. The generation is odd while the slot is in use; `position` of a free slot is the
  /// next free one.
  struct Slot {
    std::uint32_t position{kNone};
    std::uint32_t generation{0};
  };
  struct Tail {
    std::uint32_t top{0};
    std::uint32_t next{kNone};  ///< index of the next tail hung under the same parent
  };
  struct TailList {
    std::uint32_t first{kNone};
    std::uint32_t last{kNone};
  };

  std::uint32_t push(std::uint32_t parent, NodeId id, const Matrix34& local, const Matrix34& world);
  void close_down_to(std::uint32_t kept) noexcept;
  void hang_tail(std::uint32_t top, std::uint32_t parent);
  void vacate(std::uint32_t top, std::span<const std::uint32_t> positions);
  [[nodiscard]] std::uint32_t first_tail(std::uint32_t at) const;
  [[nodiscard]] std::uint32_t run_top(std::uint32_t at) const noexcept;
  NodeId take_slot();
  void free_slot(NodeId id) noexcept;

  std::vector<std::uint32_t> parent_{};
  std::vector<std::uint32_t> size_{};  ///< of the subtree within its run, holes included; kOpen: to the end
  std::vector<Matrix34> local_{};
  std::vector<Matrix34> world_{};
  std::vector<NodeId> order_{};
  std::vector<Slot> slots_{};
  std::uint32_t free_slot_{kNone};
  std::uint32_t last_open_{kNone};  ///< end of the rightmost path of the last run; kNone if it is gone
  std::size_t holes_{0};
  std::vector<Tail> tails_{};
  std::unordered_map<std::uint32_t, TailList> tail_lists_{};  ///< by position of the parent
};

}  // namespace pantin
