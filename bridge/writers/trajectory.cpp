#include <pantin/bridge/writers/trajectory.hpp>

namespace pantin {

TrajectoryRecorder::TrajectoryRecorder(const Scene& scene, const PhysicsManager& physics,
                                       const Bridge& bridge)
    : scene_{scene}, physics_{physics}, bridge_{bridge}, keys_{scene} {}

const TrajectoryRecorder::Names& TrajectoryRecorder::names_of(NodeId id) {
  const auto [entry, is_new] = names_.try_emplace(id);
  if (is_new) entry->second = {scene_.path(id), keys_.key(id)};
  return entry->second;
}

const Sample& TrajectoryRecorder::record() {
  sample_.t = bridge_.time();
  sample_.energy = physics_.energy();
  sample_.bodies.clear();
  sample_.joints.clear();
  for (const NodeId id : bridge_.bound()) {
    const RigidBody body = physics_.body(bridge_.body_of(id));
    const Pose X_WB = body.X_WB();
    const Names& names = names_of(id);
    sample_.bodies.push_back({.path = names.path,
                              .drive = bridge_.drive_of(id).value_or(Drive::Static),
                              .p_WB = X_WB.p,
                              .p_WBcm = body.p_WBcm(),
                              .q_WB = X_WB.q,
                              .v_WBcm = body.v_WBcm(),
                              .w_WB = body.w_WB()});
    const JointId joint = bridge_.joint_of(id);
    if (!joint) continue;
    const JointNumbers value = physics_.joint_value(joint);
    if (value.size() == 0) continue;
    sample_.joints.push_back({.name = names.link_key,
                              .body = sample_.bodies.size() - 1,
                              .value = value,
                              .rate = physics_.joint_rate(joint)});
  }
  return sample_;
}

}  // namespace pantin
