// Physics -> scene: M_PN = inverse(M_WP) * X_WB * M_BN, parents first, with the parents' matrices as they
// have just been written; and players before it, at physics time.
#include <pantin/bridge/bits.hpp>
#include <pantin/bridge/bridge_impl.hpp>
#include <pantin/bridge/links_to_joints.hpp>

namespace pantin {
namespace {

Affine affine_of(const Pose& X) {
  Affine M = Affine::Identity();
  M.linear() = X.rotation();
  M.translation() = X.p;
  return M;
}

}  // namespace

bool Bridge::Impl::is_below_written(const Binding& binding) {
  return binding.above != nullptr && (binding.above->is_written() || binding.above->below_written);
}

// Below a written node the scene is not up to date yet, so the product goes on from the bound node above.
Affine Bridge::Impl::parent_world(const Binding& binding) const {
  const NodeId parent = scene.parent(binding.node);
  if (!binding.below_written) return scene.world(parent);
  std::vector<NodeId> between;
  for (NodeId id = parent; id != binding.above->node; id = scene.parent(id)) between.push_back(id);
  Affine M_WP = binding.above->M_WN;
  for (auto id = between.rbegin(); id != between.rend(); ++id) M_WP = M_WP * scene.local(*id);
  return M_WP;
}

Affine Bridge::Impl::world_of(const Binding& binding) const {
  if (!binding.below_written) return scene.world(binding.node);
  return parent_world(binding) * scene.local(binding.node);
}

void Bridge::Impl::sync_out(std::vector<Diagnostic>* notes) {
  std::vector<NodeLocal> writes;
  std::vector<const Binding*> written;
  for (Binding* binding : ordered()) {
    binding->below_written = is_below_written(*binding);
    if (!binding->is_written()) {
      binding->M_WN = world_of(*binding);
      continue;
    }
    const Pose X_WB = physics.body(binding->body).X_WB();
    const Affine M_WP = parent_world(*binding);
    if (same_bits(X_WB, binding->X_WB_written) && same_bits(M_WP, binding->M_WP_written)) continue;
    binding->X_WB_written = X_WB;
    binding->M_WP_written = M_WP;
    const Affine M_WN = affine_of(X_WB) * binding->M_BN;
    const std::optional<Affine> M_PN = solve_local(M_WP, M_WN);
    if (!M_PN) {
      binding->M_WN = M_WP * scene.local(binding->node);
      if (notes == nullptr) continue;
      notes->push_back(note(Severity::Warning, binding->node,
                            "the world matrix above it has become singular; it keeps its last local matrix",
                            "give its ancestors scales that are not 0"));
      continue;
    }
    binding->M_WN = M_WN;
    writes.push_back({binding->node, *M_PN});
    written.push_back(binding);
  }
  scene.set_locals(writes);
  for (const Binding* binding : written) note_link_value(*binding);
}

// Somebody may have gone back to a snapshot.
void Bridge::Impl::play_on() {
  const double now = physics.time();
  if (now < player.time()) player.set_time(now);
  if (now == player.time()) return;
  player.advance_to(now);
  passed.insert(passed.end(), player.events().begin(), player.events().end());
}

// Animated links that mimic a simulated one. Where it stands is known from physics before the scene is
// written, and what the user set stays until it moves.
void Bridge::Impl::lead_followers() {
  if (followers.empty()) return;
  std::unordered_set<NodeId> others;  // move by themselves
  for (const auto& [leader, direct] : followers) {
    for (const Follower& follower : direct) {
      const Binding* binding = find(follower.node);
      const bool is_animated = binding == nullptr || binding->drive == Drive::Scene;
      if (!is_animated || is_played(follower.node)) others.insert(follower.node);
    }
  }
  for (const auto& [leader, direct] : followers) {
    const Binding* binding = find(leader);
    const Link* link = scene.contains(leader) ? scene.link(leader) : nullptr;
    if (binding == nullptr || link == nullptr || link->value.size() != 1) continue;
    if (binding->drive != Drive::Physics || binding->tie.kind != JointTie::Kind::Link) continue;
    if (!physics.contains(binding->joint)) continue;
    const LinkValue value =
        link_value(physics.joint_value(binding->joint), binding->metres_per_value, link->value);
    std::vector<Diagnostic> none;  // nothing can be wrong with animated links
    if (value != link->value) set_followers(leader, value[0], others, none);
  }
}

void Bridge::Impl::write_scene(std::vector<Diagnostic>* notes) {
  finish_blends();
  play_on();
  player.apply(scene);
  lead_followers();
  rebake_residuals();
  sync_out(notes);
}

}  // namespace pantin
