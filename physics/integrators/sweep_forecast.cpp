#include <pantin/physics/integrators/sweep_forecast.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pantin {

namespace {

/// The first change is this many times the least term at the end of the step, until a step has shown it.
constexpr double kFirstChange = 4;
/// A step that settles in so few sweeps is not shortened for them: what they would save is less than the
/// rounding of many short steps costs near singular positions.
constexpr int kCheapSweeps = 8;
/// What a step costs besides its sweeps, in sweeps.
constexpr double kBesides = 1;
/// Contraction where a single sweep says nothing of it, and where it is hardly one.
constexpr double kUnknown = 0.05, kFastest = 1e-3, kSlowest = 0.9;

constexpr std::size_t kTries = 9;
/// 2^(-1), 2^(-3/4), ..., 2
constexpr std::array<double, kTries> kRatios{0.5, 0.5946035575013605, 0.7071067811865476, 0.8408964152537145,
                                             1,   1.1892071150027210, 1.4142135623730951, 1.6817928305074290,
                                             2};
constexpr double kLogOfStep = 0.17328679513998632;  // of one such ratio to the next

/// P_k at the ends of next steps of all these ratios, for k from 0.
constexpr std::array<std::array<double, kTries>, kMostNodes + 1> kGrowth = [] {
  std::array<std::array<double, kTries>, kMostNodes + 1> P{};
  for (std::size_t i = 0; i < kTries; ++i) {
    P[0][i] = 1, P[1][i] = 1 + 2 * kRatios[i];
    for (std::size_t k = 1; k < kMostNodes; ++k) {
      const auto n = static_cast<double>(k);
      P[k + 1][i] = ((2 * n + 1) * P[1][i] * P[k][i] - n * P[k - 1][i]) / (n + 1);
    }
  }
  return P;
}();

/// The least term of the series there, of two neighbours the greater, since every other may vanish by
/// symmetry; the term after the last is continued at the rate at which the last
/// ones fall off.
std::array<double, kTries> least_terms(const SeriesSizes& sizes, double h) {
  const auto s = static_cast<std::size_t>(sizes.stages);
  const auto of_pair = [&](std::size_t k) { return std::max(sizes.at(k, h), sizes.at(k + 1, h)); };
  const double last = of_pair(s - 2), ahead = s < 4 ? last : of_pair(s - 4);
  const double beyond = last < ahead ? last * std::sqrt(last / ahead) : last;
  std::array<double, kTries> least{};
  for (std::size_t i = 0; i < kTries; ++i) least[i] = beyond * kGrowth[s][i];
  for (std::size_t k = 1; k + 1 < s; ++k) {
    for (std::size_t i = 0; i < kTries; ++i) {
      const double term = std::max(sizes.at(k, h) * kGrowth[k][i], sizes.at(k + 1, h) * kGrowth[k + 1][i]);
      least[i] = std::min(least[i], term);
    }
  }
  return least;
}

}  // namespace

NodeMatrix continuation(const Collocation& method, const SeriesSizes& sizes, double ratio, double h) {
  NodeMatrix P = legendre_at_nodes(method, 1, ratio);
  const auto s = static_cast<std::size_t>(method.nodes);
  std::array<double, kMostNodes> least{}, keep{};  // all nodes side by side
  least.fill(std::numeric_limits<double>::infinity());
  for (std::size_t k = 1; k + 1 < s; ++k) {
    const double size = sizes.at(k, h), next = sizes.at(k + 1, h), number = static_cast<double>(k);
    for (std::size_t i = 0; i < kMostNodes; ++i) {
      const double term = std::max(size * P[k][i], next * P[k + 1][i]);
      keep[i] = term <= least[i] ? number : keep[i];
      least[i] = std::min(term, least[i]);
    }
  }
  for (std::size_t k = 1; k < s; ++k) {
    // Where the last two terms are the least, there is nothing to break off yet.
    const double number = static_cast<double>(k), whole = static_cast<double>(s) - 2;
    for (std::size_t i = 0; i < kMostNodes; ++i) P[k][i] = keep[i] <= number && keep[i] < whole ? 0 : P[k][i];
  }
  return P;
}

double cheapest_ratio(const SeriesSizes& sizes, const Settling& settling, double h, double enough) {
  if (sizes.stages < 2 || !(enough > 0)) return kRatios.back();
  double contraction = kUnknown;
  if (settling.sweeps > 1) {
    contraction = std::pow(settling.last / settling.first, 1.0 / (settling.sweeps - 1));
    contraction = std::clamp(contraction, kFastest, kSlowest);
  }
  const double log_contraction = std::log(contraction), slowest = std::log(kSlowest);
  const std::array<double, kTries> least = least_terms(sizes, h);
  double first = kFirstChange;
  if (settling.ratio > 0) {
    // The series of this step is much like that of the one before, and its terms grow by powers.
    const double place = std::clamp(4 + std::log(settling.ratio) / kLogOfStep, 0.0, kTries - 1.0);
    const auto below = static_cast<std::size_t>(std::min(place, kTries - 2.0));
    const double part = place - static_cast<double>(below);
    first = settling.first / (std::pow(least[below], 1 - part) * std::pow(least[below + 1], part));
  }
  double best = kRatios[0], best_cost = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kTries; ++i) {
    // Sweeps contract by a square of the step, as they do for forces of positions.
    const double speed = std::min(slowest, log_contraction + 2 * kLogOfStep * (static_cast<double>(i) - 4));
    const double sweeps = std::max(1.0, std::log(enough / (first * least[i])) / speed);
    const double cost = (sweeps + kBesides) / kRatios[i];
    if (cost < best_cost) best_cost = cost, best = kRatios[i];
  }
  return settling.sweeps <= kCheapSweeps ? std::max(best, 1.0) : best;
}

}  // namespace pantin
