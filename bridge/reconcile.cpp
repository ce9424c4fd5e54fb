// Making physics agree with the drives, in an order in which nothing is evaluated half-changed: joints go,
// trajectories and kinds change, masses are set, joints come. Bodies keep pose and velocity throughout.
#include <algorithm>
#include <cmath>

#include <pantin/bridge/bridge_impl.hpp>
#include <pantin/bridge/links_to_joints.hpp>

namespace pantin {
namespace {

constexpr double kSameMatrix = 1e-13;  // relative
constexpr double kSamePose =
    1e-10;  // [m] relative to the distance from the origin, [rad]: below it nothing has jumped

bool is_near(const Pose& a, const Pose& b) {
  return (a.p - b.p).norm() <= kSamePose * (1 + a.p.norm()) && a.q.angularDistance(b.q) <= kSamePose;
}

BodyKind wanted_kind(const Binding& binding) {
  if (binding.drive == Drive::Static) return BodyKind::Static;
  const bool driven = binding.drive == Drive::Scene && binding.simulated_above == nullptr;
  return driven ? BodyKind::Animated : BodyKind::Simulated;
}

}  // namespace

std::vector<Diagnostic> Bridge::Impl::reconcile(std::span<const NodeId> tops) {
  std::vector<Diagnostic> notes = settle(tops);
  if (!has_error(notes)) drop_idle_carriers();
  return notes;
}

std::vector<Diagnostic> Bridge::Impl::settle(std::span<const NodeId> tops) {
  std::vector<Diagnostic> notes;
  std::vector<Binding*> affected = below(tops);
  link_up(affected);
  if (std::vector<NodeId> carriers = bind_carriers(affected); !carriers.empty()) {
    carriers.insert(carriers.end(), tops.begin(), tops.end());
    link_up(affected = below(carriers));
  }
  for (Binding* binding : affected) {
    if (binding->tie != wanted_tie(*binding) || (binding->joint && !physics.contains(binding->joint)))
      untie(*binding);
  }
  for (Binding* binding : affected) {
    if (binding->drive == Drive::Scene) build_chain(*binding);
    else binding->moved_from.reset();
  }
  for (Binding* binding : affected) change_kind(*binding);
  assign_masses(affected, notes);
  if (has_error(notes)) return notes;
  for (Binding* binding : affected) {
    if (!binding->joint) tie(*binding, notes);
  }
  if (has_error(notes)) return notes;
  tell_turns(affected, notes);
  if (has_error(notes)) return notes;
  for (Binding* binding : affected) {
    if (binding->drive == Drive::Scene && !binding->moved_from) jump_to_trajectory(*binding);
    hold_player(*binding);
    watch(*binding);
    remember_written(*binding);
  }
  couple(notes);  // may move bodies from where their nodes were seen
  return notes;
}

void Bridge::Impl::link_up(std::span<Binding* const> affected) const {
  for (Binding* binding : affected) {
    Binding* above = bound_above(binding->node);
    binding->above = above;
    const bool simulated = above != nullptr && above->drive == Drive::Physics;
    Binding* simulated_above = simulated || above == nullptr ? above : above->simulated_above;
    if (simulated_above == binding->simulated_above) continue;
    // What the user moved was remembered in another frame.
    binding->simulated_above = simulated_above;
    binding->moved_from.reset();
    binding->motion->set_move(std::nullopt);
  }
}

// Turning Scene into Physics keeps what the trajectory gave last: its motion up to now.
void Bridge::Impl::change_kind(Binding& binding) {
  const BodyKind wanted = wanted_kind(binding);
  if (physics.body(binding.body).kind() == wanted) return;
  switch (wanted) {
    case BodyKind::Static:
      physics.make_static(binding.body);
      break;
    case BodyKind::Animated:
      // A trajectory that begins elsewhere is reached later, by a jump that takes along what hangs on the
      // body.
      if (!is_near(physics.body(binding.body).X_WB(), trajectory_pose(binding)))
        physics.make_static(binding.body);
      else physics.make_animated(binding.body, std::make_unique<NodeDriver>(*binding.motion));
      break;
    case BodyKind::Simulated:
      physics.make_simulated(binding.body);
      break;
  }
}

Pose Bridge::Impl::trajectory_pose(const Binding& binding) const {
  const Pose X_FB = binding.motion->split_at(physics.time(), Side::After).X.X_AB;
  return binding.simulated_above == nullptr ? X_FB
                                            : physics.body(binding.simulated_above->body).X_WB() * X_FB;
}

// A trajectory that is elsewhere now (a clip began, something above was teleported) takes its body along at
// once, with all that hangs on it. An animated body cannot be placed, so it stands still for a moment.
void Bridge::Impl::jump_to_trajectory(Binding& binding) {
  const Pose X_WB = trajectory_pose(binding);
  if (is_near(physics.body(binding.body).X_WB(), X_WB)) return;
  if (physics.body(binding.body).kind() == BodyKind::Animated) physics.make_static(binding.body);
  physics.set_pose(binding.body, X_WB);
  if (physics.body(binding.body).kind() != BodyKind::Static) return;
  physics.make_animated(binding.body, std::make_unique<NodeDriver>(*binding.motion));
}

// Physics measures angles from poses; whole turns have to be told.
void Bridge::Impl::tell_turns(std::span<Binding* const> affected, std::vector<Diagnostic>& notes) {
  for (Binding* binding : affected) {
    if (!binding->pending_turns) continue;
    const JointNumbers value = joint_numbers(*binding->pending_turns, binding->metres_per_value);
    if (!physics.try_joint_value(binding->joint, value)) notes.push_back(not_allowed(*binding));
    binding->pending_turns.reset();
  }
}

void Bridge::Impl::hold_player(const Binding& binding) {
  if (!is_played(binding.node)) return;
  if (binding.drive == Drive::Scene && !binding.blend) player.release(binding.node);
  else player.hold(binding.node);
}

// From here on nothing is written to the node until its body, or what it hangs on, differs from this by more
// than the rounding that another way of computing the same matrix makes.
void Bridge::Impl::remember_written(Binding& binding) const {
  binding.below_written = is_below_written(binding);
  if (!binding.is_written()) {
    binding.M_WN = world_of(binding);
    return;
  }
  const Affine M_WP = parent_world(binding);
  const double size = M_WP.affine().norm();
  const bool same_parent = (M_WP.affine() - binding.M_WP_written.affine()).norm() <= kSameMatrix * size;
  if (binding.is_remembered && same_parent) binding.M_WP_written = M_WP;
  if (binding.is_remembered) return;
  binding.is_remembered = true;
  binding.M_WN = scene.world(binding.node);
  binding.X_WB_written = physics.body(binding.body).X_WB();
  binding.M_WP_written = M_WP;
}

}  // namespace pantin
