// The motion inside the last step: recorded while the world is integrated, evaluated on demand.
#include <algorithm>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/setting_checks.hpp>
#include <pantin/physics/world.hpp>

namespace pantin {

void PhysicsManager::Impl::integrate_part(StepGroup& group, Integrator& with, Dynamics& system, double t,
                                          double h, std::span<double> q, std::span<double> v) {
  const bool records = keeps_motion || guard.any();
  MotionRecord& motion = group.motion;
  with.record_into(records ? &motion : nullptr);
  if (!records) return with.step(system, t, h, q, v);
  start.assign(q.begin(), q.end());
  start.insert(start.end(), v.begin(), v.end());
  const std::size_t parts = motion.parts();
  with.step(system, t, h, q, v);
  if (motion.parts() > parts) return;
  // The integrator has no interpolant: a cubic between the ends.
  const std::span<const double> q0 = std::span{start}.first(q.size()), v0 = std::span{start}.last(v.size());
  const MotionRecord::Room part = motion.add(t, h, 3, q0, v0);
  const auto split = [&](std::size_t k) {
    return std::pair{part.at(k).first(q.size()), part.at(k).last(v.size())};
  };
  const auto [q1, v1] = split(1);
  std::copy(q.begin(), q.end(), q1.begin());
  std::copy(v.begin(), v.end(), v1.begin());
  const auto [q_dot1, v_dot1] = split(2);
  system.derivative({t + h, Side::Before}, q, v, q_dot1, v_dot1);
  const auto [q_dot0, v_dot0] = split(3);
  system.derivative({t, Side::After}, q0, v0, q_dot0, v_dot0);
  MotionRecord::fit_cubic(part, h);
}

void WorldDynamics::place(Instant at, std::span<const double> q, std::span<const double> v) {
  place_grounds(at);
  place_free(q, v, {});
  place_trees(at, q, v);
}

void PhysicsManager::keep_motion(bool keep) {
  impl_->keeps_motion = keep;
  if (keep) return;
  for (StepGroup& group : impl_->groups) group.motion.clear();
}

std::vector<BodyKinematics> PhysicsManager::motion_at(double t) {
  Impl& world = *impl_;
  const bool is_kept = world.keeps_motion && !world.groups.empty() && !world.groups.front().motion.empty();
  PANTIN_EXPECTS(is_kept,
                 "no motion inside a step is kept; call keep_motion(true) before a step that goes well");
  PANTIN_EXPECTS(world.motion_topology == world.bodies.state.topology,
                 "bodies, joints or kinds have changed since the last step; ask before they change");
  const MotionRecord& motion = world.groups.front().motion;
  const double begin = motion.begin(), end = motion.end(), slack = 1e-9 * (end - begin);
  PANTIN_EXPECTS(t >= begin - slack && t <= end + slack,
                 "time " + text_of(t) + " s is not inside the last step, which went from " + text_of(begin) +
                     " to " + text_of(end) + " s");
  const double inside = std::clamp(t, begin, end);
  std::vector<double> q, v;
  for (StepGroup& group : world.groups) {
    q.resize(group.dynamics->coordinates());
    v.resize(group.dynamics->velocities());
    group.motion.evaluate(std::min(inside, group.motion.end()), q, v);
    group.dynamics->place({inside, Side::Before}, q, v);
  }
  return world.room.stage;
}

}  // namespace pantin
