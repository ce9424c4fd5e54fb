#pragma once
// The clock of the benchmarks: processor time of this thread, which other programs do not lengthen by
// waiting.
#include <time.h>

#include <functional>

namespace pantin::bench {

/// [s]
inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Of one run of `work` [s].
inline double seconds_of(const std::function<void()>& work) {
  const double start = cpu_seconds();
  work();
  return cpu_seconds() - start;
}

}  // namespace pantin::bench
