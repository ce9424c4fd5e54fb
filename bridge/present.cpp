// What to show between two updates. Nothing of it is kept.
#include <algorithm>

#include <pantin/bridge/bridge_impl.hpp>
#include <pantin/scenegraph/expects.hpp>

namespace pantin {
namespace {

Pose pose_between(const RigidBody& body, double alpha) {
  const Quaternion q = body.q_WB_previous().slerp(alpha, body.q_WB());
  const Vector3 p_WBcm = (1 - alpha) * body.p_WBcm_previous() + alpha * body.p_WBcm();
  return {p_WBcm - q * body.p_BBcm(), q};
}

bool stands_still(const RigidBody& body) {
  return body.p_WBcm_previous() == body.p_WBcm() && body.q_WB_previous().coeffs() == body.q_WB().coeffs();
}

}  // namespace

// An unbound node derives from the presented bound node above it: it has no history of its own.
Affine Bridge::presented(NodeId id, double alpha) const {
  const Impl& bridge = *impl_;
  bridge.expect_alive(id, "presented");
  PANTIN_EXPECTS(alpha >= 0 && alpha <= 1, "presented: alpha is " + std::to_string(alpha) + "; give 0 .. 1");
  const Binding* binding = bridge.find(id);
  if (binding == nullptr) binding = bridge.bound_above(id);
  if (binding == nullptr) return bridge.scene.world(id);
  std::vector<NodeId> between;
  for (NodeId at = id; at != binding->node; at = bridge.scene.parent(at)) between.push_back(at);
  const RigidBody body = bridge.physics.body(binding->body);
  Affine M = bridge.scene.world(binding->node);
  if (!stands_still(body)) {
    const Pose X_WB = pose_between(body, alpha);
    M.linear() = X_WB.rotation() * binding->M_BN.linear();
    M.translation() = X_WB * Vector3{binding->M_BN.translation()};
  }
  for (auto at = between.rbegin(); at != between.rend(); ++at) M = M * bridge.scene.local(*at);
  return M;
}

}  // namespace pantin
