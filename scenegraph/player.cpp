#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/motion.hpp>
#include <pantin/scenegraph/play_clock.hpp>

namespace pantin {
namespace {

constexpr std::size_t kChannels = 4;

/// One node and what animates it.
struct AnimatedNode {
  NodeId node{};
  Trs rest{};                                    ///< for the channels without track
  std::optional<Link> link{};                    ///< of a node with a LinkValue track, as at construction
  std::array<const Track*, kChannels> tracks{};  ///< by channel, null where there is none

  [[nodiscard]] const Track* track(Channel channel) const {
    return tracks[static_cast<std::size_t>(channel)];
  }
};

/// The key that `time` is meant to hit, if one is within `slack`, else `time`.
double snapped(const std::vector<double>& times, double time, double slack) {
  const auto key = std::lower_bound(times.begin(), times.end(), time - slack);
  return key != times.end() && *key <= time + slack ? *key : time;
}

TrackSample sample_at(const Track& track, const ClockReading& at) {
  return sample(track, snapped(track.times, at.clip_time, at.slack), at.side);
}

LocalMotion clip_motion(const AnimatedNode& animated, const ClockReading& at) {
  std::array<TrackSample, kChannels> samples;
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (animated.tracks[c]) samples[c] = sample_at(*animated.tracks[c], at);
  }
  const auto given = [&](Channel channel) {
    return animated.track(channel) ? &samples[static_cast<std::size_t>(channel)] : nullptr;
  };
  if (animated.link) return link_motion(*animated.link, *given(Channel::LinkValue));
  return trs_motion(animated.rest, {.translation = given(Channel::Translation),
                                    .rotation = given(Channel::Rotation),
                                    .scale = given(Channel::Scale)});
}

}  // namespace

struct Player::Impl {
  Impl(Clip given, const PlayerSettings& settings) : clip{std::move(given)}, clock{settings, clip.duration} {}

  Clip clip;
  PlayClock clock;
  double time{0};
  std::vector<AnimatedNode> animated{};
  std::unordered_map<NodeId, std::size_t> by_node{};  ///< index into `animated`
  std::unordered_set<NodeId> held{};

  void bind(const Scene& scene, const std::vector<NodeId>& targets);
  [[nodiscard]] const AnimatedNode& at(NodeId id) const;
  [[nodiscard]] LocalMotion motion(const AnimatedNode& node, double play_time, KeySide side) const;
};

void Player::Impl::bind(const Scene& scene, const std::vector<NodeId>& targets) {
  for (const Track& track : clip.tracks) {
    const NodeId node = targets[track.target];
    if (!node) continue;
    const auto [found, is_new] = by_node.try_emplace(node, animated.size());
    if (is_new) animated.push_back({.node = node});
    AnimatedNode& entry = animated[found->second];
    entry.tracks[static_cast<std::size_t>(track.channel)] = &track;
    if (track.channel == Channel::LinkValue) entry.link = *scene.link(node);
    else entry.rest = *decompose(scene.local(node));
  }
}

const AnimatedNode& Player::Impl::at(NodeId id) const {
  const auto found = by_node.find(id);
  PANTIN_EXPECTS(found != by_node.end(), "clip '" + clip.name + "' does not animate node id (index " +
                                             std::to_string(id.index) + ", generation " +
                                             std::to_string(id.generation) + "); ask animates() first");
  return animated[found->second];
}

LocalMotion Player::Impl::motion(const AnimatedNode& node, double play_time, KeySide side) const {
  LocalMotion M = clip_motion(node, clock.read(play_time, side));
  M.first *= clock.speed();
  M.second *= clock.speed() * clock.speed();
  return M;
}

Player::Player(const Scene& scene, Clip clip, std::vector<NodeId> targets, PlayerSettings settings) {
  std::string problem = problem_with(scene, clip, targets);
  if (problem.empty()) problem = problem_with(settings, clip);
  PANTIN_EXPECTS(problem.empty(), problem);
  impl_ = std::make_unique<Impl>(std::move(clip), settings);
  impl_->bind(scene, targets);
}

Player::~Player() = default;
Player::Player(Player&&) noexcept = default;
Player& Player::operator=(Player&&) noexcept = default;

const Clip& Player::clip() const noexcept { return impl_->clip; }
const PlayerSettings& Player::settings() const noexcept { return impl_->clock.settings(); }
double Player::time() const noexcept { return impl_->time; }

void Player::set_time(double time) {
  PANTIN_EXPECTS(std::isfinite(time), "play time " + std::to_string(time) + " s is not finite");
  impl_->time = time;
}

void Player::advance(double elapsed) {
  PANTIN_EXPECTS(elapsed >= 0, "elapsed time " + std::to_string(elapsed) +
                                   " s is negative; give PlayerSettings a negative speed to play backwards");
  set_time(impl_->time + elapsed);
}

void Player::apply(Scene& scene) const {
  const ClockReading now = impl_->clock.read(impl_->time, KeySide::After);
  std::vector<NodeLocal> locals;
  locals.reserve(impl_->animated.size());
  for (const AnimatedNode& animated : impl_->animated) {
    if (holds(animated.node) || !scene.contains(animated.node)) continue;
    NodeLocal local{.node = animated.node};
    local.M_PN.affine() = impl_->motion(animated, impl_->time, KeySide::After).value;
    locals.push_back(local);
    const Link* link = scene.link(animated.node);
    if (!animated.link || !link || link->kind != animated.link->kind) continue;
    const Track& track = *animated.track(Channel::LinkValue);
    const TrackSample value = sample_at(track, now);
    const std::span<const double> numbers{value.value.data(), static_cast<std::size_t>(track.width)};
    scene.note_link_value(animated.node, LinkValue{numbers});
  }
  scene.set_locals(locals);
}

bool Player::animates(NodeId id) const { return impl_->by_node.contains(id); }

std::vector<NodeId> Player::nodes() const {
  std::vector<NodeId> ids;
  ids.reserve(impl_->animated.size());
  for (const AnimatedNode& animated : impl_->animated) ids.push_back(animated.node);
  return ids;
}

void Player::hold(NodeId id) { impl_->held.insert(id); }
void Player::release(NodeId id) { impl_->held.erase(id); }
bool Player::holds(NodeId id) const { return impl_->held.contains(id); }

LocalMotion Player::motion(NodeId id, double time, KeySide side) const {
  PANTIN_EXPECTS(std::isfinite(time), "play time " + std::to_string(time) + " s is not finite");
  return impl_->motion(impl_->at(id), time, side);
}

double Player::next_break(NodeId id, double time) const {
  PANTIN_EXPECTS(std::isfinite(time), "play time " + std::to_string(time) + " s is not finite");
  const double never = std::numeric_limits<double>::infinity();
  const AnimatedNode& animated = impl_->at(id);
  const PlayClock& clock = impl_->clock;
  if (clock.speed() == 0) return never;
  const bool forward = clock.speed() > 0;
  const ClockReading now = clock.read(time, KeySide::After);
  double nearest = forward ? never : -never;  // clip time of the next break within this lap
  bool varies = false;
  for (const Track* track : animated.tracks) {
    if (!track || track->times.size() < 2) continue;
    varies = true;
    const std::vector<double>& times = track->times;
    if (forward) {
      nearest = std::min(nearest, pantin::next_break(*track, now.position + now.slack));
    } else {
      const auto beyond = std::lower_bound(times.begin(), times.end(), now.position - now.slack);
      if (beyond != times.begin()) nearest = std::max(nearest, *std::prev(beyond));
    }
  }
  if (!varies) return never;
  if (clock.wraps()) nearest = forward ? std::min(nearest, clock.duration()) : std::max(nearest, 0.0);
  if (!std::isfinite(nearest)) return never;
  return std::max(clock.play_time(now.lap_begin + nearest), std::nextafter(time, never));
}

}  // namespace pantin
