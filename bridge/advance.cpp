// Time: updates that fall due, toggles that land exactly on their times, and the scene written once they are
// done.
#include <algorithm>
#include <cmath>
#include <utility>

#include <pantin/bridge/bridge_impl.hpp>
#include <pantin/physics/setting_checks.hpp>
#include <pantin/scenegraph/expects.hpp>

namespace pantin {
namespace {

constexpr double kSlack = 1e-9;  // of a step: what counts as the same time

void count(AdvanceReport& report, double h) {
  ++report.updates;
  report.longest_update = std::max(report.longest_update, h);
  report.evaluations += report.last.evaluations;
  report.joint_events += report.last.joint_events;
  report.crowded += report.last.crowded;
  if (report.last.inner_steps == 0) return;
  const bool first = report.inner_steps == 0;
  report.inner_steps += report.last.inner_steps;
  report.shortest_step =
      first ? report.last.shortest_step : std::min(report.shortest_step, report.last.shortest_step);
}

}  // namespace

void Bridge::schedule(const Toggle& toggle) {
  Impl& bridge = *impl_;
  bridge.expect_alive(toggle.node, "schedule");
  PANTIN_EXPECTS(std::isfinite(toggle.time) && toggle.time >= time() - kSlack * clock().settings().step,
                 "schedule: the time " + std::to_string(toggle.time) + " s is past, it is " +
                     std::to_string(time()) + " s; call the verb itself");
  const auto after = std::upper_bound(bridge.toggles.begin(), bridge.toggles.end(), toggle,
                                      [](const Toggle& a, const Toggle& b) { return a.time < b.time; });
  bridge.toggles.insert(after, toggle);
  bridge.clock.land_on(toggle.time);
}

AdvanceReport Bridge::advance(double elapsed) {
  impl_->meet_physics_time();
  const double dropped = impl_->clock.dropped();
  impl_->clock.add(elapsed);
  AdvanceReport report = impl_->run_due();
  report.dropped = impl_->clock.dropped() - dropped;
  return report;
}

AdvanceReport Bridge::advance_until(double time) {
  impl_->meet_physics_time();
  impl_->clock.add_until(time);
  return impl_->run_due();
}

// Somebody may have stepped physics, or gone back to a snapshot.
void Bridge::Impl::meet_physics_time() {
  if (std::abs(physics.time() - clock.time()) <= kSlack * clock.settings().step) return;
  clock.restart(physics.time());
  for (const Toggle& toggle : toggles) clock.land_on(toggle.time);
}

AdvanceReport Bridge::Impl::run_due() {
  AdvanceReport report;
  forget_vanished();
  fire_toggles(report.notes);
  notice_moves();
  if (clock.next()) start_moves(physics.time(), clock.due_until());
  while (const std::optional<double> end = next_update()) {
    const double h = *end - physics.time();
    if (h > 0) report.last = physics.step(h);
    if (!report.last.ok()) {
      const auto culprit = by_body.find(report.last.body);
      if (culprit != by_body.end()) {
        report.notes.push_back(note(Severity::Error, culprit->second->node, report.last.message, ""));
      }
      break;
    }
    clock.reached(*end);
    if (h > 0 && !report.last.broken.empty()) forget_broken(report.last.broken, report.notes);
    count(report, h);
    tell_of_fast_motion(report.last, report.notes);
    if (toggle_is_due()) {
      write_scene(&report.notes);
      fire_toggles(report.notes);
    }
  }
  write_scene(&report.notes);
  scene.update();
  physics.clear_accumulators();
  report.time = physics.time();
  report.events = std::exchange(passed, {});
  return report;
}

void Bridge::Impl::tell_of_fast_motion(const StepReport& report, std::vector<Diagnostic>& notes) {
  const FastMotion& motion = report.fast;
  if (motion.rate == 0) return;
  const auto culprit = std::find_if(bindings.begin(), bindings.end(), [&](const auto& entry) {
    const Binding& binding = *entry.second;
    return motion.joint ? binding.joint == motion.joint : binding.body == motion.body;
  });
  if (culprit == bindings.end() || !fast.insert(culprit->first).second) return;
  const std::string name = motion.joint ? physics.joint(motion.joint).name : "";
  const std::string step = text_of(clock.settings().step), integrator{physics.integrator().name()};
  const std::string done = motion.implicitly ? "taken by the implicit midpoint rule"
                                             : "cut into " + std::to_string(motion.parts) + " parts";
  notes.push_back(note(Severity::Note, culprit->first,
                       (name.empty() ? "decays or swings" : "joint '" + name + "' decays or swings") +
                           " at " + std::to_string(std::lround(motion.rate)) + " /s, too fast for " +
                           integrator + " in steps of " + step + " s, which are " + done,
                       "take a shorter step, or an integrator for stiff motion (implicit-midpoint, radau)"));
}

std::optional<double> Bridge::Impl::next_update() const {
  const bool strides = clock.settings().stepping == Stepping::Adaptive && physics.holds_tolerance() &&
                       physics.particles().size() == 0;
  return strides ? clock.next_stop() : clock.next();
}

bool Bridge::Impl::toggle_is_due() const {
  return !toggles.empty() && toggles.front().time <= clock.time() + kSlack * clock.settings().step;
}

void Bridge::Impl::fire_toggles(std::vector<Diagnostic>& notes) {
  while (toggle_is_due()) {
    const Toggle toggle = toggles.front();
    toggles.erase(toggles.begin());
    if (!scene.contains(toggle.node)) {
      notes.push_back({Severity::Warning,
                       {},
                       "toggle at " + std::to_string(toggle.time) + " s",
                       "its node was removed from the scene, so nothing is toggled",
                       ""});
      continue;
    }
    std::vector<Diagnostic> said;
    switch (toggle.drive) {
      case Drive::Physics:
        said = self->hand_over(toggle.node, toggle.scope);
        break;
      case Drive::Scene:
        said = self->take_back(toggle.node, toggle.scope);
        break;
      case Drive::Static:
        said = self->fix(toggle.node, toggle.scope);
        break;
    }
    notes.insert(notes.end(), said.begin(), said.end());
  }
}

}  // namespace pantin
