#include <pantin/physics/integrators/stage_arrays.hpp>

#include <pantin/physics/lanes/tree_lanes.hpp>

namespace pantin {

namespace {

/// By the kernel of this machine, or by plain loops for numbers of stages that fill no lanes.
void sum(const lanes::StageSums& task) {
  if (const lanes::Kernel* kernel = lanes::kernel_for_stages(task.stages)) return kernel->sum_stages(task);
  const std::size_t s = task.stages;
  const double* from = task.slopes;
  double* to = task.out;
  for (std::size_t n = 0; n < task.count; ++n, from += s, to += s) {
    for (std::size_t i = 0; i < s; ++i) {
      double all = 0;
      for (std::size_t j = 0; j < s; ++j) all += (*task.a)[j][i] * from[j];
      to[i] = task.base != nullptr ? task.base[n] + task.h * all : all;
    }
  }
}

}  // namespace

void add_stages(int stages, std::span<double> out, std::span<const double> base, double h,
                std::span<const double> slopes, const NodeMatrix& a) {
  if (base.empty()) return;
  sum({static_cast<std::size_t>(stages), base.size(), base.data(), h, slopes.data(), &a, out.data()});
}

void combine_stages(int stages, std::span<double> out, std::span<const double> slopes, const NodeMatrix& a) {
  const auto s = static_cast<std::size_t>(stages);
  sum({s, out.size() / s, nullptr, 0, slopes.data(), &a, out.data()});
}

}  // namespace pantin
