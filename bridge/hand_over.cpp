// Scene -> Physics. A plan is made and judged before anything changes; what shows only when bodies and joints
// stand (loops that cannot be closed, joints that move nothing) is undone.
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include <Eigen/Eigenvalues>

#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {
namespace {

constexpr double kStretchRate = 1e-4;   // [1/s]; single-precision keys of a constant scale stay below it
constexpr double kRoundOff = 1e-9;      // of the rate of the whole matrix
constexpr double kBeyond = 1e-9;        // [rad] or [m] beyond a stop that are worth a word
constexpr double kFlatInertia = 1e-12;  // least over greatest principal moment of a body that can turn

/// A node that is about to be simulated.
struct Planned {
  NodeId node{};
  Polar at{};
  SplitMotion motion{};
  DerivedMass mass{};
};

/// What a binding was before, for going back.
struct Before {
  Drive drive{};
  Affine M_BN{};
  MassProperties own_mass{};
  double density{0};
  std::optional<Offset> blend{};
  bool automatic{false};
};

bool is_stretched(const SplitMotion& motion) {
  const double rate = motion.X.w_AB.norm() * motion.S.norm();
  return motion.S1.norm() > kStretchRate * motion.S.norm() + kRoundOff * rate;
}

bool can_turn(const MassProperties& mass) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver{mass.I_BBcm_B, Eigen::EigenvaluesOnly};
  return mass.mass > 0 && solver.eigenvalues()[0] > kFlatInertia * solver.eigenvalues()[2];
}

}  // namespace

/// One hand-over, from plan to end.
class Bridge::Impl::HandOver {
 public:
  HandOver(Impl& bridge, const HandOverSettings& settings) : bridge_{bridge}, settings_{settings} {}

  std::vector<Diagnostic> run(NodeId id, Scope scope) && {
    const std::vector<NodeId> nodes = bridge_.selected(id, scope);
    if (nodes.empty()) error(id, "there is nothing to simulate: no node here has a mass, a link or geometry");
    nodes_.insert(nodes.begin(), nodes.end());
    for (const NodeId node : nodes) plan(node);
    refuse_fixed_below(id);
    if (has_error(notes_)) return std::move(notes_);
    commit();
    if (!has_error(notes_)) note_mimics_not_held();
    return std::move(notes_);
  }

 private:
  void error(NodeId id, std::string problem,
             std::string remedy = "declare a mass, or hand over a node with shapes or meshes") {
    notes_.push_back(bridge_.note(Severity::Error, id, std::move(problem), std::move(remedy)));
  }

  void plan(NodeId id) {
    const Binding* binding = bridge_.find(id);
    if (binding != nullptr && binding->drive == Drive::Physics) return;
    Planned planned{.node = id};
    planned.at = polar(bridge_.scene.world(id).linear());
    if (planned.at.singular || !bridge_.scene.world(id).matrix().allFinite()) {
      return error(id, "its world matrix is singular, so no rigid body can follow it",
                   "give it and its ancestors scales that are not 0");
    }
    planned.motion = bridge_.world_motion(id);
    if (is_stretched(planned.motion)) {
      return error(id, "its scale or shear changes at this instant, which a rigid body cannot go on with",
                   "hand it over when its scale stands still, or stop the clip");
    }
    planned.mass = bridge_.weigh(id, residual_of(planned.at), settings_.density, &nodes_);
    notes_.insert(notes_.end(), planned.mass.notes.begin(), planned.mass.notes.end());
    if (!planned.mass.known && bridge_.scene.link(id) == nullptr) {
      return error(id, "it has no mass, and neither shapes nor meshes to derive one from");
    }
    // Numbers that are finite one by one may overflow when they are multiplied.
    const RigidBodySettings body =
        bridge_.body_settings(id, Drive::Physics, planned.at, planned.motion.X, planned.mass.mass);
    if (const std::optional<SettingsProblem> problem = pantin::problem_with(body)) {
      return error(id, problem->text, "give it and its ancestors numbers of sensible size");
    }
    judge_inertia(planned);
    plan_.push_back(std::move(planned));
  }

  void judge_inertia(const Planned& planned) {
    const MassProperties& mass = planned.mass.mass;
    if (problem_with(mass, InertiaCheck::Solvable))
      return;  // assign_masses judges it with what it is fixed to
    if (const std::optional<SettingsProblem> doubt = problem_with(mass)) {
      notes_.push_back(
          bridge_.note(Severity::Warning, planned.node, doubt->text + "; it is simulated so", doubt->remedy));
    }
    const Link* link = bridge_.scene.link(planned.node);
    if ((link == nullptr || link->kind == LinkKind::Free) && planned.mass.no_inertia &&
        !carries_joint(planned.node)) {
      error(planned.node, "it declares a mass but no inertia, and has no geometry to derive one from",
            "declare an inertia, or give it a shape");
    }
  }

  /// Whether a node below is linked to it, so that what it carries may give it inertia.
  [[nodiscard]] bool carries_joint(NodeId id) const {
    const std::vector<NodeId> below = bridge_.scene.subtree(id);
    return std::any_of(below.begin() + 1, below.end(),
                       [&](NodeId node) { return bridge_.scene.link(node) != nullptr; });
  }

  // A static node's body would stay where it is while its node went along with the simulated one above.
  void refuse_fixed_below(NodeId id) {
    for (const Binding* binding : bridge_.below({&id, 1})) {
      if (binding->drive != Drive::Static || nodes_.contains(binding->node)) continue;
      NodeId above = bridge_.scene.parent(binding->node);
      while (above && !nodes_.contains(above)) above = bridge_.scene.parent(above);
      if (!above) continue;
      error(binding->node, "it is static and would be carried along by the simulated node above it",
            "release it, or make it follow the scene");
    }
  }

  void warn(int count, const char* what, const char* remedy) {
    if (count == 0) return;
    notes_.push_back(bridge_.note(Severity::Warning, plan_.front().node,
                                  std::to_string(count) + " joint(s) here " + what, remedy));
  }

  void note_mimics_not_held() {
    int mimics = 0;
    for (const Planned& planned : plan_) {
      const Link* link = bridge_.scene.link(planned.node);
      mimics += link != nullptr && link->mimic && !bridge_.is_held_by_gear(planned.node);
    }
    warn(mimics, "mimic another, which is not held while they are simulated",
         "hand over what leads them too, of the same instance, or expect them to move on their own");
  }

  /// Of joints just made, how many begin beyond their stops.
  void note_beyond_stops() {
    const auto is_beyond = [&](const Planned& planned) {
      const JointId id = bridge_.find(planned.node)->joint;
      if (!id) return false;
      const JointDefinition& joint = bridge_.physics.joint(id);
      const JointNumbers value = bridge_.physics.joint_value(id);
      for (int i = 0; i < std::min(3, value.size()); ++i) {
        const JointAxis& axis = joint.axes[static_cast<std::size_t>(i)];
        if (value[i] < axis.lower - kBeyond || value[i] > axis.upper + kBeyond) return true;
      }
      return false;
    };
    warn(static_cast<int>(std::count_if(plan_.begin(), plan_.end(), is_beyond)),
         "start beyond their limits: the stop is where they stand until they have moved back",
         "begin within the limits");
  }

  void commit() {
    if (plan_.empty()) return;
    const std::vector<NodeId> tops = this->tops();
    for (const NodeId id : tops) {  // the user has moved it since the last update
      Binding* binding = bridge_.find(id);
      if (binding == nullptr || !binding->moved_from) continue;
      binding->moved_from.reset();
      bridge_.jump_to_trajectory(*binding);
    }
    for (const Planned& planned : plan_) {
      if (Binding* binding = bridge_.find(planned.node)) change(*binding, planned);
      else create(planned);
    }
    for (const NodeId id : created_) {
      Binding* above = bridge_.bound_above(id);
      if (above != nullptr && !nodes_.contains(above->node)) bridge_.reweigh(above);
    }
    std::vector<Diagnostic> notes = bridge_.reconcile(tops);
    if (!has_error(notes)) find_singular(notes);
    notes_.insert(notes_.end(), notes.begin(), notes.end());
    if (has_error(notes)) undo(tops);
    else note_beyond_stops();
  }

  void create(const Planned& planned) {
    Binding& binding =
        bridge_.bind(planned.node, Drive::Physics, planned.at, planned.motion.X, planned.mass.mass);
    binding.density = settings_.density;
    created_.push_back(planned.node);
  }

  // The body has the trajectory's pose and velocity; the residual is what leads from that very pose to the
  // node.
  void change(Binding& binding, const Planned& planned) {
    before_[planned.node] = {binding.drive,   binding.M_BN,  binding.own_mass,
                             binding.density, binding.blend, std::erase(bridge_.automatic, &binding) > 0};
    const Pose X_WB = bridge_.physics.body(binding.body).X_WB();
    const Matrix3 R_BW = X_WB.rotation().transpose();
    const Affine M_WN = bridge_.scene.world(planned.node);
    binding.M_BN.linear() = R_BW * M_WN.linear();
    binding.M_BN.translation() = R_BW * (M_WN.translation() - X_WB.p);
    binding.drive = Drive::Physics;
    binding.own_mass = planned.mass.mass;
    binding.density = settings_.density;
    binding.blend.reset();
    binding.is_remembered = false;
    binding.is_broken = false;
  }

  void find_singular(std::vector<Diagnostic>& notes) {
    const std::vector<Binding*> affected = bridge_.below(tops());
    const auto is_free_and_sound = [&](const Binding* binding) {
      return !binding->joint && can_turn(bridge_.physics.body(binding->body).mass_properties());
    };
    if (std::all_of(affected.begin(), affected.end(), is_free_and_sound)) return;
    for (const auto& [joint, problem] : bridge_.physics.singular_joints()) {
      const auto culprit = std::find_if(affected.begin(), affected.end(), [&](const Binding* binding) {
        if (joint) return binding->joint == joint;
        return binding->drive == Drive::Physics && !binding->joint && !is_free_and_sound(binding);
      });
      if (culprit == affected.end()) continue;
      notes.push_back(bridge_.note(Severity::Error, (*culprit)->node, problem.text, problem.remedy));
    }
  }

  [[nodiscard]] std::vector<NodeId> tops() const {
    std::vector<NodeId> nodes;
    for (const Planned& planned : plan_) nodes.push_back(planned.node);
    return nodes;
  }

  void undo(const std::vector<NodeId>& tops) {
    for (auto& [node, before] : before_) {
      Binding& binding = *bridge_.find(node);
      binding.drive = before.drive;
      binding.M_BN = before.M_BN;
      binding.own_mass = before.own_mass;
      binding.density = before.density;
      binding.blend = before.blend;
      binding.is_remembered = false;
      if (before.automatic) bridge_.automatic.push_back(&binding);
    }
    for (auto id = created_.rbegin(); id != created_.rend(); ++id) {
      Binding* above = bridge_.bound_above(*id);
      bridge_.unbind(*bridge_.find(*id));
      bridge_.reweigh(above);
    }
    static_cast<void>(bridge_.reconcile(tops));
  }

  Impl& bridge_;
  const HandOverSettings& settings_;
  std::unordered_set<NodeId> nodes_{};
  std::vector<Diagnostic> notes_{};
  std::vector<Planned> plan_{};
  std::vector<NodeId> created_{};
  std::unordered_map<NodeId, Before> before_{};
};

std::vector<Diagnostic> Bridge::hand_over(NodeId id, Scope scope, const HandOverSettings& settings) {
  impl_->expect_alive(id, "hand_over");
  if (const std::optional<SettingsProblem> problem = problem_with(settings)) {
    return {impl_->note(Severity::Error, id, problem->text, problem->remedy)};
  }
  impl_->forget_vanished();
  impl_->notice_moves();
  return Impl::HandOver{*impl_, settings}.run(id, scope);
}

}  // namespace pantin
