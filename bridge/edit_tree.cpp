// Changing the hierarchy under bound nodes.
#include <algorithm>

#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {

void Bridge::release(NodeId id, Scope scope) {
  Impl& bridge = *impl_;
  bridge.expect_alive(id, "release");
  bridge.forget_vanished();
  bridge.notice_moves();
  std::vector<Binding*> released = bridge.bound_in(id, scope);
  if (released.empty()) return;
  std::vector<NodeId> tops;
  for (const Binding* binding : released) tops.push_back(binding->node);
  for (auto binding = released.rbegin(); binding != released.rend(); ++binding) bridge.unbind(**binding);
  static_cast<void>(bridge.reconcile(tops));
  bridge.reweigh(bridge.bound_above(id));
}

void Bridge::remove(NodeId id) {
  Impl& bridge = *impl_;
  bridge.expect_alive(id, "remove");
  bridge.forget_vanished();
  bridge.notice_moves();
  Binding* above = bridge.bound_above(id);
  std::vector<Binding*> bound = bridge.below({&id, 1});
  for (auto binding = bound.rbegin(); binding != bound.rend(); ++binding) bridge.unbind(**binding);
  for (const NodeId node : bridge.scene.subtree(id)) {
    bridge.player.stop(node);
    bridge.node_bodies.erase(node);
    bridge.watched.erase(node);
  }
  bridge.scene.remove(id);
  bridge.reweigh(above);
  bridge.drop_idle_carriers();
}

// A static node's body would stay where it is while its node went along.
void Bridge::Impl::refuse_statics_under(NodeId parent, NodeId id, std::vector<Diagnostic>& notes) const {
  const Binding* above = find(parent) != nullptr ? find(parent) : bound_above(parent);
  if (above == nullptr || !above->moves_with_physics()) return;
  for (const Binding* binding : below({&id, 1})) {
    if (binding->drive != Drive::Static || binding->simulated_above != nullptr) continue;
    notes.push_back(note(Severity::Error, binding->node,
                         "it is static and would be carried along by a simulated node above it",
                         "release it, or make it follow the scene"));
  }
}

// The joint frame of a link stays where it is in the world: M_QJ = inverse(M_WQ) * M_WP * M_PJ, Q the new
// parent.
std::optional<Link> Bridge::Impl::rebased_link(NodeId id, NodeId parent,
                                               std::vector<Diagnostic>& notes) const {
  const Link* old = scene.link(id);
  if (old == nullptr) return std::nullopt;
  Link link = *old;
  const std::optional<Affine> M_QJ =
      solve_local(scene.world(parent), scene.world(scene.parent(id)) * old->M_PJ);
  if (M_QJ) link.M_PJ = *M_QJ;
  const std::string problem = pantin::problem_with(link);
  if (M_QJ && problem.empty()) return link;
  notes.push_back(note(Severity::Error, id, "its link cannot be re-based to the new parent: " + problem,
                       "clear the link first"));
  return std::nullopt;
}

void Bridge::Impl::replace_link(NodeId id, const std::optional<Link>& link, const Affine& M_PN) {
  if (link) scene.set_link(id, *link);
  scene.set_local(id, M_PN);
}

std::vector<Diagnostic> Bridge::reparent(NodeId id, NodeId parent) {
  Impl& bridge = *impl_;
  Scene& scene = bridge.scene;
  bridge.expect_alive(id, "reparent");
  bridge.expect_alive(parent, "reparent to");
  bridge.forget_vanished();
  bridge.notice_moves();
  std::vector<Diagnostic> notes;
  if (!solve_local(scene.world(parent), scene.world(id))) {
    notes.push_back(bridge.note(Severity::Error, id,
                                "its new parent '" + scene.path(parent) + "' has a singular world matrix",
                                "give the parent a scale that is not 0"));
    return notes;
  }
  bridge.refuse_statics_under(parent, id, notes);
  const std::optional<Link> link = bridge.rebased_link(id, parent, notes);
  if (has_error(notes)) return notes;
  Binding* binding = bridge.find(id);
  std::optional<RigidMotion> on_its_way;
  if (binding != nullptr && binding->blend) {
    on_its_way = binding->motion->split_at(bridge.physics.time(), Side::After).X;
    const Binding* carrier = binding->simulated_above;
    if (carrier != nullptr) on_its_way = composed(bridge.motion_of(*carrier), *on_its_way);
  }
  const NodeId above_before = bridge.bound_node_above(id), parent_before = scene.parent(id);
  const Affine M_PN = scene.local(id);
  const Link* link_before = scene.link(id);
  const std::optional<Link> old_link = link_before ? std::optional{*link_before} : std::nullopt;
  scene.set_parent(id, parent, Keep::World);
  bridge.order_is_stale();
  bridge.replace_link(id, link, scene.local(id));
  if (on_its_way) bridge.blend_anew(*binding, *on_its_way);
  if (bridge.is_played(id)) {
    notes.push_back(bridge.note(Severity::Warning, id,
                                "a clip animates it with values made for its old parent",
                                "stop playing it to keep it where it is"));
  }
  const std::vector<Diagnostic> more = bridge.reconcile({&id, 1});
  notes.insert(notes.end(), more.begin(), more.end());
  if (has_error(notes)) {
    scene.set_parent(id, parent_before, Keep::Local);
    bridge.replace_link(id, old_link, M_PN);
    static_cast<void>(bridge.reconcile({&id, 1}));
    return notes;
  }
  const NodeId above = bridge.bound_node_above(id);
  bridge.reweigh(bridge.find(above_before));
  if (above != above_before) bridge.reweigh(bridge.find(above));
  return notes;
}

}  // namespace pantin
