// Which plays there are and what they animate.
#include <cmath>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/player_impl.hpp>

namespace pantin {
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
