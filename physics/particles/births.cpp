// Which particles are born in an update, where and how. Births have times of their own within the update;
// each goes from there to the update's end.
#include <algorithm>
#include <cmath>

#include <pantin/physics/particles/particle_world.hpp>

namespace pantin {

namespace {

/// Births of the rate that fall before `end`.
std::uint64_t rated_until(const EmitterSettings& settings, double end) {
  const double since = std::min(end, settings.stop) - settings.start;
  if (!(since > 0) || settings.rate == 0) return 0;
  return static_cast<std::uint64_t>(std::min(std::ceil(since * settings.rate), 1e18));
}

}  // namespace

DeflectorMotion ParticleManager::Impl::motion_of(BodyId body, double h) const {
  DeflectorMotion motion;
  if (!body) return motion;
  const std::size_t i = bodies.at(body);
  motion.carry(before[i], bodies.state.kinematics[i], h, -bodies.mass[i].p_BBcm, Quaternion::Identity());
  return motion;
}

void ParticleManager::Impl::plan_births(std::size_t k, double t, double h) {
  SystemData& data = systems[k];
  const ParticleSystemState& now = state(k);
  data.due.clear();
  data.emitters_next = now.emitters;
  for (std::size_t e = 0; e < data.emitters.size(); ++e) {
    const EmitterSettings& settings = data.emitters[e].settings;
    EmitterState& done = data.emitters_next[e];
    const DeflectorMotion motion = motion_of(settings.body, h);
    const auto bear = [&](double time, std::uint64_t count) {
      const std::size_t room = room_in(k);
      const std::uint64_t born = std::min<std::uint64_t>(count, room);
      report.dropped += count - born;
      const double s = std::clamp((time - t) / h, 0.0, 1.0);
      for (std::uint64_t j = 0; j < born; ++j) {
        const Birth birth = birth_of(settings, done.draws + j);
        const Vector3 p_WP = motion.to_world(settings.X_BE * birth.p_EP, s);
        const Vector3 v_WP =
            motion.rotation(s) * (settings.X_BE.q * birth.v_EP) + settings.inherit * motion.velocity(p_WP, s);
        const std::size_t i = now.size() + data.due.size();
        data.next.resize(i + 1);
        data.next.set(i, p_WP, v_WP);
        data.due.push_back({std::max(time, t), time + birth.lifetime});
      }
      done.draws += count;
    };
    for (; done.burst < settings.bursts.size() && settings.bursts[done.burst].time < t + h; ++done.burst) {
      bear(settings.bursts[done.burst].time, settings.bursts[done.burst].count);
    }
    const std::uint64_t until = rated_until(settings, t + h);
    while (done.emitted < until) {
      if (room_in(k) == 0) {
        report.dropped += until - done.emitted;
        done.draws += until - done.emitted;
        done.emitted = until;
        break;
      }
      bear(settings.start + static_cast<double>(done.emitted) / settings.rate, 1);
      ++done.emitted;
    }
  }
  report.born += data.due.size();
}

}  // namespace pantin
