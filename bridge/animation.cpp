// Clips on nodes, and what the user sets by hand.
#include <algorithm>
#include <unordered_set>

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
  settings.begin += bridge.physics.time();
  if (std::string problem = pantin::problem_with(settings, clip); !problem.empty())
    refuse(std::move(problem), "");
  std::vector<NodeId> nodes;
  for (const Track& track : clip.tracks) {
    const NodeId node = targets[track.target];
    if (node && std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
  }
  for (const NodeId node : nodes) {
    const Player* other = bridge.player(node);
    if (other == nullptr) continue;
    notes.push_back(bridge.note(
        Severity::Error, node,
        "clip '" + clip.name + "' would animate it, but clip '" + other->clip().name + "' does already",
        "stop playing it first"));
  }
  if (has_error(notes) || nodes.empty()) return notes;
  bridge.players.push_back(std::make_unique<Player>(bridge.scene, clip, std::move(targets), settings));
  for (const NodeId node : nodes) bridge.player_of[node] = bridge.players.back().get();
  bridge.let_players_in(nodes);
  return notes;
}

// Nodes have got, or lost, a player: held ones stay where they are, the others are where the clip says at
// once.
void Bridge::Impl::let_players_in(std::span<const NodeId> nodes) {
  for (const NodeId node : nodes) {
    if (const Binding* binding = find(node)) hold_players(*binding);
    watched.erase(node);
  }
  write_scene(nullptr);
  static_cast<void>(reconcile(nodes));
  for (Binding* binding : below(nodes)) {
    if (binding->drive == Drive::Scene) announce(*binding);
  }
  finished_players.clear();
  write_scene(nullptr);
}

void Bridge::stop_playing(NodeId id) {
  impl_->expect_alive(id, "stop_playing");
  if (impl_->player(id) == nullptr) return;
  impl_->notice_moves();
  impl_->drop_player_of(id);
  // It stays where it is, also on its way back to the clip.
  if (Binding* binding = impl_->find(id); binding != nullptr && binding->blend) {
    binding->blend.reset();
    binding->is_remembered = false;
  }
  impl_->let_players_in({&id, 1});
}

void Bridge::Impl::drop_player_of(NodeId id) {
  const auto played = player_of.find(id);
  if (played == player_of.end()) return;
  Player* player = played->second;
  player->hold(id);
  player_of.erase(played);
  const bool used = std::any_of(player_of.begin(), player_of.end(),
                                [player](const auto& entry) { return entry.second == player; });
  if (used) return;
  // Trajectories that still name it are built anew by the reconcile that follows; until then it must live on.
  const auto at = std::find_if(players.begin(), players.end(),
                               [player](const std::unique_ptr<Player>& p) { return p.get() == player; });
  finished_players.push_back(std::move(*at));
  players.erase(at);
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
}

void Bridge::set_link_value(NodeId id, const LinkValue& value) {
  Impl& bridge = *impl_;
  bridge.expect_alive(id, "set_link_value");
  const Link* link = bridge.scene.link(id);
  PANTIN_EXPECTS(link != nullptr,
                 "set_link_value: node '" + bridge.scene.path(id) + "' has no link; set_link first");
  PANTIN_EXPECTS(value.size() == value_size(link->kind),
                 "set_link_value: a " + std::string{to_string(link->kind)} + " link has " +
                     std::to_string(value_size(link->kind)) + " number(s), not " +
                     std::to_string(value.size()));
  bridge.set_link_value(id, value);
  if (value.size() != 1) return;
  for (const Follower& follower : all_followers(bridge.followers, id)) {
    const Link* following = bridge.scene.contains(follower.node) ? bridge.scene.link(follower.node) : nullptr;
    if (following != nullptr && following->mimic)
      bridge.set_link_value(follower.node, follower.multiplier * value[0] + follower.offset);
  }
}

void Bridge::Impl::set_link_value(NodeId id, const LinkValue& value) {
  const Link* link = scene.link(id);
  const Binding* binding = find(id);
  if (binding == nullptr || binding->drive == Drive::Scene) {
    self->set_local(id, local_matrix(*link, value));
    scene.note_link_value(id, value);
  } else if (binding->drive == Drive::Physics && binding->tie.kind == Tie::Kind::Link && value.size() > 0) {
    physics.set_joint_value(binding->joint, joint_numbers(value, binding->metres_per_value));
    sync_out(nullptr);
  } else if (value.size() > 0) {
    const Affine M_WN = scene.world(scene.parent(id)) * local_matrix(*link, value);
    const std::vector<Diagnostic> notes = self->teleport(id, M_WN, TeleportVelocity::Keep);
    PANTIN_EXPECTS(!has_error(notes), "set_link_value: " + to_string(notes.back()));
    scene.note_link_value(id, value);
  }
}

}  // namespace pantin
