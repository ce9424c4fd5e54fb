// Clips on nodes, and what the user sets by hand.
#include <algorithm>

#include <pantin/bridge/bridge_impl.hpp>
#include <pantin/bridge/links_to_joints.hpp>
#include <pantin/scenegraph/expects.hpp>

namespace pantin {

std::vector<Diagnostic> Bridge::play(const Clip& given, std::vector<NodeId> targets,
                                     PlayerSettings settings) {
  Impl& bridge = *impl_;
  const Clip clip = with_followers(given, bridge.followers, targets);
  bridge.forget_vanished();
  bridge.notice_moves();
  std::vector<Diagnostic> notes;
  const auto refuse = [&](std::string problem, std::string remedy) {
    notes.push_back({Severity::Error, {}, "clip '" + clip.name + "'", std::move(problem), std::move(remedy)});
  };
  if (std::string problem = pantin::problem_with(bridge.scene, clip, targets); !problem.empty()) {
    refuse(std::move(problem), "");
    return notes;
  }
  bridge.play_on();
  const double now = bridge.physics.time();
  settings.begin += now;
  settings.weight = settings.weight.shifted(now);
  if (settings.warp) settings.warp = settings.warp->shifted(now, now);
  if (std::string problem = pantin::problem_with(bridge.player, bridge.scene, clip, targets, settings);
      !problem.empty()) {
    refuse(std::move(problem), "");
    return notes;
  }
  std::vector<NodeId> nodes;
  for (const Track& track : clip.tracks) {
    const NodeId node = targets[track.target];
    if (node && std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
  }
  for (const NodeId node : nodes) {
    const PlayId other = bridge.rival(node, settings);
    if (!other) continue;
    notes.push_back(bridge.note(Severity::Error, node,
                                "clip '" + clip.name + "' would animate it, but clip '" +
                                    bridge.player.clip(other).name + "' does already",
                                "stop playing it first, or give one of them another layer or a weight"));
  }
  if (has_error(notes) || nodes.empty()) return notes;
  const PlayId id = bridge.player.play(bridge.scene, clip, targets, std::move(settings));
  bridge.let_player_in(bridge.player.nodes_of(id));
  return notes;
}

namespace {

/// Whether it takes all of a node from what else is on its layer.
bool wants_all(const PlayerSettings& settings) {
  return settings.blend == Blend::Override && settings.weight.is_constant() &&
         sample(settings.weight, 0).value == 1;
}

}  // namespace

PlayId Bridge::Impl::rival(NodeId node, const PlayerSettings& settings) const {
  if (!wants_all(settings)) return {};
  for (const PlayId id : player.plays_of(node)) {
    const PlayerSettings& other = player.settings(id);
    if (other.layer == settings.layer && wants_all(other)) return id;
  }
  return {};
}

// What clips say about these nodes has changed: held ones stay where they are, the others are where the clips
// say at once.
void Bridge::Impl::let_player_in(std::span<const NodeId> nodes) {
  for (const NodeId node : nodes) {
    if (const Binding* binding = find(node)) hold_player(*binding);
    watched.erase(node);
  }
  write_scene(nullptr);
  static_cast<void>(reconcile(nodes));
  for (Binding* binding : below(nodes)) {
    if (binding->drive == Drive::Scene) announce(*binding);
  }
  write_scene(nullptr);
}

// They stay where they are, also on their way back to a clip. Until their trajectories are built anew, these
// still ask the player.
void Bridge::Impl::take_out(std::span<const NodeId> nodes) {
  for (const NodeId node : nodes) {
    player.hold(node);
    leaving.insert(node);
    Binding* binding = find(node);
    if (binding == nullptr || !binding->blend) continue;
    binding->blend.reset();
    binding->is_remembered = false;
  }
  let_player_in(nodes);
  for (const NodeId node : nodes) {
    player.release(node);
    player.stop(node);
  }
  leaving.clear();
}

void Bridge::stop_playing(NodeId id) {
  impl_->expect_alive(id, "stop_playing");
  if (!impl_->is_played(id)) return;
  impl_->notice_moves();
  impl_->take_out({&id, 1});
}

void Bridge::stop_playing(PlayId id) {
  Impl& bridge = *impl_;
  bridge.forget_vanished();
  bridge.notice_moves();
  std::vector<NodeId> alone, shared;
  for (const NodeId node : bridge.player.nodes_of(id))
    (bridge.player.plays_of(node).size() == 1 ? alone : shared).push_back(node);
  bridge.take_out(alone);
  if (bridge.player.is_playing(id)) bridge.player.stop(id);
  bridge.let_player_in(shared);
}

void Bridge::set_weight(PlayId id, const Curve& weight) {
  impl_->change_plays({&id, 1}, [&](Player& player) { player.set_weight(id, weight.shifted(time())); });
}

void Bridge::cross_fade(PlayId from, PlayId to, CrossFadeSettings settings) {
  settings.begin += time();
  const PlayId both[] = {from, to};
  impl_->change_plays(both, [&](Player& player) { player.cross_fade(from, to, settings); });
}

void Bridge::Impl::change_plays(std::span<const PlayId> plays, const std::function<void(Player&)>& change) {
  forget_vanished();
  notice_moves();
  play_on();
  change(player);
  std::vector<NodeId> nodes;
  for (const PlayId id : plays) {
    const std::vector<NodeId> more = player.nodes_of(id);
    nodes.insert(nodes.end(), more.begin(), more.end());
  }
  let_player_in(nodes);
}

void Bridge::set_local(NodeId id, const Affine& M_PN) {
  Impl& bridge = *impl_;
  bridge.expect_alive(id, "set_local");
  Binding* binding = bridge.find(id);
  PANTIN_EXPECTS(
      binding == nullptr || binding->drive != Drive::Physics,
      "set_local: node '" + bridge.scene.path(id) +
          "' is simulated, so physics writes its matrix; move it with teleport, or take it back first");
  if (binding != nullptr && binding->drive == Drive::Static) {
    const Affine M_WN = bridge.scene.world(bridge.scene.parent(id)) * M_PN;
    const std::vector<Diagnostic> notes = teleport(id, M_WN);
    PANTIN_EXPECTS(!has_error(notes), "set_local: " + to_string(notes.back()));
    return;
  }
  if (binding != nullptr && binding->blend) {  // the user leads it now
    bridge.notice_moves();
    const RigidMotion before = binding->motion->split_at(bridge.physics.time(), Side::After).X;
    binding->blend.reset();
    if (!binding->moved_from) binding->moved_from = before;
    bridge.scene.set_local(id, M_PN);
    static_cast<void>(bridge.reconcile({&id, 1}));
    return;
  }
  bridge.scene.set_local(id, M_PN);
  if (!bridge.player.is_carrier(id)) return;
  bridge.play_on();
  bridge.player.place(id, M_PN);
  bridge.let_player_in({&id, 1});
}

std::vector<Diagnostic> Bridge::set_link_value(NodeId id, const LinkValue& value) {
  Impl& bridge = *impl_;
  bridge.expect_alive(id, "set_link_value");
  const Link* link = bridge.scene.link(id);
  PANTIN_EXPECTS(link != nullptr,
                 "set_link_value: node '" + bridge.scene.path(id) + "' has no link; set_link first");
  PANTIN_EXPECTS(value.size() == value_size(link->kind),
                 "set_link_value: a " + std::string{to_string(link->kind)} + " link has " +
                     std::to_string(value_size(link->kind)) + " number(s), not " +
                     std::to_string(value.size()));
  std::vector<Diagnostic> notes = bridge.set_link_value(id, value);
  if (value.size() == 1 && !has_error(notes)) bridge.set_followers(id, value[0], {}, notes);
  return notes;
}

void Bridge::Impl::set_followers(NodeId leader, double value, const std::unordered_set<NodeId>& except,
                                 std::vector<Diagnostic>& notes) {
  for (const Follower& follower : all_followers(followers, leader, except)) {
    const Link* following = scene.contains(follower.node) ? scene.link(follower.node) : nullptr;
    if (following == nullptr || !following->mimic || is_held_by_gear(follower.node)) continue;
    for (Diagnostic& said : set_link_value(follower.node, follower.multiplier * value + follower.offset))
      notes.push_back(std::move(said));
  }
}

Diagnostic Bridge::Impl::not_allowed(const Binding& binding) const {
  Diagnostic said =
      note(Severity::Error, binding.node, "its loop cannot be closed with this value; nothing is changed",
           "choose a value within its reach, or leave it to the others of its loop");
  said.subject = "joint '" + physics.joint(binding.joint).name + "'";
  return said;
}

std::vector<Diagnostic> Bridge::Impl::set_link_value(NodeId id, const LinkValue& value) {
  const Link* link = scene.link(id);
  const Binding* binding = find(id);
  if (binding == nullptr || binding->drive == Drive::Scene) {
    self->set_local(id, local_matrix(*link, value));
    scene.note_link_value(id, value);
  } else if (binding->drive == Drive::Physics && binding->tie.kind == JointTie::Kind::Link &&
             value.size() > 0) {
    if (!physics.try_joint_value(binding->joint, joint_numbers(value, binding->metres_per_value)))
      return {not_allowed(*binding)};
    sync_out(nullptr);
  } else if (value.size() > 0) {
    const Affine M_WN = scene.world(scene.parent(id)) * local_matrix(*link, value);
    std::vector<Diagnostic> notes = self->teleport(id, M_WN, TeleportVelocity::Keep);
    if (!has_error(notes)) scene.note_link_value(id, value);
    return notes;
  }
  return {};
}

}  // namespace pantin
