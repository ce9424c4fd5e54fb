// Physics -> Scene, and binding nodes that are not simulated.
#include <algorithm>

#include <pantin/bridge/bits.hpp>
#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {

// Parents first: a child's way back begins in the frame of a parent that is on its own way back.
std::vector<Diagnostic> Bridge::Impl::stop_simulating(std::span<Binding* const> taken, Drive drive,
                                                      double blend_time, std::span<const NodeId> tops) {
  // The bodies are what counts, also where the user has stepped physics without writing the scene.
  const auto is_behind = [this](const Binding* binding) {
    return !same_bits(physics.body(binding->body).X_WB(), binding->X_WB_written);
  };
  if (std::any_of(taken.begin(), taken.end(), is_behind)) sync_out(nullptr);
  std::unordered_map<const Binding*, RigidMotion> measured;
  for (Binding* binding : taken) {
    measured[binding] = motion_of(*binding);
    note_link_value(*binding);
    binding->M_PN_rest = scene.local(binding->node);
    if (player.is_carrier(binding->node)) player.place(binding->node, binding->M_PN_rest);
  }
  for (Binding* binding : taken) {
    binding->drive = drive;
    binding->is_remembered = false;
  }
  const std::vector<Binding*> affected = below(tops);
  link_up(affected);
  for (Binding* binding : affected) {
    if (binding->drive != Drive::Scene) continue;
    build_chain(*binding);
    const auto motion = measured.find(binding);
    if (motion == measured.end() || blend_time == 0 || !binding->motion->is_played()) continue;
    start_blend(*binding, motion->second, blend_time);
    build_chain(*binding);
  }
  std::vector<Diagnostic> notes = reconcile(tops);
  if (!has_error(notes)) return notes;
  for (Binding* binding : taken) {
    binding->drive = Drive::Physics;
    binding->blend.reset();
  }
  static_cast<void>(reconcile(tops));
  return notes;
}

std::vector<Diagnostic> Bridge::take_back(NodeId id, Scope scope, const TakeBackSettings& settings) {
  impl_->expect_alive(id, "take_back");
  if (const std::optional<SettingsProblem> problem = problem_with(settings)) {
    return {impl_->note(Severity::Error, id, problem->text, problem->remedy)};
  }
  impl_->forget_vanished();
  impl_->notice_moves();
  std::vector<Binding*> taken = impl_->bound_in(id, scope);
  std::erase_if(taken, [](const Binding* binding) { return binding->drive != Drive::Physics; });
  if (taken.empty()) return {};
  std::vector<NodeId> tops;
  for (const Binding* binding : taken) tops.push_back(binding->node);
  const std::vector<Diagnostic> notes =
      impl_->stop_simulating(taken, Drive::Scene, settings.blend_time, tops);
  if (settings.blend_time == 0) impl_->write_scene(nullptr);
  return notes;
}

std::vector<NodeId> Bridge::Impl::bindable(NodeId id, Scope scope, Drive drive,
                                           std::vector<Diagnostic>& notes) const {
  std::vector<NodeId> nodes = selected(id, scope);
  for (const Binding* binding : bound_in(id, scope)) {
    if (std::find(nodes.begin(), nodes.end(), binding->node) == nodes.end()) nodes.push_back(binding->node);
  }
  if (nodes.empty()) notes.push_back(note(Severity::Error, id, "it cannot be bound", "name a node below it"));
  for (const NodeId node : nodes) {
    const Binding* above = bound_above(node);
    const bool carried = above != nullptr && above->moves_with_physics() && !scene.is_above(id, above->node);
    if (drive == Drive::Static && carried) {
      notes.push_back(note(Severity::Error, node, "it would be carried along by a simulated node above it",
                           "make it follow the scene instead of fixing it"));
    }
    if (find(node) == nullptr && polar(scene.world(node).linear()).singular) {
      notes.push_back(note(Severity::Error, node,
                           "its world matrix is singular, so no rigid body can follow it",
                           "give it and its ancestors scales that are not 0"));
    }
  }
  return nodes;
}

void Bridge::Impl::bind_new(NodeId node, Drive drive, const std::unordered_set<NodeId>& all,
                            std::vector<Diagnostic>& notes) {
  const Polar at = polar(scene.world(node).linear());
  const DerivedMass mass = weigh(node, residual_of(at), HandOverSettings{}.density, &all);
  Binding* above = bound_above(node);
  if (above != nullptr && above->moves_with_physics()) {  // it loads what carries it
    notes.insert(notes.end(), mass.notes.begin(), mass.notes.end());
  }
  bind(node, drive, at, RigidMotion{}, mass.mass);
  if (above != nullptr && !all.contains(above->node)) reweigh(above);
}

std::vector<Diagnostic> Bridge::Impl::bind_to_scene(NodeId id, Scope scope, Drive drive) {
  forget_vanished();
  notice_moves();
  std::vector<Diagnostic> notes;
  const std::vector<NodeId> nodes = bindable(id, scope, drive, notes);
  if (has_error(notes)) return notes;
  const std::unordered_set<NodeId> all{nodes.begin(), nodes.end()};
  std::vector<Binding*> simulated;
  std::vector<std::pair<NodeId, std::optional<Drive>>> others;  // and what they were
  bool changes_writer = false;
  for (const NodeId node : nodes) {
    Binding* binding = find(node);
    if (binding == nullptr) {
      bind_new(node, drive, all, notes);
      others.emplace_back(node, std::nullopt);
      continue;
    }
    std::erase(automatic, binding);
    if (binding->drive == Drive::Physics) simulated.push_back(binding);
    if (binding->drive == Drive::Physics || binding->drive == drive) continue;
    others.emplace_back(node, binding->drive);
    changes_writer = true;
    binding->blend.reset();
    binding->is_remembered = false;
    binding->drive = drive;
  }
  const std::vector<Diagnostic> more = stop_simulating(simulated, drive, 0, nodes);
  notes.insert(notes.end(), more.begin(), more.end());
  if (has_error(notes)) {
    for (auto other = others.rbegin(); other != others.rend(); ++other) {
      if (other->second) find(other->first)->drive = *other->second;
      else unbind(*find(other->first));
    }
    static_cast<void>(reconcile(nodes));
    reweigh(bound_above(id));
    return notes;
  }
  if (changes_writer || !simulated.empty()) write_scene(nullptr);
  return notes;
}

std::vector<Diagnostic> Bridge::follow(NodeId id, Scope scope) {
  impl_->expect_alive(id, "follow");
  return impl_->bind_to_scene(id, scope, Drive::Scene);
}

std::vector<Diagnostic> Bridge::fix(NodeId id, Scope scope) {
  impl_->expect_alive(id, "fix");
  return impl_->bind_to_scene(id, scope, Drive::Static);
}

}  // namespace pantin
