// What a new play has to do with which nodes.
#include <pantin/scenegraph/player_impl.hpp>
#include <pantin/scenegraph/trs.hpp>

namespace pantin {
namespace {

/// The weight of the entry nearest at or above the node.
double mask_weight(const Scene& scene, const std::vector<SubtreeWeight>& mask, NodeId node) {
  if (mask.empty()) return 1;
  for (NodeId id = node; id; id = scene.parent(id)) {
    for (const SubtreeWeight& entry : mask)
      if (entry.top == id) return entry.weight;
  }
  return 0;
}

double channel_weight(const ChannelWeights& weights, Channel channel) {
  switch (channel) {
    case Channel::Translation:
      return weights.translation;
    case Channel::Rotation:
      return weights.rotation;
    case Channel::Scale:
      return weights.scale;
    case Channel::LinkValue:
      return weights.link_value;
  }
  return 0;
}

NodePart& part_of(AnimatedNode& entry, Play& play) {
  for (NodePart& part : entry.parts)
    if (part.play == &play) return part;
  const auto above = std::find_if(entry.parts.begin(), entry.parts.end(), [&](const NodePart& part) {
    return part.play->settings.layer > play.settings.layer;
  });
  NodePart& part = *entry.parts.insert(above, NodePart{});
  part.play = &play;
  return part;
}

}  // namespace

void Player::Impl::set_rest(const Scene& scene, AnimatedNode& entry, Channel channel) const {
  NodePose<double> pose{};
  if (channel == Channel::LinkValue) {
    entry.link = std::make_unique<const Link>(*scene.link(entry.node));
    const std::span<const double> numbers = entry.link->value.numbers();
    std::copy(numbers.begin(), numbers.end(), pantin::at(pose, channel).begin());
  } else {
    const Trs rest = *decompose(scene.local(entry.node));
    const Vector3 &p = rest.translation, &s = rest.scale;
    const Quaternion& q = rest.rotation;
    pantin::at(pose, Channel::Translation) = {p.x(), p.y(), p.z()};
    pantin::at(pose, Channel::Rotation) = {q.w(), q.x(), q.y(), q.z()};
    pantin::at(pose, Channel::Scale) = {s.x(), s.y(), s.z()};
  }
  entry.rest = std::make_unique<const NodePose<double>>(pose);
}

void Player::Impl::bind(const Scene& scene, Play& play, const std::vector<NodeId>& targets) {
  for (const PreparedTrack& prepared : play.clip.prepared().tracks) {
    const Track& track = *prepared.track;
    const NodeId node = targets[track.target];
    if (!node) continue;
    const double share =
        mask_weight(scene, play.settings.mask, node) * channel_weight(play.settings.channels, track.channel);
    if (share == 0) continue;
    const auto [found, is_new] = by_node.try_emplace(node, animated.size());
    if (is_new) {
      animated.push_back({.node = node, .is_held = held.contains(node)});
      set_rest(scene, animated.back(), track.channel);
    }
    NodePart& part = part_of(animated[found->second], play);
    const std::size_t channel = static_cast<std::size_t>(track.channel);
    part.tracks[channel] = &prepared;
    const bool is_additive = play.settings.blend == Blend::Additive;
    if (!part.blend && (share != 1 || is_additive)) {
      part.blend = std::make_unique<PartBlend>();
      part.blend->share.fill(1);
    }
    if (part.blend) part.blend->share[channel] = share;
    if (is_additive)
      sample_values(prepared, {.time = play.settings.reference}, part.cursors[channel],
                    part.blend->reference[channel]);
    part.is_root_source = play.settings.root && play.settings.root->source == node;
  }
  if (play.settings.root) bind_carrier(scene, play);
}

void Player::Impl::bind_carrier(const Scene& scene, Play& play) {
  const RootMotion& root = *play.settings.root;
  const AnimatedNode* source = find(root.source);
  if (source == nullptr) return;  // masked out
  const auto part = std::find_if(source->parts.begin(), source->parts.end(),
                                 [&](const NodePart& p) { return p.play == &play; });
  if (part == source->parts.end() || !part->tracks[std::size_t(Channel::Translation)]) return;
  const PreparedTrack* rotation = root.turn_about ? part->tracks[std::size_t(Channel::Rotation)] : nullptr;
  play.root.emplace(root, *part->tracks[std::size_t(Channel::Translation)], rotation, play.clock.duration());
  Affine K = Affine::Identity();
  for (NodeId id = scene.parent(root.source); id != root.carrier; id = scene.parent(id))
    K = scene.local(id) * K;
  play.root->K = K;
  play.root->K_inverse = K.inverse();
  Carrier* carrier = this->carrier(root.carrier);
  if (carrier == nullptr) {
    carriers.push_back({.node = root.carrier,
                        .M_anchor = scene.local(root.carrier),
                        .anchor = time,
                        .is_held = held.contains(root.carrier)});
    carrier = &carriers.back();
  }
  carrier->plays.push_back(&play);
}

}  // namespace pantin
