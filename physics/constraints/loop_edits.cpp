// What is set from outside in trees with loops: poses, values and rates, with the loops closed again.
#include <algorithm>
#include <cmath>

#include <pantin/physics/constraints/constraint_manager.hpp>
#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {

void ConstraintManager::measure_cut_joints(BodyStore& bodies, const Tree& tree) const {
  for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
    if (layout_.closures[c].coupling >= 0) continue;
    const JointDefinition& joint = *joints_[static_cast<std::size_t>(layout_.closures[c].joint)];
    double* q = bodies.state.cut_coordinates.data() + std::size_t{kMostCoordinates} * c;
    with_model(joint, [&](auto model) { model.measure(relative_pose(bodies, joint), q); });
  }
}

bool ConstraintManager::reclose(BodyStore& bodies, std::size_t t, std::span<const RigidMotion> grounds,
                                Instant at) {
  const Tree& tree = layout_.trees[t];
  if (!tree.has_closures()) return true;
  const std::vector<double> before = bodies.state.coordinates;
  const bool closed = loops_.close(view(tree, grounds, at), bodies.state.coordinates);
  open_[t] = closed ? OpenLoop{} : loops_.open_loop(layout_, tree);
  if (!closed) bodies.state.coordinates = before;
  return closed;
}

OpenLoop ConstraintManager::find_open_loop(BodyStore& bodies) {
  if (layout_.closures.empty()) return {};
  if (const std::int32_t k = layout_.cut_coupling; k >= 0) {
    const std::size_t b = at(couplings_[static_cast<std::size_t>(k)].b);
    return {static_cast<std::int32_t>(b), k, 0};
  }
  const Instant now{bodies.state.time, Side::After};
  for (std::size_t t = 0; t < open_.size(); ++t) {
    if (open_[t].joint < 0) continue;
    ground_motions(bodies, now, grounds_);
    if (!reclose(bodies, t, grounds_, now)) return open_[t];
    commit(bodies, layout_.trees[t], grounds_, now);
    bodies.state.edited[t] = 1;
    prepare(bodies);
  }
  return {};
}

SettingsProblem ConstraintManager::problem_with(const OpenLoop& loop) const {
  if (loop.coupling >= 0) return problem_with_coupling(loop);
  const JointDefinition& joint = *joints_[static_cast<std::size_t>(loop.joint)];
  return {ProblemCode::OpenLoop,
          "the loop that " + std::string{to_string(joint.kind)} + " '" + joint.name +
              "' closes cannot be closed: however its bodies are moved, a gap of at least " +
              text_of(loop.gap) + " (m or rad) is left",
          "place the bodies nearer to where the loop closes, correct the frames of its joints, or leave one "
          "joint out"};
}

void ConstraintManager::ground_has_moved(BodyStore& bodies, std::int32_t ground, Instant at) {
  ground_motions(bodies, at, grounds_);
  for (std::size_t t = 0; t < layout_.trees.size(); ++t) {
    const Tree& tree = layout_.trees[t];
    if (!layout_.stands_on(tree, ground)) continue;
    if (tree.has_closures()) {
      reclose(bodies, t, grounds_, at);
      bodies.state.edited[t] = 1;
    }
    commit(bodies, tree, grounds_, at);
  }
}

void ConstraintManager::teleport(BodyStore& bodies, std::size_t body, const Pose& X_WB) {
  prepare(bodies);
  const std::int32_t index = layout_.link_of_body[body];
  const TreeLink& link = layout_.links[static_cast<std::size_t>(index)];
  const std::size_t t = layout_.tree_of(index);
  const Tree& tree = layout_.trees[t];
  const BodyKinematics kept = bodies.state.kinematics[body];
  bodies.place(body, X_WB, kept.v_WBcm, kept.w_WB);
  // Only the link's own coordinates change; what hangs on it keeps its own and moves along.
  const TreeMember* member = &layout_.members[link.members_begin];
  while (member->body != body) ++member;
  const Pose X_WL = X_WB * inverse(member->X_LB);
  Pose X_WP;
  if (link.parent >= 0) X_WP = link_pose(bodies, layout_.links[static_cast<std::size_t>(link.parent)]);
  if (link.parent < 0 && link.ground >= 0) X_WP = bodies.X_WB(static_cast<std::size_t>(link.ground));
  double* q = bodies.state.coordinates.data() + link.q;
  with_model(link, [&](auto model) { model.measure(inverse(X_WP * link.X_PJ) * X_WL, q); });
  if (link.kind == JointKind::Free) {
    double* v = bodies.state.rates.data() + link.v;
    const Vector3 w_L = X_WL.q.conjugate() * kept.w_WB;
    const Vector3 v_L = kept.v_WBcm + kept.w_WB.cross(X_WL.p - bodies.state.bodies[body].p_WBcm);
    for (int i = 0; i < 3; ++i) v[i] = w_L[i], v[3 + i] = v_L[i];
  }
  const Instant now{bodies.state.time, Side::After};
  ground_motions(bodies, now, grounds_);
  if (tree.has_closures()) {
    reclose(bodies, t, grounds_, now);
    bodies.state.edited[t] = 1;
  }
  commit(bodies, tree, grounds_, now);
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    for (std::uint32_t m = layout_.links[i].members_begin; m < layout_.links[i].members_end; ++m) {
      const std::uint32_t b = layout_.members[m].body;
      bodies.state.previous[b] = bodies.state.bodies[b];
    }
  }
}

}  // namespace pantin
