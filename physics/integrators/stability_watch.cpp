#include <pantin/physics/integrators/stability_watch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pantin {
namespace {

/// A direction is tried this far [m or rad; rates as far as they go at the rate that matters].
constexpr double kTrial = 1e-6;
/// Turns of the direction: at the first look, at later ones; fewer where rates are clearly low or settled.
constexpr int kMostTurns = 40, kFewTurns = 8;
/// Rates below this part of what is borne are far from mattering.
constexpr double kFarBelow = 0.1;
/// A rate has settled where a turn changes it by less than this part.
constexpr double kSettled = 0.03;
/// Estimates come from below, and the motion goes on: steps stay inside the region by this factor.
constexpr double kMargin = 1.25;

}  // namespace

double StabilityWatch::product(std::span<const double> x, std::span<const double> y) const {
  double sum = 0;
  for (std::size_t i = 0; i < y.size(); ++i) sum += weight_[i] * weight_[i] * x[i] * y[i];
  return sum;
}

void StabilityWatch::start(std::size_t count, StabilityMemory& memory) {
  // Every number takes part; the signs follow no pattern that a mechanism may have.
  memory.direction.resize(count);
  std::uint64_t bits = 0x9e3779b97f4a7c15ull;
  for (std::size_t i = 0; i < count; ++i) {
    bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
    memory.direction[i] = (bits & 1u ? 1 : -1) / weight_[i];
  }
  const double length = std::sqrt(product(memory.direction, memory.direction));
  for (double& x : memory.direction) x /= length;
}

double StabilityWatch::fastest_rate(Dynamics& dynamics, Instant at, std::span<const double> q,
                                    std::span<const double> v, double enough, StabilityMemory& memory) {
  const std::size_t nq = q.size(), n = nq + v.size();
  const bool known = memory.direction.size() == n;
  const int kept = memory.rate < kFarBelow * enough ? kSteps : kStepsNear;
  if (known && enough > 0.5 * memory.enough && ++memory.age < kept) return memory.rate;
  memory.age = 0;
  memory.enough = enough;
  memory.rate = 0;
  if (n == 0) return 0;
  for (std::vector<double>* x : {&weight_, &y_, &slope_, &there_, &before_}) x->resize(n);
  dynamics.weights(std::span{weight_}.first(nq), std::span{weight_}.subspan(nq));
  // Positions and rates have equal parts in a swing at the rate that matters.
  for (std::size_t i = nq; i < n; ++i) weight_[i] /= enough;
  if (!known) start(n, memory);

  const auto slope_at = [&](std::span<const double> y, std::span<double> out) {
    dynamics.derivative(at, y.first(nq), y.subspan(nq), out.first(nq), out.subspan(nq));
  };
  std::copy(q.begin(), q.end(), y_.begin());
  std::copy(v.begin(), v.end(), y_.begin() + static_cast<std::ptrdiff_t>(nq));
  slope_at(y_, slope_);
  const int most = known ? kFewTurns : kMostTurns;
  double stretch = 0;  // of the turn before
  for (int turn = 0; turn < most; ++turn) {
    for (std::size_t i = 0; i < n; ++i) y_[i] = (i < nq ? q[i] : v[i - nq]) + kTrial * memory.direction[i];
    slope_at(y_, there_);
    for (std::size_t i = 0; i < n; ++i) there_[i] = (there_[i] - slope_[i]) / kTrial;
    const double length = std::sqrt(product(there_, there_));
    if (!(length > 0) || !std::isfinite(length)) break;  // nothing changes, or nothing can be said
    const double before = memory.rate;
    memory.rate = turn == 0 ? length : rate_of_pair(memory.direction, stretch);
    stretch = length;
    std::swap(before_, memory.direction);
    memory.direction.resize(n);
    for (std::size_t i = 0; i < n; ++i) memory.direction[i] = there_[i] / length;
    const bool settled = turn > 2 && std::abs(memory.rate - before) < kSettled * memory.rate;
    if (settled || (turn >= kFewTurns - 1 && memory.rate < 0.25 * enough)) break;
  }
  return memory.rate;
}

/// Where two eigenvalues are left, which may be a pair of a swing, there_ = J z is their combination of z and
/// the direction before, z = J z_before / stretch: J z = alpha z + beta z_before, so that they are the roots
/// of x^2 - alpha x - stretch beta.
double StabilityWatch::rate_of_pair(std::span<const double> z, double stretch) const {
  const double c = product(z, before_), det = 1 - c * c, on_z = product(there_, z);
  if (det < 1e-12) return std::abs(on_z);  // one direction: one eigenvalue
  const double on_before = product(there_, before_);
  const double alpha = (on_z - c * on_before) / det, beta = (on_before - c * on_z) / det;
  const double half = 0.5 * alpha, square = half * half + stretch * beta;
  return square > 0 ? std::abs(half) + std::sqrt(square) : std::sqrt(-stretch * beta);
}

std::size_t StabilityWatch::fastest_velocity(Dynamics& dynamics, const StabilityMemory& memory) {
  const std::size_t nq = dynamics.coordinates(), n = memory.direction.size();
  weight_.resize(n);
  dynamics.weights(std::span{weight_}.first(nq), std::span{weight_}.subspan(nq));
  std::size_t most = 0;
  double greatest = 0;
  for (std::size_t i = nq; i < n; ++i) {
    const double part = weight_[i] * std::abs(memory.direction[i]);
    if (part > greatest) greatest = part, most = i - nq;
  }
  return most;
}

int parts_for(double rate, double h, const Integrator& integrator) {
  const double parts = kMargin * rate * h / integrator.stability_radius();
  return static_cast<int>(std::clamp(std::ceil(parts), 1.0, double{std::numeric_limits<int>::max()}));
}

}  // namespace pantin
