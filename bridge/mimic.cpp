#include <pantin/bridge/mimic.hpp>

#include <algorithm>
#include <string_view>

namespace pantin {
namespace {

/// v -> multiplier v + offset for the numbers of a track; tangents have no offset.
void apply(const Follower& rule, Track& track) {
  const bool cubic = track.interpolation == Interpolation::CubicSpline;
  for (std::size_t i = 0; i < track.values.size(); ++i) {
    const bool is_tangent = cubic && i % 3 != 1;
    track.values[i] = rule.multiplier * track.values[i] + (is_tangent ? 0 : rule.offset);
  }
}

}  // namespace

void add_followers(const Scene& scene, std::span<const NodeId> model, Followers& into) {
  std::unordered_map<std::string_view, NodeId> by_name;
  for (const NodeId id : model) {
    const Link* link = scene.link(id);
    if (link != nullptr && value_size(link->kind) == 1) by_name.try_emplace(link->name, id);
  }
  for (const NodeId id : model) {
    const Link* link = scene.link(id);
    if (link == nullptr || !link->mimic) continue;
    const auto leader = by_name.find(link->mimic->source);
    if (leader == by_name.end() || leader->second == id) continue;
    into[leader->second].push_back({id, link->mimic->multiplier, link->mimic->offset});
  }
}

std::vector<Follower> all_followers(const Followers& followers, NodeId leader,
                                    const std::unordered_set<NodeId>& except) {
  std::vector<Follower> all{{leader, 1, 0}};
  std::unordered_set<NodeId> seen{leader};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Follower above = all[i];
    const auto found = followers.find(above.node);
    if (found == followers.end()) continue;
    for (const Follower& next : found->second) {
      if (except.contains(next.node) || !seen.insert(next.node).second) continue;
      all.push_back(
          {next.node, next.multiplier * above.multiplier, next.multiplier * above.offset + next.offset});
    }
  }
  all.erase(all.begin());
  return all;
}

Clip with_followers(const Clip& clip, const Followers& followers, std::vector<NodeId>& targets) {
  Clip complete = clip;
  if (followers.empty()) return complete;
  std::unordered_set<NodeId> moved;
  for (const Track& track : clip.tracks) {
    if (track.target < targets.size()) moved.insert(targets[track.target]);
  }
  for (const Track& track : clip.tracks) {
    if (track.channel != Channel::LinkValue || track.width != 1 || track.target >= targets.size()) continue;
    for (const Follower& follower : all_followers(followers, targets[track.target], moved)) {
      Track& added = complete.tracks.emplace_back(track);
      added.target = static_cast<std::uint32_t>(targets.size());
      targets.push_back(follower.node);
      apply(follower, added);
    }
  }
  return complete;
}

}  // namespace pantin
