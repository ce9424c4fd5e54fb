// A part of a step in which stops or dry friction may act: smooth motion from event to event. A smooth piece
// is integrated to the end on trial; where its record shows that a stop is reached, sliding comes to rest, or
// a hold no longer bears its load, it is integrated anew to there, to rounding, by the same integrator, so
// that the order of the integrator is kept between events (L. Shampine, S. Thompson, Computers & Mathematics
// with Applications 39, 43 (2000)). Where events crowd, the rest of the part is advanced by short steps of
// first order, which end whatever happens (stops/axis_steps.cpp).
#include <algorithm>
#include <cmath>

#include <pantin/physics/stops/guard_limits.hpp>
#include <pantin/physics/world.hpp>

namespace pantin {

namespace {

/// More smooth pieces in one part of a step are a crowd: this many, and one for each of these times [s].
constexpr double kMostPieces = 48, kPieceTime = 1e-3;
/// The short steps in a crowd: not longer than this [s], but no more than so many.
constexpr double kShortStep = 1e-3;
constexpr int kMostShortSteps = 64;
/// Integrations to meet an event; each leaves a small part of the miss of the one before.
constexpr int kMostAims = 8;
/// Pieces shorter than this, relative to the time reached and the part, are no motion.
constexpr double kNoTime = 1e-15;
constexpr int kMostHalvings = 80;

/// Where what holds a number begins to pass its bounds, between a, where nothing does, and b, where it was
/// found to: by false position with the Illinois rule (M. Dowell, P. Jarratt, BIT 11, 168 (1971)).
template <class ExcessAt>
AxisCrossing first_excess(double a, double b, AxisGuard::Excess at_b, ExcessAt excess_at) {
  double below = std::min(excess_at(a).amount, 0.0), above = at_b.amount;
  for (int i = 0; i < kMostHalvings && b - a > kNoTime * std::abs(b); ++i) {
    const double part = below < 0 ? below / (below - above) : 0.5;
    const double t = i % 4 == 3 ? 0.5 * (a + b) : a + part * (b - a);
    if (!(t > a && t < b)) break;
    const AxisGuard::Excess excess = excess_at(t);
    if (excess.amount > 0) {
      b = t, at_b = excess, above = excess.amount;
      below *= 0.5;
    } else {
      a = t, below = excess.amount;
      above *= 0.5;
    }
  }
  return {b, at_b.axis, AxisCrossing::Kind::Effort, at_b.upper, 0};
}

}  // namespace

bool PhysicsManager::Impl::guarded_update(double h) {
  State& state = bodies.state;
  const double begin = state.time, end = begin + h;
  bool good = true;
  double rest = h;
  for (int pieces = 0; good && rest > 0; ++pieces) {
    const bool crowd = pieces > kMostPieces + h / kPieceTime;
    const double taken = crowd ? rest : guarded_piece(rest);
    if (crowd) good = short_steps(rest);
    good = good && taken >= 0;
    if (taken == rest) break;
    state.time += taken;
    rest = end - state.time;
  }
  state.time = begin;
  return good;
}

PhysicsManager::Impl::Moving PhysicsManager::Impl::begin_update() {
  room.begin(bodies, constraints);
  dynamics.begin();
  if (Dynamics* both = particles.begin_update(dynamics)) {
    return {both, particles.coordinates_now(), particles.velocities_now(), true};
  }
  return {&dynamics, dynamics.coordinates_now(), dynamics.velocities_now(), false};
}

StepControl* PhysicsManager::Impl::integrate_now(const Moving& now, double h) {
  return advance(0, *now.system, h, now.q, now.v);
}

bool PhysicsManager::Impl::end_update(const Moving& now, double h) {
  const double t = bodies.state.time;
  if (now.coupled) particles.bodies_have_moved();
  if (has_failed(0)) return false;
  dynamics.write_back(t + h);
  return particles.update(t, h, *integrator);
}

/// One smooth piece of at most h [s] and the event at its end: the time it took, < 0 where numbers went
/// wrong.
double PhysicsManager::Impl::guarded_piece(double h) {
  State& state = bodies.state;
  const double t = state.time;
  Moving now = begin_update();
  const GuardedMotion here{*now.system, {t, Side::After}, now.q, now.v};
  if (guard.strike(here)) put_numbers(now);
  guard.decide(here);
  memory_before = state.memories.front();
  MotionRecord& motion = groups.front().motion;
  const std::size_t parts = motion.parts();
  const auto go = [&](double length) {
    guard.hold();
    StepControl* control = integrate_now(now, length);
    guard.let_go();
    return control;
  };
  StepControl* control = go(h);
  const std::optional<AxisCrossing> crossing = next_crossing(now, parts);
  if (!crossing) {
    if (control != nullptr) groups.front().note(*control);
    return end_update(now, h) ? h : -1;
  }
  double length = crossing->time - t;
  for (int aim = 0; aim < kMostAims; ++aim) {
    motion.keep_first(parts);
    state.memories.front() = memory_before;
    now = begin_update();
    if (!(length > kNoTime * (std::abs(t) + h))) break;
    control = go(length);
    const GuardedMotion reached{*now.system, {t + length, Side::Before}, now.q, now.v};
    const double miss = guard.miss(*crossing, reached);
    if (miss == 0) break;
    const double next = std::min(length - miss, h);
    if (!(next != length) || aim + 1 == kMostAims) break;
    length = next;
  }
  const bool takes_time = length > kNoTime * (std::abs(t) + h);
  guard.pass(*crossing, {*now.system, {t + (takes_time ? length : 0), Side::Before}, now.q, now.v});
  if (!takes_time) {
    put_numbers(now);
    return 0;
  }
  if (control != nullptr) groups.front().note(*control);
  return end_update(now, length) ? length : -1;
}

/// The first event on the record from part `first` on.
std::optional<AxisCrossing> PhysicsManager::Impl::next_crossing(const Moving& now, std::size_t first) {
  const MotionRecord& motion = groups.front().motion;
  const std::optional<AxisCrossing> crossing = guard.first_crossing(motion, first, now.system->coordinates());
  if (!guard.any_bounded_hold()) return crossing;
  trial_q.resize(now.q.size());
  trial_v.resize(now.v.size());
  const auto excess_at = [&](double t) {
    motion.evaluate(t, trial_q, trial_v);
    return guard.excess({*now.system, {t, Side::Before}, trial_q, trial_v});
  };
  double reached = motion.part(first).t;
  for (std::size_t part = first; part < motion.parts(); ++part) {
    const MotionRecord::Span at = motion.part(part);
    for (const double x : {0.5, 1.0}) {
      const double until = crossing ? crossing->time : motion.end();
      const double t = std::min(x < 1 ? at.t + x * at.h : at.t + at.h, until);
      if (t <= reached) continue;
      const AxisGuard::Excess excess = excess_at(t);
      if (excess.amount > 0) return first_excess(reached, t, excess, excess_at);
      reached = t;
    }
  }
  return crossing;
}

void PhysicsManager::Impl::put_numbers(const Moving& now) {
  State& state = bodies.state;
  const TreeLayout& layout = constraints.layout();
  const std::span<const double> q =
      std::span<const double>{now.q}.subspan(dynamics.coordinates() - layout.coordinates, layout.coordinates);
  const std::span<const double> v =
      std::span<const double>{now.v}.subspan(dynamics.velocities() - layout.rates, layout.rates);
  const Instant at{state.time, Side::After};
  constraints.ground_motions(bodies, at, grounds);
  for (const Tree& tree : layout.trees) {
    const bool same =
        std::equal(q.begin() + tree.q_begin, q.begin() + tree.q_end,
                   state.coordinates.begin() + tree.q_begin) &&
        std::equal(v.begin() + tree.v_begin, v.begin() + tree.v_end, state.rates.begin() + tree.v_begin);
    if (same) continue;
    std::copy(q.begin() + tree.q_begin, q.begin() + tree.q_end, state.coordinates.begin() + tree.q_begin);
    std::copy(v.begin() + tree.v_begin, v.begin() + tree.v_end, state.rates.begin() + tree.v_begin);
    constraints.commit(bodies, tree, grounds, at);
  }
}

bool PhysicsManager::Impl::short_steps(double h) {
  ++crowded;
  State& state = bodies.state;
  const double begin = state.time;
  const int count = static_cast<int>(std::clamp(std::ceil(h / kShortStep), 8.0, double{kMostShortSteps}));
  for (int i = 0; i < count; ++i) {
    state.time = begin + h * i / count;
    const double part = begin + h * (i + 1) / count - state.time;
    const Moving now = begin_update();
    const GuardedMotion here{*now.system, {state.time, Side::After}, now.q, now.v};
    const bool struck = guard.strike(here);
    if (guard.decide_over(here, part) || struck) put_numbers(now);
    guard.hold();
    if (const StepControl* control = integrate_now(now, part)) groups.front().note(*control);
    guard.let_go();
    if (!end_update(now, part)) return false;
  }
  return true;
}

void PhysicsManager::Impl::strike_now() {
  const Moving now = begin_update();
  if (guard.strike({*now.system, {bodies.state.time, Side::After}, now.q, now.v})) put_numbers(now);
  if (now.coupled) particles.bodies_have_moved();
}

}  // namespace pantin
