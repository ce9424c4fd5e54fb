#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <pantin/scenegraph/player.hpp>
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
  const std::string node_name = node_called(scene, node);
  if (track.channel != Channel::LinkValue) {
    if (decompose(scene.local(node))) return {};
    return "local matrix of " + node_name +
           " is sheared, so it is no product of translation, rotation and scale that " +
           "a clip could animate; put the shear into a node above or below it";
  }
  const Link* link = scene.link(node);
  if (link == nullptr) return node_name + " has no link whose value could be animated";
  if (value_size(link->kind) == track.width) return {};
  return "the " + std::string{to_string(link->kind)} + " link of " + node_name + " has a value of " +
         std::to_string(value_size(link->kind)) + " numbers, the track of " + std::to_string(track.width);
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

}  // namespace

std::string problem_with(const PlayerSettings& settings, const Clip& clip) {
  if (!std::isfinite(settings.begin) || !std::isfinite(settings.speed))
    return "begin and speed of a player must be finite";
  if (!(settings.offset >= 0 && settings.offset <= clip.duration))
    return "offset " + std::to_string(settings.offset) + " s is not within the clip's 0 .. " +
           std::to_string(clip.duration) + " s";
  return {};
}

std::string problem_with(const Scene& scene, const Clip& clip, const std::vector<NodeId>& targets) {
  const std::string clip_name = "clip '" + clip.name + "'";
  if (!std::isfinite(clip.duration)) return clip_name + ": duration is not finite";
  TakenChannels taken;
  for (std::size_t k = 0; k < clip.tracks.size(); ++k) {
    const Track& track = clip.tracks[k];
    const std::string where = clip_name + ", track " + std::to_string(k) + ": ";
    if (std::string text = problem_with(track); !text.empty()) return where + text;
    if (track.times.back() > clip.duration)
      return where + "last key at " + std::to_string(track.times.back()) + " s is after the clip's end at " +
             std::to_string(clip.duration) + " s";
    if (track.target >= targets.size())
      return where + "target " + std::to_string(track.target) + " has no entry among the " +
             std::to_string(targets.size()) + " nodes given";
    const NodeId node = targets[track.target];
    if (!node) continue;
    if (!scene.contains(node))
      return where + "the node of target " + std::to_string(track.target) + " was removed";
    if (std::string text = problem_with_channels(scene, track, node, taken); !text.empty())
      return where + text;
    if (std::string text = problem_with_node(scene, track, node); !text.empty()) return where + text;
  }
  if (clip.duration < 0) return clip_name + ": duration is negative";
  return {};
}

}  // namespace pantin
