// Where the motion of a node may jump.
#include <cmath>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/player_impl.hpp>

namespace pantin {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kPlaces = 32;  // between two breaks, at which switches are looked at

/// Position within the lap of the nearest key that comes next; infinite if there is none. Sets `varies` if a
/// track has more than one key.
double next_key(std::span<const PreparedTrack* const> tracks, const ClockReading& now, bool is_forward,
                bool& varies) {
  double nearest = is_forward ? kNever : -kNever;
  for (const PreparedTrack* prepared : tracks) {
    if (prepared == nullptr || prepared->track->times.size() < 2) continue;
    varies = true;
    const std::vector<double>& times = prepared->track->times;
    if (is_forward) {
      nearest = std::min(nearest, next_break(*prepared->track, now.position + now.slack));
    } else {
      const auto beyond = std::lower_bound(times.begin(), times.end(), now.position - now.slack);
      if (beyond != times.begin()) nearest = std::max(nearest, *std::prev(beyond));
    }
  }
  return nearest;
}

/// Whether the node's blends have sides to switch between.
bool has_switches(const AnimatedNode& node) {
  if (node.parts.size() > 1) return true;
  const NodePart& part = node.parts.front();
  const Curve& weight = part.play->settings.weight;
  return part.blend || !weight.is_constant() || sample(weight, 0).value != 1;
}

}  // namespace

double next_clock_break(const PlayClock& clock, std::span<const PreparedTrack* const> tracks, double time) {
  if (clock.speed() == 0) return kNever;
  const bool is_forward = clock.speed() > 0;
  const ClockReading now = clock.read(time, KeySide::After);
  bool varies = false;
  double nearest = next_key(tracks, now, is_forward, varies);
  if (!varies) return kNever;
  const double warp_break = clock.next_warp_break(time);
  if (clock.wraps()) nearest = is_forward ? std::min(nearest, clock.duration()) : std::max(nearest, 0.0);
  if (!std::isfinite(nearest)) return warp_break;
  const double key = clock.play_time(now.lap * clock.duration() + nearest);
  return std::min(warp_break, std::max(key, std::nextafter(time, kNever)));
}

double Player::Impl::next_break(const AnimatedNode& node, double play_time) const {
  double next = kNever;
  for (const NodePart& part : node.parts) {
    next = std::min(next, next_clock_break(part.play->clock, part.tracks, play_time));
    next = std::min(next, pantin::next_break(part.play->settings.weight, play_time));
  }
  if (!std::isfinite(next) || !has_switches(node)) return next;
  const auto switches_at = [&](double t, bool is_before) {
    Switches switches;
    static_cast<void>(pose(node, t, {.is_before = is_before, .switches = &switches}));
    return switches;
  };
  const Switches now = switches_at(play_time, false);
  double same = play_time;
  for (int i = 1; i <= kPlaces; ++i) {
    const double place = i < kPlaces ? play_time + i * (next - play_time) / kPlaces : next;
    if (switches_at(place, i == kPlaces) == now) {
      same = place;
      continue;
    }
    for (double other = place;;) {
      const double middle = same + (other - same) / 2;
      if (!(same < middle && middle < other)) return other;
      (switches_at(middle, false) == now ? same : other) = middle;
    }
  }
  return next;
}

double Player::Impl::next_break(const Carrier& carrier, double play_time) const {
  double next = kNever;
  for (const Play* play : carrier.plays) {
    next = std::min(next, next_clock_break(play->clock, play->root->tracks(), play_time));
    // Its weight counts at the middle of the time since the anchor.
    const double middle = carrier.anchor + (play_time - carrier.anchor) / 2;
    const double weight_break =
        carrier.anchor + 2 * (pantin::next_break(play->settings.weight, middle) - carrier.anchor);
    if (weight_break > play_time) next = std::min(next, weight_break);
  }
  return next;
}

double Player::next_break(NodeId id, double time) const {
  PANTIN_EXPECTS(std::isfinite(time), "play time " + std::to_string(time) + " s is not finite");
  if (const AnimatedNode* node = impl_->find(id)) return impl_->next_break(*node, time);
  const Carrier* carrier = impl_->carrier(id);
  PANTIN_EXPECTS(carrier != nullptr, "no clip animates " + called(id) + "; ask animates() first");
  return impl_->next_break(*carrier, time);
}

}  // namespace pantin
