#pragma once
// Plays a clip on nodes of a scene. Sampling is a pure function of time, so that others (physics drivers) may
// ask for any time without moving the player. A held node is never written: physics owns it.
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <pantin/scenegraph/clip.hpp>
#include <pantin/scenegraph/scene.hpp>

namespace pantin {

enum class Loop { Once, Repeat };

struct PlayerSettings {
  double begin{0};   ///< play time at which the clip stands at `offset` [s]
  double offset{0};  ///< clip time at `begin` [s], within the clip
  double speed{1};   ///< clip seconds per play second, may be negative or 0
  Loop loop{Loop::Repeat};
};

/// What is wrong with settings for this clip (not finite, offset outside it); empty if nothing is.
[[nodiscard]] std::string problem_with(const PlayerSettings& settings, const Clip& clip);

/// A local matrix M_PN and its time derivatives; the lower row is left out.
struct LocalMotion {
  Eigen::Matrix<double, 3, 4> value{Eigen::Matrix<double, 3, 4>::Identity()};
  Eigen::Matrix<double, 3, 4> first{Eigen::Matrix<double, 3, 4>::Zero()};   ///< [1/s]
  Eigen::Matrix<double, 3, 4> second{Eigen::Matrix<double, 3, 4>::Zero()};  ///< [1/s^2]
};

/// Binds the targets of a clip to nodes. What a clip does not animate of a node (its scale, say) is taken
/// from the node's local matrix at construction, which must be a product translation * rotation * scale for a
/// node with a Translation, Rotation or Scale track, and must carry a link for one with a LinkValue track.
/// That product is not unique where scales are negative: it is read as columns' lengths for the scale, with
/// the x scale negative if the matrix mirrors. A clip that animates the rotation of a node with other
/// negative scales must bring its scale along, as a track with one key.
class Player {
 public:
  /// targets[k] is the node of track target k; null entries are not played. problem_with says if the pieces
  /// fit.
  Player(const Scene& scene, Clip clip, std::vector<NodeId> targets, PlayerSettings settings = {});
  ~Player();
  Player(Player&&) noexcept;
  Player& operator=(Player&&) noexcept;

  [[nodiscard]] const Clip& clip() const noexcept;
  [[nodiscard]] const PlayerSettings& settings() const noexcept;
  [[nodiscard]] double time() const noexcept;  ///< play time of the last apply or set_time [s]
  void set_time(double time);
  void advance(double elapsed);  ///< [s], >= 0

  /// Writes the local matrices of all animated nodes that are alive and not held, for the present time, and
  /// the value of their links where those are animated.
  void apply(Scene& scene) const;

  [[nodiscard]] bool animates(NodeId id) const;
  [[nodiscard]] std::vector<NodeId> nodes() const;  ///< all animated nodes
  void hold(NodeId id);                             ///< apply skips this node from now on, animated or not
  void release(NodeId id);
  [[nodiscard]] bool holds(NodeId id) const;

  /// Local matrix of an animated node at any play time [s], with exact derivatives with respect to play time;
  /// at a break the limit from the side asked for. A time from `next_break` counts as exactly at the break.
  [[nodiscard]] LocalMotion motion(NodeId id, double time, KeySide side = KeySide::After) const;
  /// First play time > `time` at which the node's matrix or a derivative may jump (keys, loop seam); infinity
  /// if none.
  [[nodiscard]] double next_break(NodeId id, double time) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Why this clip cannot be played on these nodes (target without node, sheared local, missing link, ...);
/// empty if it can.
[[nodiscard]] std::string problem_with(const Scene& scene, const Clip& clip,
                                       const std::vector<NodeId>& targets);

}  // namespace pantin
