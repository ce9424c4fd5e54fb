// Values and rates of joints that are set in trees with loops: the joint is held there by rows of its own
// while its loops are closed.
#include <algorithm>
#include <cmath>

#include <pantin/physics/constraints/constraint_manager.hpp>
#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/expects.hpp>

namespace pantin {

namespace {

/// A joint on the way is moved by no more at a time [rad], so that the mechanism follows instead of snapping
/// into another of its shapes; distances are cut into kParts.
constexpr double kStride = 0.1;
constexpr int kParts = 20;

/// What is held does not move by itself.
class Held final : public Driver {
 public:
  RigidMotion held{};
  [[nodiscard]] RigidMotion motion(double, Side) const override { return held; }
};

/// The layout with one more closure in one tree, and none in the others.
struct HeldJoint {
  HeldJoint(const TreeLayout& all, std::size_t t, const BodyStore& bodies, const JointDefinition& joint,
            std::size_t j)
      : layout{all} {
    const Tree tree = all.trees[t];
    layout.closures.assign(all.closures.begin() + tree.closures_begin,
                           all.closures.begin() + tree.closures_end);
    Closure closure = make_closure(layout, bodies, joint, static_cast<std::int32_t>(j));
    closure.kind = JointKind::Driven;
    closure.rows = kMostRows;
    closure.armature = {};
    closure.driver = &driver;
    layout.closures.push_back(closure);
    const auto count = static_cast<std::uint32_t>(layout.closures.size());
    for (std::size_t i = 0; i < layout.trees.size(); ++i) {
      layout.trees[i].closures_begin = i <= t ? 0 : count;
      layout.trees[i].closures_end = i < t ? 0 : count;
    }
    closer.resize(layout);
  }
  HeldJoint(const HeldJoint&) = delete;
  HeldJoint& operator=(const HeldJoint&) = delete;

  Held driver{};
  TreeLayout layout;
  LoopCloser closer{};
};

/// The numbers a part of the way from one to another.
JointNumbers between(const double* from, const JointNumbers& to, double part) {
  JointNumbers out = to;
  for (int i = 0; i < to.size(); ++i) out[i] = from[i] + part * (to[i] - from[i]);
  return out;
}

}  // namespace

std::int32_t ConstraintManager::tree_of_joint(std::size_t j) const {
  if (layout_.link_of_joint[j] >= 0)
    return static_cast<std::int32_t>(layout_.tree_of(layout_.link_of_joint[j]));
  const std::int32_t closure = layout_.closure_of_joint[j];
  return closure < 0 ? -1 : static_cast<std::int32_t>(layout_.tree_of_closure(closure));
}

bool ConstraintManager::is_in_loop(std::size_t j) const {
  const std::int32_t tree = tree_of_joint(j);
  return tree >= 0 && layout_.trees[static_cast<std::size_t>(tree)].has_closures();
}

bool ConstraintManager::set_value_in_loop(BodyStore& bodies, std::size_t j, const JointNumbers& to) {
  const JointDefinition& joint = *joints_[j];
  const auto t = static_cast<std::size_t>(tree_of_joint(j));
  const Tree& tree = layout_.trees[t];
  const State before = bodies.state;
  Numbers from = numbers(bodies, j);
  double turn = 0, length = 0;
  // Whole turns of a joint move nothing, but for what is coupled to it.
  const bool is_coupled = couplings_.has(ids_[j]);
  for (int i = 0; i < to.size(); ++i) {
    if (counts_turns(joint.kind, i) && !is_coupled)
      from.q[i] += 2 * M_PI * std::round((to[i] - from.q[i]) / (2 * M_PI));
    double& most = is_length(joint.kind, i) ? length : turn;
    most = std::max(most, std::abs(to[i] - from.q[i]));
  }
  if (joint.kind == JointKind::Ball) {  // of both quaternions of an attitude the nearer
    double along = 0;
    for (int i = 0; i < 4; ++i) along += from.q[i] * to[i];
    for (double& x : from.q) x = along < 0 ? -x : x;
    turn = M_PI;
  }
  keep_numbers(bodies, j, from);
  const Instant now{bodies.state.time, Side::After};
  ground_motions(bodies, now, grounds_);
  HeldJoint held{layout_, t, bodies, joint, j};
  const TreeView with_it{held.layout, held.layout.trees[t], kernel_, grounds_, now};
  const int parts = std::max(static_cast<int>(std::ceil(turn / kStride)), length > 0 ? kParts : 1);
  bool closed = true;
  for (int part = 1; part <= parts && closed; ++part) {
    held.driver.held.X_AB = joint_pose(joint, between(from.q, to, static_cast<double>(part) / parts));
    closed = held.closer.close(with_it, bodies.state.coordinates);
    commit(bodies, tree, grounds_, now);
  }
  if (!closed) {
    bodies.state = before;
    return false;
  }
  open_[t] = {};
  bodies.state.edited[t] = 1;
  prepare(bodies);
  return true;
}

void ConstraintManager::set_rate_in_loop(BodyStore& bodies, std::size_t j, const JointNumbers& rate) {
  const JointDefinition& joint = *joints_[j];
  const auto t = static_cast<std::size_t>(tree_of_joint(j));
  const Instant now{bodies.state.time, Side::After};
  ground_motions(bodies, now, grounds_);
  HeldJoint held{layout_, t, bodies, joint, j};
  RigidMotion& motion = held.driver.held;
  motion.X_AB = relative_pose(bodies, joint);
  with_model(joint, [&](auto model) {
    constexpr int kRates = decltype(model)::kRates;
    if constexpr (kRates > 0) {
      kernel::Mat3<double> R;
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{R.m} = motion.X_AB.rotation();
      kernel::Vec3<double> angular[kRates], linear[kRates];
      model.columns(R, angular, linear);
      for (int k = 0; k < kRates; ++k) {
        motion.w_AB += rate[k] * Vector3{angular[k].x, angular[k].y, angular[k].z};
        motion.v_AB += rate[k] * Vector3{linear[k].x, linear[k].y, linear[k].z};
      }
    }
  });
  const std::vector<double> before = bodies.state.rates;
  const TreeView with_it{held.layout, held.layout.trees[t], kernel_, grounds_, now};
  if (!held.closer.project(with_it, bodies.state.coordinates, bodies.state.rates)) {
    bodies.state.rates = before;
    PANTIN_EXPECTS(false, "joint '" + joint.name +
                              "' cannot move at this rate with its loop closed and its couplings held; "
                              "choose one that these allow");
  }
  commit(bodies, layout_.trees[t], grounds_, now);
}

}  // namespace pantin
