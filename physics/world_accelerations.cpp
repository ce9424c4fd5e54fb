// The world as it accelerates at the state reached, for whoever asks between steps.
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

void WorldDynamics::accelerations_now(std::vector<Wrench>& external, std::vector<Vector3>& alpha,
                                      std::vector<Vector3>& a_cm) {
  room_.begin(bodies_, constraints_);
  begin();
  error_rates_.resize(v_.size());
  evaluate({bodies_.state.time, Side::After}, coordinates_now(), velocities_now(), {}, error_rates_);
  external = wrenches_;
  alpha.assign(bodies_.size(), Vector3::Zero());
  a_cm.assign(bodies_.size(), Vector3::Zero());
  const auto eigen = [](const kernel::Vec3<double>& x) { return Vector3{x.x, x.y, x.z}; };
  for (std::size_t l = 0; l < layout_.links.size(); ++l) {
    const LinkWork& link = kernel_.link(static_cast<std::int32_t>(l));
    const Vector3 al = eigen(link.al + link.dal), a = eigen(link.a + link.da), w = eigen(link.w),
                  p = eigen(link.p);
    for (std::uint32_t m = layout_.links[l].members_begin; m < layout_.links[l].members_end; ++m) {
      const std::uint32_t i = layout_.members[m].body;
      const Vector3 c = stage_[i].p_WBcm - p;
      alpha[i] = al;
      a_cm[i] = a + al.cross(c) + w.cross(w.cross(c));
    }
  }
}

}  // namespace pantin
