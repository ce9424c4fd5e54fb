// Making and dropping bodies of nodes.
#include <algorithm>

#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {
namespace {

BodyKind kind_at_birth(Drive drive) {
  return drive == Drive::Physics ? BodyKind::Simulated : BodyKind::Static;
}

}  // namespace

RigidBodySettings Bridge::Impl::body_settings(NodeId id, Drive drive, const Polar& at,
                                              const RigidMotion& motion, const MassProperties& mass) const {
  RigidBodySettings settings;
  settings.name = scene.name(id);
  settings.kind = kind_at_birth(drive);
  settings.X_WB = {scene.world(id).translation(), at.q};
  settings.v_WBcm = motion.v_AB + motion.w_AB.cross(at.q * mass.p_BBcm);
  settings.w_WB = motion.w_AB;
  settings.inertia_check = InertiaCheck::Solvable;
  // A mass that no body has may be sound together with what the node is fixed to: assign_masses judges that.
  if (!problem_with(mass, InertiaCheck::Solvable)) settings.mass = mass;
  else settings.mass = {0, Vector3::Zero(), Matrix3::Zero()};
  return settings;
}

// An animated body is born static: its trajectory depends on what else is bound, which reconcile looks at.
Binding& Bridge::Impl::bind(NodeId id, Drive drive, const Polar& at, const RigidMotion& motion,
                            const MassProperties& mass) {
  auto binding = std::make_unique<Binding>();
  binding->node = id;
  binding->drive = drive;
  binding->M_BN = residual_of(at);
  binding->own_mass = mass;
  binding->M_WN = scene.world(id);
  binding->body = physics.add(body_settings(id, drive, at, motion, mass));
  Binding& bound = *binding;
  by_body[bound.body] = &bound;
  bindings[id] = std::move(binding);
  order_is_stale_ = true;
  return bound;
}

void Bridge::Impl::unbind(Binding& binding) {
  const NodeId id = binding.node;
  player.release(id);
  if (physics.contains(binding.body)) physics.remove(binding.body);
  by_body.erase(binding.body);
  std::erase(sharing, &binding);
  std::erase(automatic, &binding);
  bindings.erase(id);
  order_is_stale_ = true;
}

// Nodes that were removed from the scene directly, with all below them.
void Bridge::Impl::forget_vanished() {
  std::vector<NodeId> bound;
  for (const auto& [node, binding] : bindings) {
    if (!scene.contains(node)) bound.push_back(node);
  }
  for (const NodeId node : bound) unbind(*find(node));
  player.stop_removed(scene);
  if (bound.empty()) return;
  for (const NodeId node : bound) node_bodies.erase(node);
  const NodeId everything = scene.root();
  static_cast<void>(reconcile({&everything, 1}));
}

}  // namespace pantin
