// What the plays of a node give together, and writing it.
#include <cmath>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/player_impl.hpp>

namespace pantin {
namespace {

PlayReading<Jet> read(const Play& play, double time, KeySide side, Jet) {
  const CurveSample weight = sample(play.settings.weight, time, side);
  return {play.clock.read(time, side), {weight.value, weight.first, weight.second}};
}

/// What `read_now` has left behind.
PlayReading<double> read(const Play& play, double, KeySide, double) { return {play.now, play.weight_now}; }

/// Takes the extracted motion out of the channels that carry it.
template <class S>
void remove_root(const RootExtraction& root, NodePose<S>& values) {
  ChannelValue<S>& translation = at(values, Channel::Translation);
  ChannelValue<S>& rotation = at(values, Channel::Rotation);
  Numbers3<S> p{translation[0], translation[1], translation[2]};
  Numbers4<S> q{rotation[0], rotation[1], rotation[2], rotation[3]};
  root.remove(p, q);
  std::copy(p.begin(), p.end(), translation.begin());
  std::copy(q.begin(), q.end(), rotation.begin());
}

/// The channels of one node as one play has them; those that it does not have are left as they are.
template <class S>
void sample_into(const NodePart& part, const ClockReading& clock, std::array<KeyCursor, kChannels>& cursors,
                 NodePose<S>& values) {
  for (std::size_t c = 0; c < kChannels; ++c)
    if (part.tracks[c] != nullptr) sample_channel(*part.tracks[c], clock, cursors[c], values[c]);
  if (part.is_root_source && part.play->root) remove_root(*part.play->root, values);
}

bool is_override(const NodePart& part) { return part.play->settings.blend == Blend::Override; }

/// Whether the only play of a node has all of it.
template <class S>
bool is_alone(const NodePart& part, const S& weight) {
  return !part.blend && is_exactly(weight, 1);
}

/// Builds up the pose of one node at one time.
template <class S>
class PoseBuilder {
 public:
  /// `cursors`: the node's own parts, where their cursors may be moved; else empty.
  PoseBuilder(const AnimatedNode& node, double time, const BlendSide& side, std::span<NodePart> cursors)
      : node_{node}, time_{time}, side_{side}, cursors_{cursors} {}

  const NodePose<S>& built() {
    const std::vector<NodePart>& parts = node_.parts;
    if (parts.size() == 1) {
      const PlayReading<S> reading = this->reading(0);
      if (is_alone(parts[0], reading.weight)) {
        for (std::size_t c = 0; c < kChannels; ++c)
          if (parts[0].tracks[c] == nullptr) rest(c);
        sample_part(0, reading.clock, pose_);
        return pose_;
      }
    }
    for (std::size_t c = 0; c < kChannels; ++c) rest(c);
    for (std::size_t begin = 0, end; begin < parts.size(); begin = end) {
      const int layer = parts[begin].play->settings.layer;
      for (end = begin + 1; end < parts.size() && parts[end].play->settings.layer == layer;) ++end;
      lay_overrides(begin, end);
      for (std::size_t i = begin; i < end; ++i)
        if (!is_override(parts[i])) lay_additive(i);
    }
    return pose_;
  }

 private:
  void rest(std::size_t c) {
    const ChannelValue<double>& value = (*node_.rest)[c];
    for (std::size_t i = 0; i < value.size(); ++i) pose_[c][i] = value[i];
  }
  [[nodiscard]] PlayReading<S> reading(std::size_t i) const {
    return read(*node_.parts[i].play, time_, side_.is_before ? KeySide::Before : KeySide::After, S{});
  }
  void sample_part(std::size_t i, const ClockReading& clock, NodePose<S>& values) {
    std::array<KeyCursor, kChannels> scratch{};
    sample_into(node_.parts[i], clock, cursors_.empty() ? scratch : cursors_[i].cursors, values);
  }
  [[nodiscard]] PoseMixer<S> mixer(std::size_t c) const { return {parts_of(node_.width(c)), side_}; }

  void lay_overrides(std::size_t begin, std::size_t end) {
    std::array<PoseMixer<S>, kChannels> mixers{mixer(0), mixer(1), mixer(2), mixer(3)};
    for (std::size_t i = begin; i < end; ++i) {
      const NodePart& part = node_.parts[i];
      if (!is_override(part)) continue;
      const PlayReading<S> reading = this->reading(i);
      NodePose<S> values{};
      sample_part(i, reading.clock, values);
      for (std::size_t c = 0; c < kChannels; ++c)
        if (part.tracks[c] != nullptr) mixers[c].add(values[c], reading.weight * S{part.share(c)});
    }
    for (std::size_t c = 0; c < kChannels; ++c) mixers[c].finish(pose_[c]);
  }

  void lay_additive(std::size_t i) {
    const NodePart& part = node_.parts[i];
    const PlayReading<S> reading = this->reading(i);
    NodePose<S> values{};
    sample_part(i, reading.clock, values);
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (part.tracks[c] == nullptr) continue;
      const AddedAs added = c == std::size_t(Channel::Scale) ? AddedAs::Ratio : AddedAs::Difference;
      add_on_top(parts_of(node_.width(c)), added, values[c], part.blend->reference[c],
                 S{reading.weight * S{part.share(c)}}, side_, pose_[c]);
    }
  }

  const AnimatedNode& node_;
  double time_;
  BlendSide side_;
  std::span<NodePart> cursors_;
  NodePose<S> pose_;
};

}  // namespace

NodePose<Jet> Player::Impl::pose(const AnimatedNode& node, double play_time, const BlendSide& side) const {
  return PoseBuilder<Jet>{node, play_time, side, {}}.built();
}

LocalMotion Player::Impl::motion(const AnimatedNode& node, double play_time, KeySide side) const {
  const NodePose<Jet> pose = this->pose(node, play_time, {.is_before = side == KeySide::Before});
  if (node.link) return link_motion(*node.link, pantin::at(pose, Channel::LinkValue));
  return trs_motion(pose);
}

void Player::Impl::read_now() {
  for (const std::unique_ptr<Play>& play : plays) {
    play->now = play->clock.read(time, KeySide::After);
    play->weight_now = sample(play->settings.weight, time).value;
  }
}

void Player::Impl::apply(AnimatedNode& node, Scene& scene) {
  PoseBuilder<double> builder{node, time, {}, node.parts};
  const NodePose<double>& pose = builder.built();
  NodeLocal local{.node = node.node};
  if (!node.link) {
    local.M_PN.affine() = trs_matrix(pose);
    locals.push_back(local);
    return;
  }
  const LinkValue value = link_value(*node.link, pantin::at(pose, Channel::LinkValue));
  local.M_PN = local_matrix(*node.link, value);
  locals.push_back(local);
  const Link* link = scene.link(node.node);
  if (link != nullptr && link->kind == node.link->kind) scene.note_link_value(node.node, value);
}

void Player::apply(Scene& scene) {
  Impl& impl = *impl_;
  impl.read_now();
  impl.locals.clear();
  const std::size_t count = impl.animated.size();
  for (std::size_t i = 0; i < count; ++i) {
    // A crowd does not fit into the cache: what comes soon is fetched while this node is computed.
    if (i + 4 < count) __builtin_prefetch(impl.animated[i + 4].parts.data());
    AnimatedNode& node = impl.animated[i];
    if (!node.is_held && scene.contains(node.node)) impl.apply(node, scene);
  }
  for (const Carrier& carrier : impl.carriers) {
    if (carrier.is_held || !scene.contains(carrier.node)) continue;
    NodeLocal local{.node = carrier.node};
    local.M_PN.affine() = impl.motion(carrier, impl.time, KeySide::After).value;
    impl.locals.push_back(local);
  }
  scene.set_locals(impl.locals);
}

LocalMotion Player::motion(NodeId id, double time, KeySide side) const {
  PANTIN_EXPECTS(std::isfinite(time), "play time " + std::to_string(time) + " s is not finite");
  if (const AnimatedNode* node = impl_->find(id)) return impl_->motion(*node, time, side);
  const Carrier* carrier = impl_->carrier(id);
  PANTIN_EXPECTS(carrier != nullptr, "no clip animates " + called(id) + "; ask animates() first");
  return impl_->motion(*carrier, time, side);
}

}  // namespace pantin
