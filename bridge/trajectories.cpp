// Trajectories of animated nodes: which players and matrices they follow from, and how they go on when a node
// was taken back or moved by the user.
#include <algorithm>

#include <pantin/bridge/bits.hpp>
#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {
namespace {

constexpr double kSameResidual = 1e-12;  // relative: what the product along a chain rounds

}  // namespace

std::vector<ChainPart> Bridge::Impl::chain_to(NodeId id, const Binding* above) const {
  std::vector<ChainPart> parts;
  for (NodeId at = id; at && (above == nullptr || at != above->node); at = scene.parent(at)) {
    ChainPart part{.node = at};
    const Binding* binding = find(at);
    const bool stands = binding != nullptr && binding->drive == Drive::Static;
    if (!stands && is_played(at)) part.player = &player;
    if (binding != nullptr && binding->blend) part.blend = &*binding->blend;
    if (part.player == nullptr)
      part.rest = constant_motion(part.blend ? binding->M_PN_rest : scene.local(at));
    parts.push_back(part);
  }
  std::reverse(parts.begin(), parts.end());
  return parts;
}

// Goes on from an animated body above that does not move, so that long chains of them cost one product each.
void Bridge::Impl::build_chain(Binding& binding) const {
  const Binding* above = binding.above;
  const bool goes_on = above != nullptr && above->drive == Drive::Scene && !above->motion->is_played();
  Affine M_FA = Affine::Identity();
  if (goes_on) M_FA.affine() = above->motion->affine(0, Side::After).value;
  else if (binding.simulated_above != nullptr) M_FA = binding.simulated_above->M_BN;
  binding.motion->set_chain(M_FA, chain_to(binding.node, goes_on ? above : binding.simulated_above));
}

SplitMotion Bridge::Impl::world_motion(NodeId id) const {
  const Binding* above = bound_above(id);
  while (above != nullptr && above->drive != Drive::Physics) above = above->above;
  bool moves = false;
  for (NodeId at = id; at && !moves && (above == nullptr || at != above->node); at = scene.parent(at)) {
    const Binding* binding = find(at);
    moves = is_played(at) || (binding != nullptr && binding->blend);
  }
  if (!moves && above == nullptr) return split(constant_motion(scene.world(id)));
  NodeMotion motion;
  motion.set_chain(above == nullptr ? Affine::Identity() : above->M_BN, chain_to(id, above));
  const double now = physics.time();
  SplitMotion M = motion.split_at(now, motion.begins_at(now) ? Side::After : Side::Before);
  if (above != nullptr) M.X = composed(motion_of(*above), M.X);
  return M;
}

void Bridge::Impl::start_blend(Binding& binding, const RigidMotion& X_WB, double blend_time) {
  const double now = physics.time();
  const Binding* above = binding.simulated_above;
  const RigidMotion X_FB = above == nullptr ? X_WB : relative_motion(motion_of(*above), X_WB);
  const RigidMotion X_FP = split(binding.motion->parent(now, Side::After)).X;
  const SplitMotion base = binding.motion->in_parent(now, Side::After);
  binding.blend.emplace(Fade::Critical, now, blend_time, relative_motion(X_FP, X_FB), base.X);
  binding.blend->set_residual(binding.M_BN.linear(), base.S);
}

void Bridge::Impl::blend_anew(Binding& binding, const RigidMotion& X_WB) {
  const double span = binding.blend->span();
  binding.blend.reset();
  binding.M_PN_rest = scene.local(binding.node);
  link_up(below({&binding.node, 1}));
  build_chain(binding);
  start_blend(binding, X_WB, span);
}

void Bridge::Impl::finish_blends() {
  const double now = physics.time();
  std::vector<NodeId> done;
  for (const Binding* binding : ordered()) {
    if (binding->blend && !binding->blend->active(now, Side::After)) done.push_back(binding->node);
  }
  for (const NodeId id : done) {
    Binding& binding = *find(id);
    if (!is_played(id)) scene.set_local(id, binding.M_PN_rest);
    binding.blend.reset();
  }
  if (!done.empty()) static_cast<void>(reconcile(done));
}

// An animated body may be stretched by its clip; its mass is deformed along.
void Bridge::Impl::rebake_residuals() {
  for (Binding* binding : ordered()) {
    if (binding->drive != Drive::Scene) continue;
    const SplitMotion motion = binding->motion->split_at(physics.time(), Side::After);
    const Matrix3& before = binding->M_BN.linear();
    if (motion.singular || (motion.S - before).norm() <= kSameResidual * before.norm()) continue;
    binding->own_mass = deformed(motion.S * before.inverse(), binding->own_mass);
    binding->M_BN = Affine::Identity();
    binding->M_BN.linear() = motion.S;
    const bool weighs = binding->own_mass.mass > 0;
    if (weighs && !problem_with(binding->own_mass, InertiaCheck::Solvable))
      set_mass(*binding, binding->own_mass);
  }
}

// What the user may move under an animated body: everything up to the next bound node, which has its own
// watch.
void Bridge::Impl::watch(const Binding& binding) {
  if (binding.drive == Drive::Physics) return;
  for (NodeId id = binding.node; id; id = scene.parent(id)) {
    const Binding* bound = find(id);
    if (bound != nullptr && bound != &binding) return;
    const bool free = !is_played(id) && (bound == nullptr || !bound->blend);
    if (free) watched[id] = scene.local(id);
    else watched.erase(id);
  }
}

void Bridge::Impl::notice_moves() {
  std::vector<NodeId> moved;
  for (auto at = watched.begin(); at != watched.end();) {
    if (!scene.contains(at->first)) {
      at = watched.erase(at);
      continue;
    }
    const Affine now = scene.local(at->first);
    if (!same_bits(now, at->second)) {
      at->second = now;
      moved.push_back(at->first);
    }
    ++at;
  }
  for (Binding* binding : below(moved)) {
    if (binding->drive != Drive::Scene) continue;
    const RigidMotion before = binding->motion->split_at(physics.time(), Side::After).X;
    build_chain(*binding);
    const Pose after = binding->motion->split_at(physics.time(), Side::After).X.X_AB;
    if (!same_bits(after, before.X_AB) && !binding->moved_from) binding->moved_from = before;
  }
}

// The velocity of what the user moved is the difference of poses over the time of this advance.
void Bridge::Impl::start_moves(double begin, double end) {
  for (Binding* binding : ordered()) {
    if (binding->drive != Drive::Scene) continue;
    binding->motion->set_move(std::nullopt);
    if (!binding->moved_from) continue;
    const RigidMotion base = binding->motion->split_at(begin, Side::After).X;
    binding->motion->set_move(Offset{Fade::Linear, begin, end - begin, *binding->moved_from, base});
    binding->moved_from.reset();
    if (!physics.joints_of(binding->body).empty()) announce(*binding);
  }
}

// What hangs on it feels the jump in velocity as an impulse.
void Bridge::Impl::announce(Binding& binding) {
  if (physics.body(binding.body).kind() == BodyKind::Animated) {
    physics.make_animated(binding.body, std::make_unique<NodeDriver>(*binding.motion));
  } else if (binding.tie.kind == JointTie::Kind::Driven) {
    const RigidBody body = physics.body(binding.body);
    const Vector3 v_WBcm = body.v_WBcm(), w_WB = body.w_WB();
    physics.set_velocity(binding.body, v_WBcm, w_WB);
  }
}

}  // namespace pantin
