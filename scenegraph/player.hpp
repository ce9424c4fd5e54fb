#pragma once
// Plays clips on nodes of a scene: one or many at once, blended. Sampling is a pure function of time with
// exact derivatives, so that others (physics drivers) may ask for any time without moving the player. A held
// node is never written: physics owns it.
//
// The pose of a node, channel by channel, from its rest pose upwards, layer by layer. Within a layer first
// the Override plays, x_i with weights w_i (weight curve x channel weight x mask) and W = sum w_i:
//   numbers    x = (max(0, 1 - W) below + sum w_i x_i) / max(1, W)
//   rotations  q = p / |p|,  p = max(0, 1 - W) below + sum w_i (+-) q_i   on the sphere; signs: the half of
//   the
//              sphere of the layer's first play
// then its Additive ones, in the order in which they began, b against its reference r, in the node's own
// axes:
//   numbers    x + w (b - r)        scale   x (1 + w (b / r - 1))        rotations   q (r^-1 b)^w
// Values of links are numbers and rotations too (a ball's quaternion, the two parts of a free link).
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pantin/scenegraph/clip.hpp>
#include <pantin/scenegraph/player_settings.hpp>
#include <pantin/scenegraph/scene.hpp>

namespace pantin {

/// A local matrix M_PN and its time derivatives; the lower row is left out.
struct LocalMotion {
  Eigen::Matrix<double, 3, 4> value{Eigen::Matrix<double, 3, 4>::Identity()};
  Eigen::Matrix<double, 3, 4> first{Eigen::Matrix<double, 3, 4>::Zero()};   ///< [1/s]
  Eigen::Matrix<double, 3, 4> second{Eigen::Matrix<double, 3, 4>::Zero()};  ///< [1/s^2]
};

/// An event of a clip that an advance has passed.
struct PlayedEvent {
  PlayId play{};
  std::size_t index{0};  ///< in the clip's `events`
  double time{0};        ///< play time at which it was passed [s]
  double lap{0};         ///< which time round, a whole number; 0 for Once
  bool is_backwards{false};
  double weight{1};  ///< of the play, at that time
};

struct PreparedClip;

/// A clip that any number of plays share. Its keys must have no problem.
class SharedClip {
 public:
  SharedClip(Clip clip);  // NOLINT: a clip may stand wherever a shared one may
  [[nodiscard]] const Clip& clip() const noexcept;
  [[nodiscard]] const PreparedClip& prepared() const noexcept { return *prepared_; }

 private:
  std::shared_ptr<const PreparedClip> prepared_;
};

/// From one play to another: the weights go from 1 to 0 and from 0 to 1 by `fade`, their sum stays 1.
struct CrossFadeSettings {
  double begin{0};       ///< play time [s]
  double duration{0.3};  ///< [s], > 0
};

/// Binds the targets of clips to nodes. What no clip animates of a node (its scale, say) is taken from the
/// node's local matrix as it is when the first play on it begins: its rest pose. That matrix must be a
/// product translation * rotation * scale for a node with a Translation, Rotation or Scale track, and must
/// carry a link for one with a LinkValue track. The product is not unique where scales are negative: it is
/// read as columns' lengths for the scale, with the x scale negative if the matrix mirrors. A clip that
/// animates the rotation of a node with other negative scales must bring its scale along, as a track with one
/// key.
///
/// Several players may play on one scene, each on its own nodes. Const members may be called from several
/// threads at once.
class Player {
 public:
  Player();
  /// A player of one clip.
  Player(const Scene& scene, SharedClip clip, const std::vector<NodeId>& targets,
         PlayerSettings settings = {});
  ~Player();
  Player(Player&&) noexcept;
  Player& operator=(Player&&) noexcept;

  // Plays
  /// targets[k] is the node of track target k; null entries are not played. problem_with says if all fits.
  PlayId play(const Scene& scene, SharedClip clip, const std::vector<NodeId>& targets,
              PlayerSettings settings = {});
  void stop(PlayId id);  ///< nodes that nothing else plays on are no longer animated
  /// Takes the node out of all plays, which go on with their others; root motion of a source goes on too.
  void stop(NodeId node);
  void stop_removed(const Scene& scene);  ///< the same for all nodes that the scene does not have any more
  [[nodiscard]] bool is_playing(PlayId id) const;
  [[nodiscard]] std::vector<PlayId> plays() const;                ///< in the order in which they began
  [[nodiscard]] std::vector<PlayId> plays_of(NodeId node) const;  ///< from the lowest layer up
  [[nodiscard]] std::vector<NodeId> nodes_of(PlayId id) const;    ///< those it animates, carriers included
  [[nodiscard]] const Clip& clip(PlayId id) const;
  [[nodiscard]] const PlayerSettings& settings(PlayId id) const;
  void set_weight(PlayId id, Curve weight);
  /// Sets both weights; to be called with plays of one layer.
  void cross_fade(PlayId from, PlayId to, const CrossFadeSettings& settings);

  // Time
  [[nodiscard]] double time() const noexcept;  ///< present play time [s]
  /// A jump to another time: events are not passed, carriers of root motion stay where they are.
  void set_time(double time);
  void advance(double elapsed);  ///< [s], >= 0
  void advance_to(double time);  ///< [s], not before time()
  /// What the last advance passed, in order of time, then of plays: events whose play time is in (before,
  /// after], and those at `before` too if the play began, or the time was set, since the advance before.
  /// Every lap counts; at a seam the end of the lap comes before the start of the next. Backwards the same
  /// holds in reverse. A clip that stands passes nothing. Valid until the next advance, set_time, play or
  /// stop.
  [[nodiscard]] std::span<const PlayedEvent> events() const noexcept;

  // Writing
  /// Writes the local matrices of all animated nodes that are alive and not held, for the present time, and
  /// the value of their links where those are animated.
  void apply(Scene& scene);
  void hold(NodeId id);  ///< apply skips this node from now on, animated or not
  void release(NodeId id);
  [[nodiscard]] bool holds(NodeId id) const;

  // Sampling
  [[nodiscard]] bool animates(NodeId id) const;     ///< true also for carriers of root motion
  [[nodiscard]] std::vector<NodeId> nodes() const;  ///< all animated nodes, carriers last
  /// Local matrix of an animated node at any play time [s], with exact derivatives with respect to play time;
  /// at a break the limit from the side asked for. A time from `next_break` counts as exactly at the break.
  [[nodiscard]] LocalMotion motion(NodeId id, double time, KeySide side = KeySide::After) const;
  /// First play time > `time` at which the node's matrix or a derivative may jump: keys of clips, weights and
  /// warps, loop seams, and where rotations that are being blended come more than half a turn apart, so that
  /// the shorter way changes sides (looked for at 32 places before the next key; one that comes and goes
  /// between two of them is not seen). Infinity if none.
  [[nodiscard]] double next_break(NodeId id, double time) const;
  /// Whether a play on this node begins at this very time.
  [[nodiscard]] bool begins_at(NodeId id, double time) const;

  // Root motion. Where one play of weight 1 moves a carrier, its motion is exact at all times. Where several
  // do, or with other weights, each advance moves it by the weighted mean of their displacements, with the
  // weights at the middle of the advance (an error of third order in its length), and `motion` goes on from
  // the last advance in the same way.
  [[nodiscard]] bool is_carrier(NodeId id) const;
  /// How the root motion of a play moves between two play times, in axes of the source's parent.
  [[nodiscard]] Affine root_displacement(PlayId id, double from, double to) const;
  /// Puts a carrier elsewhere at the present time; it goes on from there.
  void place(NodeId carrier, const Affine& M_PN);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  friend std::string problem_with(const Player&, const Scene&, const Clip&, const std::vector<NodeId>&,
                                  const PlayerSettings&);
};

/// Why this clip cannot be played on these nodes (target without node, sheared local, missing link, ...);
/// empty if it can.
[[nodiscard]] std::string problem_with(const Scene& scene, const Clip& clip,
                                       const std::vector<NodeId>& targets);
/// The same, with these settings and beside what the player plays already.
[[nodiscard]] std::string problem_with(const Player& player, const Scene& scene, const Clip& clip,
                                       const std::vector<NodeId>& targets, const PlayerSettings& settings);
/// What is wrong with a clip by itself; empty if nothing is.
[[nodiscard]] std::string problem_with(const Clip& clip);

}  // namespace pantin
