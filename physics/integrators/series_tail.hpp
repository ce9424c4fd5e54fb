#pragma once
// What a Gauss step leaves out, seen from the Legendre coefficients of its slopes. Where the motion is
// resolved they fall off geometrically; the quadrature is exact up to number 2 s - 1, and number 2 s is the
// last known one, s - 1, continued at the rate at which the last ones fall off.
#include <algorithm>
#include <array>
#include <cmath>

#include <pantin/physics/integrators/stage_arrays.hpp>

namespace pantin {

struct SeriesTail {
  double share{0};  ///< error of the step, as a part of a coefficient; 0 = nothing but rounding
  int back{0};      ///< which one: 0 = the last, 1 = the one before
};

/// From the sizes of the last four coefficients, the last one first; sizes up to `noise` are rounding.
[[nodiscard]] inline SeriesTail tail_of(const std::array<double, 4>& sizes, int stages, double noise) {
  // Every other coefficient may vanish by symmetry: two neighbours against the two before them.
  const double last = std::max(sizes[0], sizes[1]);
  if (last <= noise) return {};
  const double decay = std::sqrt(last / std::max({sizes[2], sizes[3], noise}));
  const double missing = power(std::min(decay, 1.0), stages + 1);
  if (stages == 1 || sizes[0] >= decay * sizes[1]) return {missing, 0};
  return {missing * decay, 1};
}

}  // namespace pantin
