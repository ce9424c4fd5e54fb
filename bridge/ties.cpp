// The one joint by which a bound node hangs on what is above it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <pantin/bridge/bridge_impl.hpp>
#include <pantin/bridge/links_to_joints.hpp>
#include <pantin/physics/constraints/driven.hpp>

namespace pantin {
namespace {

constexpr double kMisfit = 1e-6;  // of a link's local matrix: above it, the user is told

/// Whether an angle of the value is beyond half a turn, so that physics cannot see it in the poses. A screw's
/// turns are seen in its place.
bool has_turns(LinkKind kind, const LinkValue& value) {
  const auto beyond = [&value](int i) { return std::abs(value[i]) > std::numbers::pi; };
  switch (kind) {
    case LinkKind::Pivot:
    case LinkKind::Cylindrical:
    case LinkKind::Screw:
      return beyond(0);
    case LinkKind::Universal:
      return beyond(0) || beyond(1);
    case LinkKind::Planar:
      return beyond(2);
    default:
      return false;
  }
}

void fill_in(const NodeBody& body, LinkKind kind, JointDefinition& joint) {
  joint.damping.fill(body.joint_damping);
  joint.strength = body.joint_strength;
  for (std::size_t i = 0; i < static_cast<std::size_t>(limit_count(kind)); ++i) {
    joint.axes[i].friction = body.joint_friction;
  }
}

}  // namespace

JointTie Bridge::Impl::wanted_tie(const Binding& binding) const {
  if (binding.drive == Drive::Scene && binding.simulated_above != nullptr) {
    return {JointTie::Kind::Driven, binding.simulated_above->body, LinkKind::Fixed};
  }
  const Link* link = scene.link(binding.node);
  if (binding.drive != Drive::Physics || link == nullptr || link->kind == LinkKind::Free) return {};
  if (binding.is_broken) return {};
  return {JointTie::Kind::Link, binding.above == nullptr ? BodyId{} : binding.above->body, link->kind};
}

void Bridge::Impl::untie(Binding& binding) {
  if (binding.joint && physics.contains(binding.joint)) physics.remove(binding.joint);
  binding.joint = {};
  binding.tie = {};
}

// Joints that physics has taken out: their nodes go on without, until they are handed over anew.
void Bridge::Impl::forget_broken(std::span<const JointId> broken, std::vector<Diagnostic>& notes) {
  for (const JointId joint : broken) {
    const auto found = std::find_if(bindings.begin(), bindings.end(),
                                    [&](const auto& b) { return b.second->joint == joint; });
    if (found == bindings.end()) continue;
    Binding& binding = *found->second;
    binding.joint = {};
    binding.tie = {};
    binding.is_broken = true;
    notes.push_back(note(Severity::Warning, binding.node,
                         "its joint bore more than its strength and broke; the node moves on without it",
                         "take it back and hand it over again to join it anew"));
  }
}

void Bridge::Impl::tie(Binding& binding, std::vector<Diagnostic>& notes) {
  const JointTie wanted = wanted_tie(binding);
  if (wanted.kind == JointTie::Kind::None) return;
  binding.tie = wanted;
  if (wanted.kind == JointTie::Kind::Link) return tie_by_link(binding, notes);
  binding.joint = physics.add(DrivenSettings{.name = scene.name(binding.node),
                                             .a = wanted.to,
                                             .b = binding.body,
                                             .driver = std::make_unique<NodeDriver>(*binding.motion)});
}

void Bridge::Impl::tie_by_link(Binding& binding, std::vector<Diagnostic>& notes) {
  const Link& link = *scene.link(binding.node);
  LinkPlace place;
  place.M_WP = scene.world(scene.parent(binding.node));
  place.M_PN = scene.local(binding.node);
  if (binding.tie.to) place.X_WA = physics.body(binding.tie.to).X_WB();
  place.X_WB = physics.body(binding.body).X_WB();
  std::optional<LinkJoint> joint = joint_of_link(link, place);
  if (!joint) {
    binding.tie = {};
    notes.push_back(note(Severity::Error, binding.node,
                         "the matrix above its link is singular, so the joint has no axis",
                         "give its ancestors scales that are not 0"));
    return;
  }
  if (joint->misfit > kMisfit) {
    notes.push_back(
        note(Severity::Warning, binding.node,
             "its local matrix is not one that its " + std::string{to_string(link.kind)} + " link can make",
             "the joint takes the present pose for that of the nearest value"));
  }
  const auto body = node_bodies.find(binding.node);
  joint->definition.a = binding.tie.to;
  joint->definition.b = binding.body;
  if (body != node_bodies.end()) fill_in(body->second, link.kind, joint->definition);
  if (free_joints) joint->definition.axes = {};
  if (joint->definition.name.empty()) joint->definition.name = scene.path(binding.node);
  if (const std::optional<SettingsProblem> problem = problem_with(joint->definition)) {
    binding.tie = {};
    notes.push_back(note(Severity::Error, binding.node, problem->text, problem->remedy));
    return;
  }
  binding.metres_per_value = joint->metres_per_value;
  binding.joint = physics.add_joint(std::move(joint->definition));
  scene.note_link_value(binding.node, joint->value);
  if (has_turns(link.kind, joint->value)) binding.pending_turns = joint->value;
}

void Bridge::Impl::note_link_value(const Binding& binding) {
  const Link* link = scene.link(binding.node);
  if (link == nullptr) return;
  if (link->kind == LinkKind::Free) {
    scene.note_link_value(binding.node, fit_link(*link, scene.local(binding.node), link->value).value);
  } else if (binding.tie.kind == JointTie::Kind::Link && value_size(link->kind) > 0 &&
             physics.contains(binding.joint)) {
    scene.note_link_value(
        binding.node, link_value(physics.joint_value(binding.joint), binding.metres_per_value, link->value));
  }
}

}  // namespace pantin
