#include <pantin/bridge/problems/solve.hpp>

#include <time.h>

#include <algorithm>
#include <cmath>

#include <pantin/bridge/problems/rigid_ref.hpp>
#include <pantin/bridge/problems/solve_islands.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

using reference::BodySample;
using reference::Sample;

/// Processor time of this thread [s].
double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double attitude_error(const Quaternion& q, const Quaternion& q_ref) {
  const Quaternion difference = q.conjugate() * q_ref;
  return 2 * std::atan2(difference.vec().norm(), std::abs(difference.w()));
}

/// Keeps the greatest; what is not a number stays.
void count(std::optional<double>& greatest, double x) {
  if (!greatest || !(x <= *greatest)) greatest = x;
}

/// One run of a problem, from building to the last sample.
class Run {
 public:
  Run(const ReferenceProblem& problem, const SolveSettings& settings, SolveResult& result)
      : problem_{problem}, settings_{settings}, result_{result} {}

  /// False if the problem was refused.
  bool build() {
    Loaded<ReferenceInstance> built = instantiate(problem_, physics_);
    if (!built.value) {
      result_.status = SolveStatus::Refused;
      for (const Diagnostic& note : built.notes) {
        if (note.severity == Severity::Error) result_.messages.push_back(to_string(note));
      }
      return false;
    }
    built_ = std::move(*built.value);
    set_integrators(built_, settings_, result_.islands, physics_);
    result_.integrator = names_of_solvers(result_.islands);
    return true;
  }

  void run() {
    energy_at_start_ = energy_now();
    std::vector<double> times;
    for (const Sample& sample : problem_.samples) times.push_back(sample.t);
    if (times.empty()) times.push_back(problem_.duration);
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!advance_to(times[i])) return;
      static const Sample kNothing{};
      compare(problem_.samples.empty() ? kNothing : problem_.samples[i]);
      result_.states.push_back(state());
    }
    finish_energy();
  }

 private:
  bool advance_to(double t) {
    const double from = physics_.time(), interval = t - from;
    if (interval <= 0) return true;
    const double step = settings_.step.value_or(interval);
    const long steps = std::max(1L, std::lround(std::ceil(interval / step - 1e-9)));
    const double start = cpu_now();
    for (long i = 0; i < steps; ++i) {
      const StepReport report = physics_.step(interval / static_cast<double>(steps));
      if (!report.ok()) {
        result_.status = SolveStatus::Failed;
        result_.messages.push_back(report.message);
        return false;
      }
      result_.steps += std::max(report.inner_steps + report.particles.inner_steps, 1);
      result_.evaluations += report.evaluations + report.particles.evaluations;
      result_.loop_margin = std::min(result_.loop_margin, report.loop_margin);
      subdivided_ += settings_.step && report.inner_steps > 1 ? 1 : 0;
    }
    result_.cpu_seconds += cpu_now() - start;
    return true;
  }

  void compare(const Sample& sample) {
    for (const BodySample& expected : sample.bodies) {
      if (const auto particle = built_.particles.find(expected.name); particle != built_.particles.end()) {
        const reference::Particle now = at(particle->second);
        if (expected.p_WBcm) count(result_.position_error, (now.p_W - *expected.p_WBcm).norm());
        if (expected.v_WBcm) count(result_.velocity_error, (now.v_W - *expected.v_WBcm).norm());
        continue;
      }
      const auto found = built_.bodies.find(expected.name);
      if (found == built_.bodies.end()) continue;
      const RigidBody body = physics_.body(found->second);
      if (expected.p_WBcm) count(result_.position_error, (body.p_WBcm() - *expected.p_WBcm).norm());
      if (expected.q_WB) count(result_.attitude_error, attitude_error(body.q_WB(), *expected.q_WB));
      if (expected.v_WBcm) count(result_.velocity_error, (body.v_WBcm() - *expected.v_WBcm).norm());
    }
    const Energy energy = energy_now();
    if (sample.energy) {
      const reference::SampleEnergy& e = *sample.energy;
      for (const double part : {e.kinetic, e.potential_gravity, e.potential_elastic_or_central, e.total}) {
        energy_scale_ = std::max(energy_scale_, std::abs(part));
      }
      count(energy_error_, std::abs(energy.total() - e.total));
    }
    count(energy_change_, std::abs(energy.total() - energy_at_start_.total()));
    own_scale_ = std::max({own_scale_, energy.kinetic, std::abs(energy.potential)});
    result_.joint_drift = std::max(result_.joint_drift, physics_.joint_drift().distance);
  }

  [[nodiscard]] Energy energy_now() const {
    Energy energy = physics_.energy();
    const Energy particles = physics_.particles().energy();
    energy.kinetic += particles.kinetic;
    energy.potential += particles.potential;
    return energy;
  }

  [[nodiscard]] reference::Particle at(ParticleId id) const {
    const ParticleSystem system = physics_.particles().system(id.system);
    const std::size_t i = system.position_of(id);
    return {.mass = system.mass(i), .p_W = system.p_WP(i), .v_W = system.v_WP(i)};
  }

  [[nodiscard]] SolvedState state() const {
    SolvedState now{.t = physics_.time()};
    for (const reference::Body& body : problem_.bodies) {
      const RigidBody at = physics_.body(built_.bodies.find(body.name)->second);
      now.bodies.push_back({.name = body.name,
                            .mass = {},
                            .X_WB = {at.p_WBcm(), at.q_WB()},
                            .v_WBcm = at.v_WBcm(),
                            .w_WB = at.w_WB()});
    }
    for (const reference::Particle& particle : problem_.particles) {
      now.particles.push_back(at(built_.particles.find(particle.name)->second));
      now.particles.back().name = particle.name;
    }
    return now;
  }

  /// Whether nothing takes energy away or brings it.
  [[nodiscard]] bool keeps_energy() const {
    if (!problem_.kinematic_bodies.empty() || !problem_.contacts.empty()) return false;
    return std::all_of(problem_.forces.begin(), problem_.forces.end(), [](const reference::Force& force) {
      const auto* spring = std::get_if<reference::Spring>(&force);
      return (spring != nullptr && spring->damping == 0) ||
             std::holds_alternative<reference::CentralGravity>(force);
    });
  }

  void finish_energy() {
    if (subdivided_ > 0) {
      result_.messages.push_back(std::to_string(subdivided_) + " of " + std::to_string(result_.steps) +
                                 " steps had to be subdivided; give a shorter step");
    }
    if (energy_error_) {
      result_.energy_drift = *energy_error_ / (energy_scale_ > 0 ? energy_scale_ : 1);
    } else if (energy_change_ && keeps_energy()) {
      result_.energy_drift = *energy_change_ / (own_scale_ > 0 ? own_scale_ : 1);
    }
  }

  const ReferenceProblem& problem_;
  const SolveSettings& settings_;
  SolveResult& result_;
  PhysicsManager physics_{};
  ReferenceInstance built_{};
  Energy energy_at_start_{};
  std::optional<double> energy_error_{}, energy_change_{};
  double energy_scale_{0}, own_scale_{0};
  long subdivided_{0};
};

/// How loops are integrated where the choice is free.
enum class Loops {
  LikeTrees,
  Carefully,  ///< in short steps, which keep to their branch near singular positions
};

SolveResult solve_once(const ReferenceProblem& problem, const SolveSettings& settings, Loops loops) {
  SolveResult result{.problem = problem.name};
  result.islands = choose_solvers(problem, settings.tolerance);
  for (IslandChoice& island : result.islands) {
    if (loops == Loops::LikeTrees || !island.has_loop) continue;
    island.solver = "dormand-prince";
    island.reason = "closed loops near singular positions, where short steps keep to their branch";
  }
  for (IslandChoice& island : result.islands) {
    if (settings.integrator == "auto") continue;
    island.solver = settings.integrator;
    island.reason = "asked for";
  }
  result.integrator = names_of_solvers(result.islands);
  Run run{problem, settings, result};
  if (run.build()) run.run();
  return result;
}

/// Nearer to a singular position (StepReport::loop_margin) long steps may leave the branch that inertia
/// chooses; about 2 degrees.
constexpr double kNearSingular = 1e-3;

/// Where a stage happens to fall too near a singular position, slightly other steps do not.
constexpr int kMoreTries = 5;
constexpr double kStricter = 0.7;

}  // namespace

SolveResult solve(const ReferenceProblem& problem, const SolveSettings& settings) {
  SolveSettings now = settings;
  const bool may_vary = settings.integrator == "auto" && !settings.step;
  Loops loops = Loops::LikeTrees;
  double spent = 0;  // on a run that was thrown away [s]
  SolveResult best = solve_once(problem, now, loops);
  const bool has_loop = std::any_of(best.islands.begin(), best.islands.end(),
                                    [](const IslandChoice& island) { return island.has_loop; });
  if (may_vary && has_loop && (best.status == SolveStatus::Failed || best.loop_margin < kNearSingular)) {
    spent = best.cpu_seconds;
    loops = Loops::Carefully;
    best = solve_once(problem, now, loops);
  }
  for (int more = 0; may_vary && more < kMoreTries && best.status == SolveStatus::Failed; ++more) {
    now.tolerance *= kStricter;
    SolveResult stricter = solve_once(problem, now, loops);
    stricter.messages.insert(stricter.messages.begin(),
                             "not solved in the steps of a wider tolerance, but in those of " +
                                 text_of(now.tolerance) + ": " + best.messages.front());
    if (stricter.status == SolveStatus::Ok) best = std::move(stricter);
  }
  for (int repeat = 1; repeat < settings.repeats && best.status == SolveStatus::Ok; ++repeat) {
    SolveResult again = solve_once(problem, now, loops);
    best.cpu_seconds = std::min(best.cpu_seconds, again.cpu_seconds);
  }
  best.cpu_seconds += spent;
  return best;
}

}  // namespace pantin
