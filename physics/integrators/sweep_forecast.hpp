#pragma once
// What the series of a Gauss step says of the next one: where its iteration starts best, and at which length
// it is likely to take the fewest sweeps a second. A motion with a pole nearby, in complex time, has a series
// whose terms grow beyond the step; the least of them tells how well it can be continued, as in any
// asymptotic series.
#include <array>
#include <cstddef>

#include <pantin/physics/integrators/collocation.hpp>

namespace pantin {

/// How large the Legendre coefficients of the slopes of a step are, over all numbers: those of q' as motion,
/// those of v' as motion per unit time.
struct SeriesSizes {
  int stages{0};
  std::array<double, kMostNodes> q{}, v{};
  /// Of coefficient k, as motion in a step of h.
  [[nodiscard]] double at(std::size_t k, double h) const { return q[k] > h * v[k] ? q[k] : h * v[k]; }
};

/// How the iteration of a step went: what the first sweep changed, and the last one.
struct Settling {
  double ratio{0};  ///< of the step to the one that it continued; 0 = it continued none
  int sweeps{0};
  double first{0}, last{0};
};

/// The series of a step at the nodes of the next one, `ratio` times as long and lasting h, as
/// legendre_at_nodes has it, broken off before its least term node by node.
[[nodiscard]] NodeMatrix continuation(const Collocation& method, const SeriesSizes& sizes, double ratio,
                                      double h);

/// How long a next step should be for the sake of its iteration, in parts of a step of h that went so, where
/// changes up to `enough` count as settled: 0.5 to 2.
[[nodiscard]] double cheapest_ratio(const SeriesSizes& sizes, const Settling& settling, double h,
                                    double enough);

}  // namespace pantin
