// Which plays there are and what they animate.
#include <cmath>

#include <pantin/scenegraph/expects.hpp>
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

SharedClip::SharedClip(Clip clip) {
  const std::string problem = problem_with(clip);
  PANTIN_EXPECTS(problem.empty(), problem);
  prepared_ = std::make_shared<const PreparedClip>(std::move(clip));
}
const Clip& SharedClip::clip() const noexcept { return prepared_->clip; }

int AnimatedNode::width(std::size_t channel) const {
  if (channel == static_cast<std::size_t>(Channel::LinkValue)) return link ? value_size(link->kind) : 0;
  return channel == static_cast<std::size_t>(Channel::Rotation) ? 4 : 3;
}

Play& Player::Impl::at(PlayId id) const {
  const auto found =
      std::find_if(plays.begin(), plays.end(), [id](const auto& play) { return play->id == id; });
  PANTIN_EXPECTS(found != plays.end(),
                 "play " + std::to_string(id.number) + " is null or was stopped; ask is_playing() first");
  return **found;
}

const AnimatedNode* Player::Impl::find(NodeId id) const {
  const auto found = by_node.find(id);
  return found == by_node.end() ? nullptr : &animated[found->second];
}

Carrier* Player::Impl::carrier(NodeId id) {
  const auto found =
      std::find_if(carriers.begin(), carriers.end(), [id](const Carrier& c) { return c.node == id; });
  return found == carriers.end() ? nullptr : &*found;
}

void Player::Impl::set_held(NodeId id, bool is_held) {
  if (const auto found = by_node.find(id); found != by_node.end()) animated[found->second].is_held = is_held;
  if (Carrier* carrier = this->carrier(id)) carrier->is_held = is_held;
}

std::string called(NodeId id) {
  return "node id (index " + std::to_string(id.index) + ", generation " + std::to_string(id.generation) + ")";
}

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

void Player::Impl::drop_unused() {
  std::erase_if(animated, [](const AnimatedNode& entry) { return entry.parts.empty(); });
  std::erase_if(carriers, [](const Carrier& carrier) { return carrier.plays.empty(); });
  by_node.clear();
  for (std::size_t i = 0; i < animated.size(); ++i) by_node[animated[i].node] = i;
}

void Player::Impl::settle_carriers() {
  for (Carrier& carrier : carriers) {
    carrier.M_anchor.affine() = motion(carrier, time, KeySide::After).value;
    carrier.anchor = time;
  }
}

Player::Player() : impl_{std::make_unique<Impl>()} {}
Player::Player(const Scene& scene, SharedClip clip, const std::vector<NodeId>& targets,
               PlayerSettings settings)
    : Player{} {
  play(scene, std::move(clip), targets, std::move(settings));
}
Player::~Player() = default;
Player::Player(Player&&) noexcept = default;
Player& Player::operator=(Player&&) noexcept = default;

PlayId Player::play(const Scene& scene, SharedClip clip, const std::vector<NodeId>& targets,
                    PlayerSettings settings) {
  const std::string problem = impl_->problem_with_play(scene, clip.clip(), targets, settings);
  PANTIN_EXPECTS(problem.empty(), problem);
  Impl& impl = *impl_;
  impl.settle_carriers();
  impl.events.clear();
  const PlayId id{++impl.last_play};
  impl.plays.push_back(std::make_unique<Play>(id, std::move(clip), std::move(settings)));
  impl.bind(scene, *impl.plays.back(), targets);
  return id;
}

void Player::stop(PlayId id) {
  Play& play = impl_->at(id);
  impl_->settle_carriers();
  impl_->events.clear();
  for (AnimatedNode& entry : impl_->animated)
    std::erase_if(entry.parts, [&](const NodePart& part) { return part.play == &play; });
  for (Carrier& carrier : impl_->carriers) std::erase(carrier.plays, &play);
  impl_->drop_unused();
  std::erase_if(impl_->plays, [&](const std::unique_ptr<Play>& p) { return p.get() == &play; });
}

void Player::stop(NodeId node) {
  Impl& impl = *impl_;
  if (!animates(node)) return;
  const std::vector<PlayId> ids = plays_of(node);
  impl.settle_carriers();
  const auto found = impl.by_node.find(node);
  if (found != impl.by_node.end()) impl.animated[found->second].parts.clear();
  if (Carrier* carrier = impl.carrier(node)) carrier->plays.clear();
  impl.drop_unused();
  for (const PlayId id : ids)
    if (nodes_of(id).empty()) stop(id);
}

bool Player::is_playing(PlayId id) const {
  return std::any_of(impl_->plays.begin(), impl_->plays.end(),
                     [id](const auto& play) { return play->id == id; });
}

std::vector<PlayId> Player::plays() const {
  std::vector<PlayId> ids;
  for (const std::unique_ptr<Play>& play : impl_->plays) ids.push_back(play->id);
  return ids;
}

std::vector<PlayId> Player::plays_of(NodeId node) const {
  std::vector<PlayId> ids;
  if (const AnimatedNode* entry = impl_->find(node)) {
    for (const NodePart& part : entry->parts) ids.push_back(part.play->id);
  }
  if (const Carrier* carrier = impl_->carrier(node)) {
    for (const Play* play : carrier->plays) ids.push_back(play->id);
  }
  return ids;
}

std::vector<NodeId> Player::nodes_of(PlayId id) const {
  const Play* play = &impl_->at(id);
  std::vector<NodeId> ids;
  for (const AnimatedNode& entry : impl_->animated) {
    const bool plays = std::any_of(entry.parts.begin(), entry.parts.end(),
                                   [play](const NodePart& part) { return part.play == play; });
    if (plays) ids.push_back(entry.node);
  }
  for (const Carrier& carrier : impl_->carriers)
    if (std::find(carrier.plays.begin(), carrier.plays.end(), play) != carrier.plays.end())
      ids.push_back(carrier.node);
  return ids;
}

const Clip& Player::clip(PlayId id) const { return impl_->at(id).clip.clip(); }
const PlayerSettings& Player::settings(PlayId id) const { return impl_->at(id).settings; }

void Player::set_weight(PlayId id, Curve weight) {
  Play& play = impl_->at(id);
  PlayerSettings changed = play.settings;
  changed.weight = weight;
  const std::string problem = problem_with(changed, play.clip.clip());
  PANTIN_EXPECTS(problem.empty(), problem);
  impl_->settle_carriers();
  play.settings.weight = std::move(weight);
}

void Player::cross_fade(PlayId from, PlayId to, const CrossFadeSettings& settings) {
  PANTIN_EXPECTS(from != to, "play " + std::to_string(from.number) + " cannot fade to itself");
  FadeSettings span{.begin = settings.begin, .duration = settings.duration, .from = 1, .to = 0};
  set_weight(from, fade(span));
  std::swap(span.from, span.to);
  set_weight(to, fade(span));
}

bool Player::animates(NodeId id) const { return impl_->by_node.contains(id) || is_carrier(id); }
bool Player::is_carrier(NodeId id) const { return impl_->carrier(id) != nullptr; }

std::vector<NodeId> Player::nodes() const {
  std::vector<NodeId> ids;
  ids.reserve(impl_->animated.size() + impl_->carriers.size());
  for (const AnimatedNode& entry : impl_->animated) ids.push_back(entry.node);
  for (const Carrier& carrier : impl_->carriers) ids.push_back(carrier.node);
  return ids;
}

void Player::stop_removed(const Scene& scene) {
  const auto is_gone = [&](const auto& entry) { return !scene.contains(entry.node); };
  while (true) {
    if (const auto gone = std::find_if(impl_->animated.begin(), impl_->animated.end(), is_gone);
        gone != impl_->animated.end())
      stop(gone->node);
    else if (const auto lost = std::find_if(impl_->carriers.begin(), impl_->carriers.end(), is_gone);
             lost != impl_->carriers.end())
      stop(lost->node);
    else return;
  }
}

void Player::hold(NodeId id) {
  impl_->held.insert(id);
  impl_->set_held(id, true);
}
void Player::release(NodeId id) {
  impl_->held.erase(id);
  impl_->set_held(id, false);
}
bool Player::holds(NodeId id) const { return impl_->held.contains(id); }

bool Player::begins_at(NodeId id, double time) const {
  for (const PlayId play : plays_of(id))
    if (settings(play).begin == time) return true;
  return false;
}

}  // namespace pantin
