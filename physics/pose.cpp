#include <pantin/physics/pose.hpp>

namespace pantin {

RigidMotion inverse(const RigidMotion& m) {
  const Quaternion q_BA = m.X_AB.q.conjugate();
  const Vector3 w = q_BA * m.w_AB, v = q_BA * m.v_AB, a = q_BA * m.a_AB, alpha = q_BA * m.alpha_AB;
  RigidMotion out;
  out.X_AB = inverse(m.X_AB);
  const Vector3& p = out.X_AB.p;  // A's origin in B
  // p = -R^T p_AB: p' = -w x p - v, and so on, in axes of B.
  out.v_AB = -v - w.cross(p);
  out.w_AB = -w;
  out.a_AB = -a - alpha.cross(p) - w.cross(w.cross(p)) - 2 * w.cross(out.v_AB);
  out.alpha_AB = -alpha;
  return out;
}

}  // namespace pantin
