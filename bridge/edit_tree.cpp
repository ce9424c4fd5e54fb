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
  for (auto binding = released.rbegin(); binding != released.rend(); ++binding) {
    tops.push_back((*binding)->node);
    bridge.unbind(**binding);
  }
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
    bridge.drop_player_of(node);
    bridge.node_bodies.erase(node);
    bridge.watched.erase(node);
  }
  bridge.scene.remove(id);
  bridge.finished_players.clear();
  bridge.reweigh(above);
  bridge.drop_idle_carriers();
}

// The joint frame of a link stays where it is in the world: M_QJ = inverse(M_WQ) * M_WP * M_PJ, Q the new
// parent.
std::vector<Diagnostic> Bridge::reparent(NodeId id, NodeId parent) {
  Impl& bridge = *impl_;
  Scene& scene = bridge.scene;
  bridge.expect_alive(id, "reparent");
  bridge.expect_alive(parent, "reparent to");
  bridge.forget_vanished();
  bridge.notice_moves();
  std::vector<Diagnostic> notes;
  const Affine M_WQ = scene.world(parent);
  if (!solve_local(M_WQ, scene.world(id))) {
    notes.push_back(bridge.note(Severity::Error, id,
                                "its new parent '" + scene.path(parent) + "' has a singular world matrix",
                                "give the parent a scale that is not 0"));
    return notes;
  }
  std::optional<Link> link;
  if (const Link* old = scene.link(id)) {
    link = *old;
    const Affine M_WP = scene.world(scene.parent(id));
    const std::optional<Affine> M_QJ = solve_local(M_WQ, M_WP * link->M_PJ);
    if (M_QJ) link->M_PJ = *M_QJ;
    if (const std::string problem = pantin::problem_with(*link); !M_QJ || !problem.empty()) {
      notes.push_back(bridge.note(Severity::Error, id,
                                  "its link cannot be re-based to the new parent: " + problem,
                                  "clear the link first"));
      return notes;
    }
  }
  Binding* binding = bridge.find(id);
  std::optional<RigidMotion> on_its_way;
  if (binding != nullptr && binding->blend) {
    on_its_way = binding->motion->split_at(bridge.physics.time(), Side::After).X;
    if (binding->simulated_above)
      on_its_way = composed(bridge.motion_of(*binding->simulated_above), *on_its_way);
  }
  const NodeId above_before = bridge.bound_node_above(id);
  scene.set_parent(id, parent, Keep::World);
  bridge.order_is_stale();
  if (link) {
    const Affine M_QN = scene.local(id);
    scene.set_link(id, *link);
    scene.set_local(id, M_QN);
  }
  if (on_its_way) bridge.blend_anew(*binding, *on_its_way);
  if (bridge.player(id) != nullptr) {
    notes.push_back(bridge.note(Severity::Warning, id,
                                "a clip animates it with values made for its old parent",
                                "stop playing it to keep it where it is"));
  }
  const std::vector<Diagnostic> more = bridge.reconcile({&id, 1});
  notes.insert(notes.end(), more.begin(), more.end());
  const NodeId above = bridge.bound_node_above(id);
  bridge.reweigh(bridge.find(above_before));
  if (above != above_before) bridge.reweigh(bridge.find(above));
  return notes;
}

}  // namespace pantin
