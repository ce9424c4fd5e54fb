#pragma once
// Private to bridge. The motion of an animated node as physics wants it: the product of the local motions
// along its ancestors, from the scene root or from the nearest simulated ancestor's body, made rigid.
#include <optional>
#include <vector>

#include <pantin/bridge/offset.hpp>
#include <pantin/physics/driver.hpp>
#include <pantin/scenegraph/player.hpp>

namespace pantin {

/// One factor of the product: a node, or a run of nodes that do not move.
struct ChainPart {
  const Player* player{nullptr};  ///< null: `rest` stands for it
  NodeId node{};                  ///< what `player` animates
  LocalMotion rest{};             ///< constant local matrix
  const Offset* blend{nullptr};   ///< leads the node back to its clip; null = none
};

/// M_FN(t) of a node N in frame F, the world or the body of an ancestor, and the rigid motion of its body. A
/// pure function of time between two calls of those who own what it points to.
class NodeMotion {
 public:
  /// Parts from F down to N; `M_FA` is what the first one's parent has in F.
  void set_chain(const Affine& M_FA, std::vector<ChainPart> parts);
  /// The user has moved the node: leads from where its body was to the chain's motion.
  void set_move(std::optional<Offset> move) { move_ = std::move(move); }

  /// M_FN, blends included, the user's move not.
  [[nodiscard]] LocalMotion affine(double t, Side side) const { return affine(t, side, parts_.size()); }
  /// The same of the node's parent.
  [[nodiscard]] LocalMotion parent(double t, Side side) const { return affine(t, side, parts_.size() - 1); }
  /// The node's rigid motion and residual, everything included.
  [[nodiscard]] SplitMotion split_at(double t, Side side) const;
  /// The last part's motion seen from the rigid frame of its parent, without the last part's blend.
  [[nodiscard]] SplitMotion in_parent(double t, Side side) const;
  [[nodiscard]] double next_break(double t) const;

  /// Whether a player or a blend moves it.
  [[nodiscard]] bool is_played() const noexcept;
  /// Whether a player of the chain begins at this very time, so that there is no motion before.
  [[nodiscard]] bool begins_at(double t) const noexcept;

 private:
  [[nodiscard]] LocalMotion affine(double t, Side side, std::size_t parts) const;

  LocalMotion base_{};
  std::vector<ChainPart> parts_{};
  std::optional<SplitMotion> still_{};  ///< of a chain that does not move
  std::optional<Offset> move_{};
};

/// What physics owns: a view of a NodeMotion, which must outlive it.
class NodeDriver final : public Driver {
 public:
  explicit NodeDriver(const NodeMotion& motion) : motion_{&motion} {}
  [[nodiscard]] RigidMotion motion(double t, Side side) const override;
  [[nodiscard]] double next_break(double t) const override { return motion_->next_break(t); }

 private:
  const NodeMotion* motion_;
};

}  // namespace pantin
