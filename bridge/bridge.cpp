#include <pantin/bridge/bridge.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include <pantin/bridge/bridge_impl.hpp>
#include <pantin/scenegraph/expects.hpp>

namespace pantin {

std::optional<SettingsProblem> problem_with(const HandOverSettings& settings) {
  if (settings.density > 0 && std::isfinite(settings.density)) return std::nullopt;
  return SettingsProblem{
      ProblemCode::OutOfRange,
      "density is " + std::to_string(settings.density) + " kg/m^3; it must be above 0 and finite",
      "water has 1000"};
}

std::optional<SettingsProblem> problem_with(const TakeBackSettings& settings) {
  if (settings.blend_time >= 0 && std::isfinite(settings.blend_time)) return std::nullopt;
  return SettingsProblem{
      ProblemCode::OutOfRange,
      "blend time is " + std::to_string(settings.blend_time) + " s; it must be 0 or more and finite",
      "0 returns to the clip at once"};
}

Bridge::Impl::Impl(Scene& its_scene, PhysicsManager& its_physics, ClockSettings settings)
    : scene{its_scene}, physics{its_physics}, clock{settings, its_physics.time()} {
  physics.watch_stability(settings.watch_stability);
}

// Drivers in physics point to what the bindings own, so the bodies go with the bridge.
Bridge::Impl::~Impl() {
  for (const auto& [body, binding] : by_body) {
    if (physics.contains(body)) physics.remove(body);
  }
}

Bridge::Bridge(Scene& scene, PhysicsManager& physics, ClockSettings clock)
    : impl_{std::make_unique<Impl>(scene, physics, clock)} {
  impl_->self = this;
}
Bridge::~Bridge() = default;

void Bridge::Impl::expect_alive(NodeId id, const char* verb) const {
  PANTIN_EXPECTS(scene.contains(id), std::string{verb} + ": node id (index " + std::to_string(id.index) +
                                         ", generation " + std::to_string(id.generation) +
                                         ") is null or was removed; drop ids with their nodes");
}

Binding* Bridge::Impl::find(NodeId id) const {
  const auto found = bindings.find(id);
  return found == bindings.end() ? nullptr : found->second.get();
}

Binding* Bridge::Impl::bound_above(NodeId id) const {
  for (NodeId above = scene.parent(id); above; above = scene.parent(above)) {
    if (Binding* binding = find(above)) return binding;
  }
  return nullptr;
}

NodeId Bridge::Impl::bound_node_above(NodeId id) const {
  const Binding* binding = bound_above(id);
  return binding == nullptr ? NodeId{} : binding->node;
}

const std::vector<Binding*>& Bridge::Impl::ordered() {
  if (!order_is_stale_) return ordered_;
  ordered_.clear();
  for (const auto& [node, binding] : bindings) ordered_.push_back(binding.get());
  std::sort(ordered_.begin(), ordered_.end(), [this](const Binding* a, const Binding* b) {
    return scene.index_of(a->node) < scene.index_of(b->node);
  });
  order_is_stale_ = false;
  return ordered_;
}

std::vector<Binding*> Bridge::Impl::below(std::span<const NodeId> tops) const {
  std::vector<Binding*> found;
  std::unordered_set<NodeId> seen;
  for (const NodeId top : tops) {
    if (!scene.contains(top) || seen.contains(top)) continue;
    for (const NodeId id : scene.subtree(top)) {
      if (tops.size() > 1 && !seen.insert(id).second) continue;
      if (Binding* binding = find(id)) found.push_back(binding);
    }
  }
  if (tops.size() > 1) {
    std::sort(found.begin(), found.end(), [this](const Binding* a, const Binding* b) {
      return scene.index_of(a->node) < scene.index_of(b->node);
    });
  }
  return found;
}

Diagnostic Bridge::Impl::note(Severity severity, NodeId id, std::string problem, std::string remedy) const {
  const bool root = id == scene.root();
  return {severity, root ? std::string{"/"} : scene.path(id),
          root ? std::string{"the scene root"} : "node '" + scene.name(id) + "'", std::move(problem),
          std::move(remedy)};
}

RigidMotion Bridge::Impl::motion_of(const Binding& binding) const {
  const RigidBody body = physics.body(binding.body);
  return {.X_AB = body.X_WB(), .v_AB = body.v_WB(), .w_AB = body.w_WB()};
}

bool Bridge::Impl::is_played_between(NodeId from, const Binding* above) const {
  for (NodeId id = from; id && (above == nullptr || id != above->node); id = scene.parent(id)) {
    if (is_played(id)) return true;
  }
  return false;
}

// What users ask

std::optional<Drive> Bridge::drive_of(NodeId id) const {
  const Binding* binding = impl_->find(id);
  return binding == nullptr ? std::nullopt : std::optional{binding->drive};
}

BodyId Bridge::body_of(NodeId id) const {
  const Binding* binding = impl_->find(id);
  return binding == nullptr ? BodyId{} : binding->body;
}

void Bridge::leave_joints_free(bool free) { impl_->free_joints = free; }

JointId Bridge::joint_of(NodeId id) const {
  const Binding* binding = impl_->find(id);
  return binding == nullptr ? JointId{} : binding->joint;
}

NodeId Bridge::node_of(BodyId id) const {
  const auto found = impl_->by_body.find(id);
  return found == impl_->by_body.end() ? NodeId{} : found->second->node;
}

std::vector<NodeId> Bridge::bound() const {
  std::vector<NodeId> ids;
  for (const Binding* binding : impl_->ordered()) ids.push_back(binding->node);
  return ids;
}

Affine Bridge::residual(NodeId id) const {
  const Binding* binding = impl_->find(id);
  PANTIN_EXPECTS(binding != nullptr, "residual: the node is not bound; ask drive_of() first");
  return binding->M_BN;
}

void Bridge::set_node_body(NodeId id, NodeBody body) {
  impl_->expect_alive(id, "set_node_body");
  impl_->node_bodies.insert_or_assign(id, std::move(body));
  Binding* bound = impl_->find(id);
  impl_->reweigh(bound != nullptr ? bound : impl_->bound_above(id));
}

const NodeBody* Bridge::node_body(NodeId id) const {
  const auto found = impl_->node_bodies.find(id);
  return found == impl_->node_bodies.end() ? nullptr : &found->second;
}

bool Bridge::is_played(NodeId id) const { return impl_->is_played(id); }
const Player& Bridge::player() const noexcept { return impl_->player; }
double Bridge::time() const noexcept { return impl_->physics.time(); }
const Clock& Bridge::clock() const noexcept { return impl_->clock; }
void Bridge::set_step(double step) { impl_->clock.set_step(step); }
void Bridge::set_stepping(Stepping stepping) { impl_->clock.set_stepping(stepping); }
void Bridge::sync_out() { impl_->sync_out(nullptr); }

}  // namespace pantin
