// Moving a node to another place at once. A bound node takes along what hangs on it by joints; an unbound one
// takes along the bodies of all nodes below it.
#include <algorithm>
#include <unordered_set>

#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {
namespace {

constexpr double kSameResidual = 1e-9;  // relative: what users' products of matrices may round
constexpr double kKeptByJoint = 1e-6;   // [m], [rad]: a pose that misses its joint by more is reported

}  // namespace

/// One teleport.
class Bridge::Impl::Teleport {
 public:
  Teleport(Impl& bridge, NodeId id, const Affine& M_WN, TeleportVelocity velocity)
      : bridge_{bridge}, id_{id}, M_WN_{M_WN}, velocity_{velocity} {}

  std::vector<Diagnostic> run() && {
    plan();
    if (has_error(notes_)) return std::move(notes_);
    const Binding* bound = bridge_.find(id_);
    if (bound == nullptr || bound->drive != Drive::Physics) bridge_.scene.set_local(id_, M_PN_);
    for (Binding* binding : joints_in_the_way_) bridge_.untie(*binding);
    for (const Landing& landing : landings_) bridge_.physics.set_pose(landing.binding->body, landing.X_WB);
    if (bound == nullptr) bridge_.reweigh(bridge_.bound_above(id_));
    static_cast<void>(bridge_.reconcile({&id_, 1}));
    if (velocity_ == TeleportVelocity::Zero) stop_all();
    bridge_.sync_out(nullptr);
    return std::move(notes_);
  }

 private:
  struct Landing {
    Binding* binding{nullptr};
    Pose X_WB{};
  };

  void error(NodeId id, std::string problem, std::string remedy) {
    notes_.push_back(bridge_.note(Severity::Error, id, std::move(problem), std::move(remedy)));
  }

  void plan() {
    const NodeId parent = bridge_.scene.parent(id_);
    if (!parent) return error(id_, "it cannot be teleported", "teleport its children");
    if (!M_WN_.matrix().allFinite())
      return error(id_, "the matrix to teleport it to is not finite", "give finite numbers");
    const std::optional<Affine> M_PN = solve_local(bridge_.scene.world(parent), M_WN_);
    if (!M_PN)
      return error(id_, "its parent's world matrix is singular", "give its ancestors scales that are not 0");
    M_PN_ = *M_PN;
    Binding* bound = bridge_.find(id_);
    const bool physics_owns = bound != nullptr && bound->drive != Drive::Scene;
    if (!physics_owns && bridge_.is_played(id_)) {
      return error(id_, "a clip animates it and would put it back",
                   "stop playing it, or teleport its parent");
    }
    if (bound != nullptr) land(*bound, M_WN_);
    if (bound != nullptr && bound->drive == Drive::Physics) return;  // physics takes along what hangs on it
    const Affine M_before = bridge_.scene.world(id_);
    for (Binding* binding : bridge_.below({&id_, 1})) {
      if (binding == bound || !is_taken_along(*binding)) continue;
      const std::optional<Affine> M_ND = solve_local(M_before, bridge_.scene.world(binding->node));
      if (!M_ND) {
        return error(id_, "its world matrix is singular, so what is below it has no place in it",
                     "set its local matrix");
      }
      land(*binding, M_WN_ * *M_ND);
      if (binding->tie.kind == JointTie::Kind::Link)
        joints_in_the_way_.push_back(binding);  // its frame moves along
    }
  }

  /// Below a node that physics does not own: what stands goes along with it, and below an unbound one also
  /// what is simulated without a body above that would carry it.
  [[nodiscard]] bool is_taken_along(const Binding& binding) const {
    if (binding.drive == Drive::Static) return binding.simulated_above == nullptr;
    return binding.drive == Drive::Physics && bridge_.find(id_) == nullptr &&
           binding.above == bridge_.bound_above(id_);
  }

  // What is animated follows its trajectory.
  void land(Binding& binding, const Affine& M_WB) {
    if (binding.drive == Drive::Scene) {
      if (binding.node == id_) binding.blend.reset();
      return;
    }
    const Polar at = polar(M_WB.linear());
    const Matrix3& S = binding.M_BN.linear();
    if (at.singular || (at.S - S).norm() > kSameResidual * S.norm()) {
      return error(binding.node,
                   "the new matrix scales, shears or mirrors it in another way, which its body cannot follow",
                   "keep its scale, or release the body and bind it again");
    }
    const Pose X_WB{M_WB.translation() - at.q * binding.M_BN.translation(), at.q};
    if (binding.node == id_ && binding.tie.kind == JointTie::Kind::Link) judge_joint(binding, X_WB);
    landings_.push_back({&binding, X_WB});
  }

  void judge_joint(const Binding& binding, const Pose& X_WB) {
    const JointDefinition& joint = bridge_.physics.joint(binding.joint);
    const Pose X_WA = joint.a ? bridge_.physics.body(joint.a).X_WB() : Pose{};
    const JointDrift miss = joint_miss(joint, inverse(X_WA * joint.X_AJ) * (X_WB * joint.X_BJ));
    if (std::max(miss.distance, miss.angle) <= kKeptByJoint) return;
    notes_.push_back(
        bridge_.note(Severity::Warning, binding.node,
                     "its joint '" + joint.name + "' does not allow this place; it is brought back to it",
                     "teleport what carries it, or clear its link"));
  }

  // All at once: one after the other, the joints would hand on momentum that is about to be taken away.
  void stop_all() {
    std::unordered_set<BodyId> stopped;
    std::vector<BodyId> roots;
    for (Binding* binding : bridge_.below({&id_, 1})) {
      const bool landed = std::any_of(landings_.begin(), landings_.end(),
                                      [&](const Landing& landing) { return landing.binding == binding; });
      const bool hangs = binding->joint && stopped.contains(binding->tie.to);
      if (!landed && !hangs) continue;
      stopped.insert(binding->body);
      if (landed && binding->drive == Drive::Physics) roots.push_back(binding->body);
    }
    if (roots.empty()) return;
    State state = bridge_.physics.snapshot();
    const std::span<const BodyId> bodies = bridge_.physics.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (!stopped.contains(bodies[i])) continue;
      state.bodies[i].linear_momentum.setZero();
      state.bodies[i].angular_momentum.setZero();
      state.kinematics[i].v_WBcm.setZero();
      state.kinematics[i].w_WB.setZero();
    }
    bridge_.physics.restore(state);
    for (const BodyId root : roots) bridge_.physics.set_velocity(root, Vector3::Zero(), Vector3::Zero());
  }

  Impl& bridge_;
  NodeId id_;
  Affine M_WN_;
  TeleportVelocity velocity_;
  Affine M_PN_{Affine::Identity()};
  std::vector<Landing> landings_{};
  std::vector<Binding*> joints_in_the_way_{};
  std::vector<Diagnostic> notes_{};
};

std::vector<Diagnostic> Bridge::teleport(NodeId id, const Affine& M_WN, TeleportVelocity velocity) {
  impl_->expect_alive(id, "teleport");
  impl_->forget_vanished();
  impl_->notice_moves();
  return Impl::Teleport{*impl_, id, M_WN, velocity}.run();
}

}  // namespace pantin
