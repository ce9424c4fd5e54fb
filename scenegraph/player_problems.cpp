#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <pantin/scenegraph/player_impl.hpp>
#include <pantin/scenegraph/trs.hpp>

namespace pantin {
namespace {

const char* name_of(Channel channel) {
  switch (channel) {
    case Channel::Translation:
      return "translation";
    case Channel::Rotation:
      return "rotation";
    case Channel::Scale:
      return "scale";
    case Channel::LinkValue:
      return "link value";
  }
  return "";
}

std::string node_called(const Scene& scene, NodeId node) {
  return node == scene.root() ? "the root" : "node '" + scene.path(node) + "'";
}

std::string problem_with_node(const Scene& scene, const Track& track, NodeId node) {
  if (track.channel != Channel::LinkValue) {
    if (decompose(scene.local(node))) return {};
    return "local matrix of " + node_called(scene, node) +
           " is sheared, so it is no product of translation, rotation and scale that " +
           "a clip could animate; put the shear into a node above or below it";
  }
  const Link* link = scene.link(node);
  if (link == nullptr) return node_called(scene, node) + " has no link whose value could be animated";
  if (value_size(link->kind) == track.width) return {};
  return "the " + std::string{to_string(link->kind)} + " link of " + node_called(scene, node) +
         " has a value of " + std::to_string(value_size(link->kind)) + " numbers, the track of " +
         std::to_string(track.width);
}

/// Which channels of each node are taken.
using TakenChannels = std::unordered_map<NodeId, unsigned>;

std::string problem_with_channels(const Scene& scene, const Track& track, NodeId node, TakenChannels& taken) {
  const unsigned own = 1U << static_cast<unsigned>(track.channel);
  const unsigned link = 1U << static_cast<unsigned>(Channel::LinkValue);
  unsigned& others = taken[node];
  if ((others & own) != 0)
    return "another track animates the " + std::string{name_of(track.channel)} + " of " +
           node_called(scene, node) + " too";
  if (others != 0 && ((others | own) & link) != 0)
    return "link value and matrix of " + node_called(scene, node) +
           " are both animated; the link's value gives the matrix";
  others |= own;
  return {};
}

std::string problem_with_events(const Clip& clip) {
  for (std::size_t k = 0; k < clip.events.size(); ++k) {
    const double time = clip.events[k].time;
    const std::string event = "event " + std::to_string(k) + " at " + std::to_string(time) + " s ";
    if (!(time >= 0 && time <= clip.duration))
      return event + "is not within the clip's 0 .. " + std::to_string(clip.duration) + " s";
    if (k > 0 && time < clip.events[k - 1].time) return event + "is before the event before it";
  }
  return {};
}

std::string problem_with_weights(const PlayerSettings& settings) {
  if (std::string text = problem_with(settings.weight); !text.empty()) return "weight: " + text;
  const bool is_additive = settings.blend == Blend::Additive;
  const auto fits = [is_additive](double w) {
    return std::isfinite(w) && (is_additive || (w >= 0 && w <= 1));
  };
  const std::string range =
      is_additive ? " is not finite" : " is not within 0 .. 1; only Additive may go beyond";
  const Track& keys = settings.weight.keys();
  for (std::size_t k = 0; k < keys.times.size(); ++k)
    if (const double w = *key_value(keys, k); !fits(w)) return "weight " + std::to_string(w) + range;
  const ChannelWeights& channels = settings.channels;
  for (const double w : {channels.translation, channels.rotation, channels.scale, channels.link_value})
    if (!fits(w)) return "channel weight " + std::to_string(w) + range;
  for (const SubtreeWeight& entry : settings.mask)
    if (!(entry.weight >= 0 && entry.weight <= 1))
      return "mask weight " + std::to_string(entry.weight) + " is not within 0 .. 1";
  return {};
}

std::string problem_with_root(const PlayerSettings& settings) {
  if (!settings.root) return {};
  if (settings.blend == Blend::Additive) return "an Additive play has no root motion; play it as Override";
  const std::optional<Vector3>& axis = settings.root->turn_about;
  if (axis && !(std::abs(axis->norm() - 1) < 1e-9))
    return "the axis of root motion has length " + std::to_string(axis->norm()) + ", not 1";
  return {};
}

std::string track_called(const Clip& clip, std::size_t k) {
  return "clip '" + clip.name + "', track " + std::to_string(k) + ": ";
}

/// What a track does to the node of its target.
std::string problem_with_target(const Scene& scene, const Track& track, const std::vector<NodeId>& targets,
                                TakenChannels& taken) {
  if (track.target >= targets.size())
    return "target " + std::to_string(track.target) + " has no entry among the " +
           std::to_string(targets.size()) + " nodes given";
  const NodeId node = targets[track.target];
  if (!node) return {};
  if (!scene.contains(node)) return "the node of target " + std::to_string(track.target) + " was removed";
  if (std::string text = problem_with_channels(scene, track, node, taken); !text.empty()) return text;
  return problem_with_node(scene, track, node);
}

std::string problem_with_targets(const Scene& scene, const Clip& clip, const std::vector<NodeId>& targets) {
  TakenChannels taken;
  for (std::size_t k = 0; k < clip.tracks.size(); ++k)
    if (std::string text = problem_with_target(scene, clip.tracks[k], targets, taken); !text.empty())
      return track_called(clip, k) + text;
  return {};
}

bool has_track(const Clip& clip, const std::vector<NodeId>& targets, NodeId node, Channel channel) {
  return std::any_of(clip.tracks.begin(), clip.tracks.end(), [&](const Track& track) {
    return track.channel == channel && targets[track.target] == node;
  });
}

bool has_any_track(const Clip& clip, const std::vector<NodeId>& targets, NodeId node) {
  return std::any_of(clip.tracks.begin(), clip.tracks.end(),
                     [&](const Track& track) { return targets[track.target] == node; });
}

std::string problem_with_root(const Scene& scene, const Clip& clip, const std::vector<NodeId>& targets,
                              const RootMotion& root) {
  if (!scene.contains(root.source) || !scene.contains(root.carrier))
    return "root motion: source and carrier must be nodes of the scene";
  if (root.source == root.carrier || !scene.is_above(root.carrier, root.source))
    return "root motion: " + node_called(scene, root.carrier) + " is not above " +
           node_called(scene, root.source);
  if (!has_track(clip, targets, root.source, Channel::Translation))
    return "root motion: the clip does not animate the translation of " + node_called(scene, root.source);
  if (root.turn_about && !has_track(clip, targets, root.source, Channel::Rotation))
    return "root motion: the clip does not animate the rotation of " + node_called(scene, root.source);
  if (has_any_track(clip, targets, root.carrier))
    return "root motion: the clip animates the carrier, " + node_called(scene, root.carrier) + ", too";
  for (NodeId id = scene.parent(root.source); id != root.carrier; id = scene.parent(id)) {
    if (scene.local(id).linear().determinant() == 0)
      return "root motion: the local matrix of " + node_called(scene, id) + " is singular";
    if (has_any_track(clip, targets, id))
      return "root motion: the clip animates " + node_called(scene, id) +
             ", which lies between source and carrier";
  }
  return {};
}

/// An Additive scale is a ratio.
std::string problem_with_reference(const Clip& clip, const PlayerSettings& settings) {
  if (settings.blend != Blend::Additive) return {};
  for (const Track& track : clip.tracks) {
    if (track.channel != Channel::Scale) continue;
    const TrackSample reference = sample(track, settings.reference);
    for (std::size_t i = 0; i < 3; ++i)
      if (reference.value[i] == 0) return "a scale is 0 at the reference time, so nothing is a ratio to it";
  }
  return {};
}

}  // namespace

std::string problem_with(const PlayerSettings& settings, const Clip& clip) {
  if (!std::isfinite(settings.begin) || !std::isfinite(settings.speed))
    return "begin and speed of a player must be finite";
  const std::string within = " s is not within the clip's 0 .. " + std::to_string(clip.duration) + " s";
  if (!(settings.offset >= 0 && settings.offset <= clip.duration))
    return "offset " + std::to_string(settings.offset) + within;
  if (!(settings.reference >= 0 && settings.reference <= clip.duration))
    return "reference " + std::to_string(settings.reference) + within;
  if (settings.warp) {
    if (std::string text = problem_with_warp(*settings.warp); !text.empty()) return "warp: " + text;
  }
  if (std::string text = problem_with_weights(settings); !text.empty()) return text;
  return problem_with_root(settings);
}

std::string problem_with(const Clip& clip) {
  const std::string clip_name = "clip '" + clip.name + "': ";
  if (!std::isfinite(clip.duration)) return clip_name + "duration is not finite";
  for (std::size_t k = 0; k < clip.tracks.size(); ++k) {
    const Track& track = clip.tracks[k];
    if (std::string text = problem_with(track); !text.empty()) return track_called(clip, k) + text;
    if (track.times.back() > clip.duration)
      return track_called(clip, k) + "last key at " + std::to_string(track.times.back()) +
             " s is after the clip's end at " + std::to_string(clip.duration) + " s";
  }
  if (clip.duration < 0) return clip_name + "duration is negative";
  if (std::string text = problem_with_events(clip); !text.empty()) return clip_name + text;
  return {};
}

std::string problem_with(const Scene& scene, const Clip& clip, const std::vector<NodeId>& targets) {
  if (std::string text = problem_with(clip); !text.empty()) return text;
  return problem_with_targets(scene, clip, targets);
}

std::string problem_with(const Player& player, const Scene& scene, const Clip& clip,
                         const std::vector<NodeId>& targets, const PlayerSettings& settings) {
  if (std::string text = problem_with(clip); !text.empty()) return text;
  return player.impl_->problem_with_play(scene, clip, targets, settings);
}

std::string Player::Impl::problem_with_play(const Scene& scene, const Clip& clip,
                                            const std::vector<NodeId>& targets,
                                            const PlayerSettings& settings) {
  if (std::string text = problem_with_targets(scene, clip, targets); !text.empty()) return text;
  if (std::string text = pantin::problem_with(settings, clip); !text.empty()) return text;
  if (std::string text = problem_with_reference(clip, settings); !text.empty()) return text;
  for (const SubtreeWeight& entry : settings.mask)
    if (!scene.contains(entry.top)) return "a node of the mask is null or was removed";
  if (settings.root) {
    if (std::string text = problem_with_root(scene, clip, targets, *settings.root); !text.empty())
      return text;
    if (find(settings.root->carrier) != nullptr)
      return "root motion: another play animates the carrier, " + node_called(scene, settings.root->carrier);
  }
  for (const Track& track : clip.tracks) {
    const NodeId node = targets[track.target];
    if (carrier(node) != nullptr)
      return node_called(scene, node) + " is moved by the root motion of another play";
    const AnimatedNode* other = find(node);
    if (other != nullptr && (other->link != nullptr) != (track.channel == Channel::LinkValue))
      return "link value and matrix of " + node_called(scene, node) +
             " would both be animated, by this play and another; the link's value gives the matrix";
  }
  return {};
}

}  // namespace pantin
