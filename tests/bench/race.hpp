#pragma once
// Contenders take turns at the same work, and the least time of each counts: what else the machine does
// lengthens times, it never shortens them.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "bench/cpu_time.hpp"

namespace pantin::bench {

struct Contender {
  std::string name{};
  std::function<void(int)> work{};                       ///< is given the number of the piece in its row
  double best{std::numeric_limits<double>::infinity()};  ///< [s], of one piece of work
};

/// Each in turn, `repeats` times. A turn is some pieces of work in a row, the first of which is not timed: it
/// brings back into the caches what the others pushed out.
inline void race(std::vector<Contender>& contenders, int repeats, int in_a_row = 1) {
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (Contender& contender : contenders) {
      contender.work(0);
      const double start = cpu_seconds();
      for (int k = 1; k <= in_a_row; ++k) contender.work(k);
      contender.best = std::min(contender.best, (cpu_seconds() - start) / in_a_row);
    }
  }
}

inline double best_of(const std::vector<Contender>& contenders, const std::string& name) {
  for (const Contender& contender : contenders)
    if (contender.name == name) return contender.best;
  return std::numeric_limits<double>::quiet_NaN();
}

/// One row a contender: time [us] and its ratio to that of the `reference`.
inline void print_rows(const std::string& title, const std::vector<Contender>& contenders,
                       const std::string& reference) {
  const double one = best_of(contenders, reference);
  for (const Contender& contender : contenders)
    std::printf("| %-34s | %-32s | %12.3f | %8.2f |\n", title.c_str(), contender.name.c_str(),
                1e6 * contender.best, contender.best / one);
}

}  // namespace pantin::bench
