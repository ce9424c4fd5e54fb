// Bodies that the bridge binds by itself: animated parents that carry the joint of a simulated node.
#include <algorithm>

#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {

// The joint of a node whose parent is animated, but not bound, needs a body to hang on.
std::vector<NodeId> Bridge::Impl::bind_carriers(std::span<Binding* const> affected) {
  std::vector<NodeId> carriers;
  for (const Binding* binding : affected) {
    if (binding->drive != Drive::Physics) continue;
    const Link* link = scene.link(binding->node);
    const NodeId parent = scene.parent(binding->node);
    if (link == nullptr || link->kind == LinkKind::Free || parent == scene.root() || find(parent) != nullptr)
      continue;
    if (!is_played_between(parent, binding->above)) continue;
    const Polar at = polar(scene.world(parent).linear());
    if (at.singular) continue;
    Binding& carrier =
        bind(parent, Drive::Scene, at, RigidMotion{}, weigh(parent, residual_of(at), binding->density).mass);
    automatic.push_back(&carrier);
    reweigh(bound_above(parent));
    carriers.push_back(parent);
  }
  return carriers;
}

Binding* Bridge::Impl::idle_carrier() const {
  const auto idle = std::find_if(automatic.begin(), automatic.end(), [this](const Binding* binding) {
    const std::vector<JointId> joints = physics.joints_of(binding->body);
    return std::none_of(joints.begin(), joints.end(),
                        [&](JointId id) { return physics.joint(id).a == binding->body; });
  });
  return idle == automatic.end() ? nullptr : *idle;
}

void Bridge::Impl::drop_idle_carriers() {
  while (Binding* idle = idle_carrier()) {
    const NodeId id = idle->node;
    unbind(*idle);
    reweigh(bound_above(id));
    static_cast<void>(settle({&id, 1}));
  }
}

}  // namespace pantin
