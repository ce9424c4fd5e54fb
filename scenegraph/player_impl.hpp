#pragma once
// Private to scenegraph. What a Player consists of.
#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include <pantin/scenegraph/motion.hpp>
#include <pantin/scenegraph/play_clock.hpp>
#include <pantin/scenegraph/root_extraction.hpp>

namespace pantin {

constexpr std::size_t kChannels = 4;

/// A clip that is being played.
struct Play {
  Play(PlayId its_id, SharedClip its_clip, PlayerSettings its_settings)
      : id{its_id},
        clip{std::move(its_clip)},
        settings{std::move(its_settings)},
        clock{settings, clip.clip().duration} {}

  PlayId id;
  SharedClip clip;
  PlayerSettings settings;
  PlayClock clock;
  std::optional<RootExtraction> root{};
  bool is_new{true};     ///< nothing has been advanced since it began, or since the time was set
  ClockReading now{};    ///< at the player's time, while it is being applied
  double weight_now{1};  ///< as above
};

/// What a play stands at.
template <class S>
struct PlayReading {
  ClockReading clock{};
  S weight{};
};

/// How a play is blended into a node, where it does not simply have all of it.
struct PartBlend {
  std::array<double, kChannels> share{};  ///< channel weight x mask
  NodePose<double> reference{};           ///< of an Additive play
};

/// What one play has to say about one node. Kept small: a crowd is many of these.
struct NodePart {
  Play* play{nullptr};
  std::array<const PreparedTrack*, kChannels> tracks{};  ///< by channel, null where there is none
  std::array<KeyCursor, kChannels> cursors{};            ///< for apply
  std::unique_ptr<PartBlend> blend{};                    ///< null for Override with all shares 1
  bool is_root_source{false};

  [[nodiscard]] double share(std::size_t channel) const { return blend ? blend->share[channel] : 1; }
};

/// One node and what animates it.
struct AnimatedNode {
  NodeId node{};
  bool is_held{false};
  std::vector<NodePart> parts{};       ///< by layer, then by age
  std::unique_ptr<const Link> link{};  ///< of a node with LinkValue tracks, as when the first play began
  std::unique_ptr<const NodePose<double>> rest{};  ///< for what no clip animates

  [[nodiscard]] int width(std::size_t channel) const;
};

/// A node that is moved by root motion.
struct Carrier {
  NodeId node{};
  Affine M_anchor{Affine::Identity()};  ///< its local matrix at `anchor`
  double anchor{0};                     ///< play time [s]
  std::vector<Play*> plays{};           ///< by age
  bool is_held{false};
};

/// How a contract names a node.
[[nodiscard]] std::string called(NodeId id);

struct Player::Impl {
  double time{0};
  std::uint32_t last_play{0};
  std::vector<std::unique_ptr<Play>> plays{};  ///< by age
  std::vector<AnimatedNode> animated{};
  std::vector<Carrier> carriers{};
  std::unordered_map<NodeId, std::size_t> by_node{};  ///< index into `animated`
  std::unordered_set<NodeId> held{};
  std::vector<PlayedEvent> events{};
  std::vector<NodeLocal> locals{};  ///< room for apply

  // Plays (player.cpp)
  [[nodiscard]] Play& at(PlayId id) const;
  [[nodiscard]] const AnimatedNode* find(NodeId id) const;
  [[nodiscard]] Carrier* carrier(NodeId id);  ///< nullptr if it is none
  void bind(const Scene& scene, Play& play, const std::vector<NodeId>& targets);
  void bind_carrier(const Scene& scene, Play& play);
  void set_rest(const Scene& scene, AnimatedNode& entry, Channel channel) const;
  void set_held(NodeId id, bool is_held);
  void drop_unused();
  /// Carriers go on from where they are, whatever changes now.
  void settle_carriers();

  /// `problem_with` for a clip whose keys have no problem (player_problems.cpp).
  [[nodiscard]] std::string problem_with_play(const Scene& scene, const Clip& clip,
                                              const std::vector<NodeId>& targets,
                                              const PlayerSettings& settings);

  // Poses (player_pose.cpp)
  [[nodiscard]] NodePose<Jet> pose(const AnimatedNode& node, double time, const BlendSide& side) const;
  [[nodiscard]] LocalMotion motion(const AnimatedNode& node, double time, KeySide side) const;
  void read_now();
  void apply(AnimatedNode& node, Scene& scene);

  // Root motion (player_root.cpp)
  [[nodiscard]] LocalMotion motion(const Carrier& carrier, double time, KeySide side) const;
  void move_carriers(double to);

  // Breaks (player_breaks.cpp)
  [[nodiscard]] double next_break(const AnimatedNode& node, double time) const;
  [[nodiscard]] double next_break(const Carrier& carrier, double time) const;

  // Events (player_time.cpp)
  void pass_events(double before, double after);
};

/// The first play time > `time` at which one of these tracks, played by that clock, or the clock itself may
/// break; infinity if none.
[[nodiscard]] double next_clock_break(const PlayClock& clock, std::span<const PreparedTrack* const> tracks,
                                      double time);

}  // namespace pantin
