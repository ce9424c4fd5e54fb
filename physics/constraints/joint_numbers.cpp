// Numbers of joints: value, rate, drift, and joints that nothing resists.
#include <algorithm>
#include <cmath>

#include <pantin/physics/constraints/constraint_manager.hpp>
#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/expects.hpp>

namespace pantin {

namespace {

Pose end_pose(const BodyStore& bodies, BodyId id, const Pose& X_BJ) {
  return id ? bodies.X_WB(bodies.at(id)) * X_BJ : X_BJ;
}

/// Velocity of the point p_WQ of a body, and its angular velocity.
struct PointRates {
  Vector3 v{Vector3::Zero()}, w{Vector3::Zero()};
};
PointRates rates_at(const BodyStore& bodies, BodyId id, const Vector3& p_WQ) {
  if (!id) return {};
  const BodyKinematics& k = bodies.state.kinematics[bodies.at(id)];
  return {k.v_WBcm + k.w_WB.cross(p_WQ - k.p_WBcm), k.w_WB};
}

JointDrift pose_miss(const Pose& X, const Pose& wanted) {
  return {(X.p - wanted.p).norm(), X.q.angularDistance(wanted.q)};
}

}  // namespace

Pose joint_pose(const JointDefinition& joint, const JointNumbers& value) {
  Pose X;
  with_model(joint, [&](auto model) {
    PANTIN_EXPECTS(value.size() == decltype(model)::kCoordinates,
                   "a " + std::string{decltype(model)::kName} + " has " +
                       std::to_string(decltype(model)::kCoordinates) + " coordinate(s), not " +
                       std::to_string(value.size()));
    kernel::Mat3<double> R;
    kernel::Vec3<double> p;
    model.place(value.numbers().data(), R, p);
    const Matrix3 rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.m);
    X = {{p.x, p.y, p.z}, Quaternion{rotation}};
  });
  return X;
}

JointDrift joint_miss(const JointDefinition& joint, const Pose& X_JaJb) {
  double q[kMostCoordinates] = {1};
  std::size_t size = 0;
  with_model(joint, [&](auto model) {
    model.measure(X_JaJb, q);
    size = decltype(model)::kCoordinates;
  });
  return pose_miss(X_JaJb, joint_pose(joint, JointNumbers{std::span<const double>{q, size}}));
}

Pose ConstraintManager::relative_pose(const BodyStore& bodies, const JointDefinition& joint) const {
  return inverse(end_pose(bodies, joint.a, joint.X_AJ)) * end_pose(bodies, joint.b, joint.X_BJ);
}

ConstraintManager::Numbers ConstraintManager::numbers(const BodyStore& bodies, std::size_t j) const {
  const JointDefinition& joint = *joints_[j];
  Numbers out = last_[j];
  const std::int32_t closure = stale_ ? -1 : layout_.closure_of_joint[j];
  if (closure >= 0) {
    const auto first = static_cast<std::size_t>(kMostCoordinates * closure);
    std::copy_n(bodies.state.cut_coordinates.data() + first, kMostCoordinates, out.q);
    out.known = true;
    return out;
  }
  const std::int32_t index = stale_ ? -1 : layout_.link_of_joint[j];
  if (index >= 0) {
    const TreeLink& link = layout_.links[static_cast<std::size_t>(index)];
    with_model(joint, [&](auto model) {
      std::copy_n(bodies.state.coordinates.data() + link.q, decltype(model)::kCoordinates, out.q);
      std::copy_n(bodies.state.rates.data() + link.v, decltype(model)::kRates, out.v);
      if (link.reversed) model.reverse(out.q, out.v);
    });
  } else {
    if (!out.known && joint.kind == JointKind::Ball) out.q[0] = 1;
    with_model(joint, [&](auto model) { model.measure(relative_pose(bodies, joint), out.q); });
  }
  out.known = true;
  return out;
}

JointNumbers ConstraintManager::value(const BodyStore& bodies, std::size_t j) const {
  const Numbers n = numbers(bodies, j);
  std::size_t size = 0;
  with_model(*joints_[j], [&](auto model) { size = decltype(model)::kCoordinates; });
  return JointNumbers{std::span<const double>{n.q, size}};
}

JointNumbers ConstraintManager::rate(const BodyStore& bodies, std::size_t j) const {
  // Measured from the bodies, so that it is right also before edited velocities are projected.
  const JointDefinition& joint = *joints_[j];
  const Pose X_WJa = end_pose(bodies, joint.a, joint.X_AJ), X_WJb = end_pose(bodies, joint.b, joint.X_BJ);
  const PointRates a = rates_at(bodies, joint.a, X_WJb.p), b = rates_at(bodies, joint.b, X_WJb.p);
  const Vector3 w = X_WJa.q.conjugate() * Vector3{b.w - a.w};
  const Vector3 v = X_WJa.q.conjugate() * Vector3{b.v - a.v};
  JointNumbers out;
  with_model(joint, [&](auto model) {
    // The rates whose motion is nearest, with a metre weighing as much as a radian.
    constexpr int kRates = decltype(model)::kRates;
    if constexpr (kRates > 0) {
      const Matrix3 R_JaJb = (X_WJa.q.conjugate() * X_WJb.q).toRotationMatrix();
      kernel::Mat3<double> R;
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{R.m} = R_JaJb;
      kernel::Vec3<double> angular[kRates], linear[kRates];
      model.columns(R, angular, linear);
      Eigen::Matrix<double, 6, kRates> S;
      for (int k = 0; k < kRates; ++k)
        S.col(k) << angular[k].x, angular[k].y, angular[k].z, linear[k].x, linear[k].y, linear[k].z;
      Eigen::Matrix<double, 6, 1> V;
      V << w, v;
      const Eigen::Matrix<double, kRates, kRates> SS = S.transpose() * S;
      const Eigen::Matrix<double, kRates, 1> rates = SS.ldlt().solve(S.transpose() * V);
      out = JointNumbers{std::span<const double>{rates.data(), kRates}};
    }
  });
  return out;
}

void ConstraintManager::keep_numbers(BodyStore& bodies, std::size_t j, const Numbers& given) const {
  if (const std::int32_t closure = layout_.closure_of_joint[j]; closure >= 0) {
    const auto first = static_cast<std::size_t>(kMostCoordinates * closure);
    std::copy_n(given.q, kMostCoordinates, bodies.state.cut_coordinates.data() + first);
    return;
  }
  const TreeLink& link = layout_.links[static_cast<std::size_t>(layout_.link_of_joint[j])];
  Numbers n = given;
  with_model(link, [&](auto model) {
    if (link.reversed) model.reverse(n.q, n.v);
    model.normalise(n.q);
    std::copy_n(n.q, decltype(model)::kCoordinates, bodies.state.coordinates.data() + link.q);
    std::copy_n(n.v, decltype(model)::kRates, bodies.state.rates.data() + link.v);
  });
}

void ConstraintManager::put_numbers(BodyStore& bodies, std::size_t j, const Numbers& given) {
  const std::int32_t index = layout_.link_of_joint[j];
  PANTIN_EXPECTS(index >= 0, "joint '" + joints_[j]->name +
                                 "' moves nothing: both its bodies are not simulated, or it is fixed");
  keep_numbers(bodies, j, given);
  const Instant now{bodies.state.time, Side::After};
  ground_motions(bodies, now, grounds_);
  commit(bodies, layout_.trees[layout_.tree_of(index)], grounds_, now);
}

bool ConstraintManager::set_value(BodyStore& bodies, std::size_t j, const JointNumbers& value) {
  prepare(bodies);
  Numbers n = numbers(bodies, j);
  with_model(*joints_[j], [&](auto model) {
    PANTIN_EXPECTS(value.size() == decltype(model)::kCoordinates,
                   "a " + std::string{decltype(model)::kName} + " has " +
                       std::to_string(decltype(model)::kCoordinates) + " coordinate(s), not " +
                       std::to_string(value.size()));
  });
  if (is_in_loop(j)) return set_value_in_loop(bodies, j, value);
  std::copy(value.numbers().begin(), value.numbers().end(), n.q);
  put_numbers(bodies, j, n);
  return true;
}

void ConstraintManager::set_rate(BodyStore& bodies, std::size_t j, const JointNumbers& rate) {
  prepare(bodies);
  Numbers n = numbers(bodies, j);
  with_model(*joints_[j], [&](auto model) {
    PANTIN_EXPECTS(rate.size() == decltype(model)::kRates,
                   "a " + std::string{decltype(model)::kName} + " has " +
                       std::to_string(decltype(model)::kRates) + " rate(s), not " +
                       std::to_string(rate.size()));
  });
  if (is_in_loop(j)) return set_rate_in_loop(bodies, j, rate);
  std::copy(rate.numbers().begin(), rate.numbers().end(), n.v);
  put_numbers(bodies, j, n);
}

JointDrift ConstraintManager::drift(const BodyStore& bodies) const {
  JointDrift drift;
  for (const auto& joint : joints_) {
    const Pose X = relative_pose(bodies, *joint);
    JointDrift here;
    if (joint->kind == JointKind::Driven) {
      // Where the driven motion jumps, the bodies stand on either side of the jump.
      const double t = bodies.state.time;
      const JointDrift before = pose_miss(X, joint->driver->motion(t, Side::Before).X_AB);
      const JointDrift after = pose_miss(X, joint->driver->motion(t, Side::After).X_AB);
      here = before.distance + before.angle < after.distance + after.angle ? before : after;
    } else {
      here = joint_miss(*joint, X);
    }
    drift.distance = std::max(drift.distance, here.distance);
    drift.angle = std::max(drift.angle, here.angle);
  }
  add_coupling_drift(bodies, drift);
  return drift;
}

std::vector<std::pair<JointId, SettingsProblem>> ConstraintManager::singular_joints(BodyStore& bodies) {
  prepare(bodies);
  std::vector<std::pair<JointId, SettingsProblem>> out;
  const Instant now{bodies.state.time, Side::After};
  ground_motions(bodies, now, grounds_);
  for (const Tree& tree : layout_.trees) {
    kernel_.place(layout_, tree, grounds_, now, bodies.state.coordinates, zero_rates_);
    kernel_.load(layout_, tree);
    kernel_.eliminate(layout_, tree, {});
    for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
      if (!kernel_.is_singular(layout_, static_cast<std::int32_t>(i))) continue;
      const TreeLink& link = layout_.links[i];
      const std::string& body = bodies.names[layout_.members[link.members_begin].body];
      const bool root = link.joint < 0;
      const auto j = static_cast<std::size_t>(std::max(link.joint, 0));
      out.emplace_back(
          root ? JointId{} : ids_[j],
          SettingsProblem{ProblemCode::SingularMass,
                          (root ? "floating body '" + body + "'" : "joint '" + joints_[j]->name + "'") +
                              " moves nothing that resists: '" + body +
                              "' and what it carries have no mass or inertia in that direction",
                          "give '" + body + "' mass and inertia, or fix it to a body that has them"});
    }
  }
  const OpenLoop open = find_open_loop(bodies);
  if (out.empty() && open.joint >= 0) {
    out.emplace_back(ids_[static_cast<std::size_t>(open.joint)], problem_with(open));
  }
  for (const std::uint32_t i : layout_.free_bodies) {
    if (bodies.mass[i].mass > 0) continue;
    out.emplace_back(JointId{}, SettingsProblem{ProblemCode::SingularMass,
                                                "free body '" + bodies.names[i] + "' has no mass",
                                                "give it a mass, or join it to a body that has one"});
  }
  return out;
}

}  // namespace pantin
