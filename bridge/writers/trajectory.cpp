#include <pantin/bridge/writers/trajectory.hpp>

namespace pantin {

TrajectoryRecorder::TrajectoryRecorder(const Scene& scene, const PhysicsManager& physics,
                                       const Bridge& bridge)
    : scene_{scene}, physics_{physics}, bridge_{bridge}, keys_{scene} {}

void TrajectoryRecorder::name_new(std::span<const NodeId> bound) {
  std::vector<NodeId> fresh;
  for (const NodeId id : bound)
    if (!names_.contains(id)) fresh.push_back(id);
  const std::vector<std::string> paths = scene_.paths(fresh);
  for (std::size_t i = 0; i < fresh.size(); ++i) names_[fresh[i]] = {paths[i], keys_.key(fresh[i], paths[i])};
}

const Sample& TrajectoryRecorder::record() {
  sample_.t = bridge_.time();
  sample_.energy = physics_.energy();
  sample_.bodies.clear();
  sample_.joints.clear();
  const std::vector<NodeId> bound = bridge_.bound();
  name_new(bound);
  for (const NodeId id : bound) {
    const RigidBody body = physics_.body(bridge_.body_of(id));
    const Pose X_WB = body.X_WB();
    const Names& names = names_.at(id);
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
