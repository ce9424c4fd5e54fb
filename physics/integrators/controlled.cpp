#include <pantin/physics/integrators/controlled.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pantin/physics/integrators/step_arrays.hpp>

namespace pantin {
namespace {

/// Parts shorter than this (of the time reached and the step asked for) are not tried.
constexpr double kShortest = 1e-14;
/// A step that is given is cut into no shorter parts than this many; a call that refuses more parts than this
/// has met motion that no step resolves.
constexpr double kMostParts = 1e4;
constexpr int kMostRefusals = 1000000;

}  // namespace

bool ControlledIntegrator::is_controlled() const { return std::isfinite(tolerance_); }

void ControlledIntegrator::step(Dynamics& dynamics, double t, double h, std::span<double> q,
                                std::span<double> v) {
  expect_step(dynamics, t, h, q, v);
  control_.accepted = control_.refused = 0;
  control_.shortest = h;
  if (q.empty() && v.empty()) return;
  begin(dynamics, t, h, q, v);
  const double end = t + h;
  const double floor = std::max(kShortest * (std::abs(t) + h), is_controlled() ? 0 : h / kMostParts);
  double next = is_controlled() ? first_part(t, h, q, v) : h, done = 0;
  while (done < h) {
    const double rest = h - done;
    // Two equal parts to the end rather than a long and a very short one.
    const bool last = next >= rest - floor;
    const double length = last ? rest : (next > 0.5 * rest ? 0.5 * rest : next);
    const Part part{.t = last ? end - length : t + done,
                    .h = length,
                    .end = last ? end : t + done + length,
                    .last = last};
    const Outcome outcome = attempt(part, q, v);
    if (!outcome.accepted) {
      ++control_.refused;
      next = length * outcome.factor;
      if (next >= floor && control_.refused <= kMostRefusals) continue;
      // No part is short enough. The manager finds what is not finite and keeps the state before.
      control_.memory = {};
      std::fill(v.begin(), v.end(), std::numeric_limits<double>::quiet_NaN());
      return;
    }
    accept(part, q, v);
    ++control_.accepted;
    control_.shortest = std::min(control_.shortest, length);
    // A part cut short by the end of the step says nothing against the one proposed before.
    const double proposed = length * outcome.factor;
    next = last ? std::max(next, proposed) : proposed;
    done = last ? h : done + length;
  }
  control_.memory.next = next;
  finish(q, v);
}

ControlledIntegrator::Outcome ControlledIntegrator::decide(double error, const Rule& rule) const {
  const double ratio = error / tolerance_;
  const double factor = ratio > 0 ? rule.safety * std::pow(ratio, -1 / rule.order) : rule.grow_most;
  if (!(ratio <= rule.overshoot)) {  // too far off, or not a number
    return {false, std::clamp(std::isfinite(factor) ? factor : 0, rule.shrink_most, 0.9)};
  }
  return {true, std::clamp(factor, rule.shrink_most, rule.grow_most)};
}

}  // namespace pantin
