#pragma once
// Links that follow others (LinkMimic), resolved among the nodes of one model, and what they do when their
// leader moves while animated.
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <pantin/scenegraph/clip.hpp>
#include <pantin/scenegraph/scene.hpp>

namespace pantin {

/// A link whose value is multiplier * (value of its leader) + offset.
struct Follower {
  NodeId node{};
  double multiplier{1};
  double offset{0};  ///< [rad] or [m]
};

/// Those that follow a node's link directly, by that node.
using Followers = std::unordered_map<NodeId, std::vector<Follower>>;

/// Adds the followers among the nodes of one model; a source that no link of them has leads nothing, and of
/// several links of one name the first leads.
void add_followers(const Scene& scene, std::span<const NodeId> model, Followers& into);

/// All that follow `leader`, also over several links, those nearest first, each once and with its rule
/// against `leader` itself. Those in `except` move by themselves: they do not follow, and lead what follows
/// them.
[[nodiscard]] std::vector<Follower> all_followers(const Followers& followers, NodeId leader,
                                                  const std::unordered_set<NodeId>& except = {});

/// The clip with a track for each follower of a link that it moves, unless it moves the follower itself: keys
/// and tangents under the follower's rule, so that interpolation and derivatives are exact. New targets are
/// appended to `targets`.
[[nodiscard]] Clip with_followers(const Clip& clip, const Followers& followers, std::vector<NodeId>& targets);

}  // namespace pantin
