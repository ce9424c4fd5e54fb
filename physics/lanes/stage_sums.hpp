#pragma once
// Sums over stages on any lane type: what an integrator does between two evaluations. Included once by each
// source that compiles it for an instruction set, as tree_kernel.hpp.
#include <pantin/physics/lanes/lane.hpp>
#include <pantin/physics/lanes/tree_lanes.hpp>

namespace pantin::lanes {

/// Of kGroups times as many stages as T has lanes.
template <class T, std::size_t kGroups>
inline void sum_groups(const StageSums& task) {
  constexpr std::size_t kLanes = T::kCount, kStages = kGroups * kLanes;
  T a[kStages][kGroups];
  for (std::size_t j = 0; j < kStages; ++j) {
    for (std::size_t g = 0; g < kGroups; ++g) a[j][g] = T::load((*task.a)[j].data() + g * kLanes);
  }
  const double* from = task.slopes;
  double* to = task.out;
  for (std::size_t n = 0; n < task.count; ++n, from += kStages, to += kStages) {
    T sum[kGroups];
    for (std::size_t j = 0; j < kStages; ++j) {
      for (std::size_t g = 0; g < kGroups; ++g) {
        sum[g] = j == 0 ? T(from[j]) * a[j][g] : sum[g] + T(from[j]) * a[j][g];
      }
    }
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (task.base != nullptr) sum[g] = T(task.base[n]) + T(task.h) * sum[g];
      sum[g].store(to + g * kLanes);
    }
  }
}

/// Of as many stages as T has lanes, or twice as many.
template <class T>
void sum_stages(const StageSums& task) {
  if (task.stages == T::kCount) return sum_groups<T, 1>(task);
  if (task.stages == 2 * T::kCount) sum_groups<T, 2>(task);
}

}  // namespace pantin::lanes
