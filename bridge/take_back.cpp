// Physics -> Scene, and binding nodes that are not simulated.
#include <algorithm>

#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {

// Parents first: a child's way back begins in the frame of a parent that is on its own way back.
void Bridge::Impl::stop_simulating(std::span<Binding* const> taken, Drive drive, double blend_time) {
  std::unordered_map<const Binding*, RigidMotion> measured;
  std::vector<NodeId> tops;
  for (Binding* binding : taken) {
    measured[binding] = motion_of(*binding);
    tops.push_back(binding->node);
    note_link_value(*binding);
    binding->M_PN_rest = scene.local(binding->node);
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
  static_cast<void>(reconcile(tops));
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
  impl_->stop_simulating(taken, Drive::Scene, settings.blend_time);
  if (settings.blend_time == 0) impl_->write_scene(nullptr);
  return {};
}

std::vector<Diagnostic> Bridge::Impl::bind_to_scene(NodeId id, Scope scope, Drive drive) {
  forget_vanished();
  notice_moves();
  std::vector<NodeId> nodes = selected(id, scope);
  for (const Binding* binding : bound_in(id, scope)) {
    if (std::find(nodes.begin(), nodes.end(), binding->node) == nodes.end()) nodes.push_back(binding->node);
  }
  const std::unordered_set<NodeId> all{nodes.begin(), nodes.end()};
  std::vector<Diagnostic> notes;
  if (nodes.empty()) notes.push_back(note(Severity::Error, id, "it cannot be bound", "name a node below it"));
  for (const NodeId node : nodes) {
    const Binding* above = bound_above(node);
    const bool carried =
        above != nullptr && (above->drive == Drive::Physics || above->simulated_above != nullptr);
    if (drive == Drive::Static && carried && !all.contains(above->node)) {
      notes.push_back(note(Severity::Error, node, "it would be carried along by a simulated node above it",
                           "make it follow the scene instead of fixing it"));
    }
    if (find(node) == nullptr && polar(scene.world(node).linear()).singular) {
      notes.push_back(note(Severity::Error, node,
                           "its world matrix is singular, so no rigid body can follow it",
                           "give it and its ancestors scales that are not 0"));
    }
  }
  if (has_error(notes)) return notes;

  std::vector<Binding*> simulated, others;
  for (const NodeId node : nodes) {
    if (Binding* binding = find(node)) {
      std::erase(automatic, binding);
      (binding->drive == Drive::Physics ? simulated : others).push_back(binding);
      continue;
    }
    const Polar at = polar(scene.world(node).linear());
    Affine M_BN = Affine::Identity();
    M_BN.linear() = at.S;
    const DerivedMass mass = weigh(node, M_BN, HandOverSettings{}.density, &all);
    const Binding* above = bound_above(node);
    if (above != nullptr && (above->drive == Drive::Physics || above->simulated_above != nullptr)) {
      notes.insert(notes.end(), mass.notes.begin(), mass.notes.end());  // it loads what carries it
    }
    Binding& binding = bind(node, drive, at, RigidMotion{}, mass.mass);
    if (Binding* outer = bound_above(node); outer != nullptr && !all.contains(outer->node)) reweigh(outer);
    others.push_back(&binding);
  }
  for (Binding* binding : others) {
    binding->is_remembered = binding->is_remembered && binding->drive == drive;
    if (binding->drive != drive) binding->blend.reset();
    binding->drive = drive;
  }
  if (!simulated.empty()) stop_simulating(simulated, drive, 0);
  const std::vector<Diagnostic> more = reconcile(nodes);
  notes.insert(notes.end(), more.begin(), more.end());
  write_scene(nullptr);
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
