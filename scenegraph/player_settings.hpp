#pragma once
// How a clip is played: when, how fast, how much of it, on which nodes, and on top of what.
#include <compare>
#include <cstdint>
#include <optional>

#include <pantin/scenegraph/curve.hpp>
#include <pantin/scenegraph/scene.hpp>

namespace pantin {

/// Names one play of a Player; null by default, never used again after the play was stopped.
struct PlayId {
  std::uint32_t number{0};

  explicit operator bool() const noexcept { return number != 0; }
  friend auto operator<=>(const PlayId&, const PlayId&) = default;
};

enum class Loop { Once, Repeat };

enum class Blend {
  Override,  ///< in place of what is below, by its weight
  Additive,  ///< on top of what is below: the difference from the clip's own pose at `reference`
};

/// How much of each channel is played; 1 = all, 0 = not at all.
struct ChannelWeights {
  double translation{1};  ///< 0 .. 1; Additive: any finite number
  double rotation{1};     ///< as above
  double scale{1};        ///< as above
  double link_value{1};   ///< as above
};

/// How much a node and all below it take part.
struct SubtreeWeight {
  NodeId top{};
  double weight{1};  ///< 0 .. 1
};

/// A node's motion that is handed to one of its ancestors: a character goes along instead of its hips running
/// away from it. What is extracted of the source's motion M_PN, P its parent, is the rigid motion D that
/// `along` and `turn_about` leave: the translation along some axes of P, and the turn about one axis. D
/// counts from the clip's start, goes on through loops, is taken out of the source's pose (M_PN becomes
/// inverse(D) M_PN) and is applied to the carrier: M_PC(t) = M_PC(t0) K inverse(D(t0)) D(t) inverse(K), K =
/// the source's parent seen from the carrier, as it was when the play began. The product of both moves as the
/// clip says.
struct RootMotion {
  NodeId source{};                              ///< node with a Translation or Rotation track of the clip
  NodeId carrier{};                             ///< an ancestor of the source that this clip does not animate
  std::array<bool, 3> along{true, true, true};  ///< which of x, y, z of P are extracted
  std::optional<Vector3> turn_about{};          ///< unit axis in P whose turn is extracted; none = no turn
};

struct PlayerSettings {
  double begin{0};   ///< play time at which the clip stands at `offset` [s]
  double offset{0};  ///< clip time at `begin` [s], within the clip
  double speed{1};   ///< clip seconds per play second, may be negative or 0
  Loop loop{Loop::Repeat};
  /// Play time -> warped play time, both [s], never running back: clip time = offset + speed (warp(t) -
  /// begin). Goes on straight outside its keys. None = no warp.
  std::optional<Curve> warp{};
  Curve weight{1.0};  ///< of play time [s]; values 0 .. 1, Additive: any finite number
  Blend blend{Blend::Override};
  int layer{0};         ///< higher layers lie on top
  double reference{0};  ///< clip time whose pose adds nothing [s], within the clip; for Additive
  ChannelWeights channels{};
  /// Which nodes take part: each node goes by the entry nearest at or above it, and takes no part if there is
  /// none. Looked up once, when the play begins. Empty = all nodes.
  std::vector<SubtreeWeight> mask{};
  std::optional<RootMotion> root{};  ///< Override only
};

/// What is wrong with settings for this clip (not finite, offset outside it, ...); empty if nothing is.
[[nodiscard]] std::string problem_with(const PlayerSettings& settings, const Clip& clip);

}  // namespace pantin
