// Which kernels there are. The processor is asked once; nothing else is global.
#include <array>

#include <pantin/scenegraph/sweep.hpp>

namespace pantin {

// Defined by sweep_kernel.inc, compiled once for each.
namespace sweep_baseline {
MultiplyFunction multiply;
SweepFunction sweep;
SweepFunction sweep_independent;
}  // namespace sweep_baseline
#if defined(__x86_64__)
namespace sweep_avx2 {
MultiplyFunction multiply;
SweepFunction sweep;
SweepFunction sweep_independent;
}  // namespace sweep_avx2
#endif

namespace {

constexpr std::array kKernels {
  SweepKernel{InstructionSet::Baseline, &sweep_baseline::multiply, &sweep_baseline::sweep,
              &sweep_baseline::sweep_independent},
#if defined(__x86_64__)
      SweepKernel{InstructionSet::Avx2, &sweep_avx2::multiply, &sweep_avx2::sweep,
                  &sweep_avx2::sweep_independent},
#endif
};

std::size_t count_running() noexcept {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") ? 2 : 1;  // also asks whether the system keeps the wide registers
#else
  return 1;
#endif
}

}  // namespace

std::span<const SweepKernel> sweep_kernels() noexcept {
  static const std::size_t running = count_running();
  return {kKernels.data(), running};
}

const SweepKernel& sweep_kernel(InstructionSet set) noexcept {
  const std::span<const SweepKernel> kernels = sweep_kernels();
  for (const SweepKernel& kernel : kernels)
    if (kernel.set == set) return kernel;
  return kernels.back();
}

bool runs_here(InstructionSet set) noexcept {
  return set == InstructionSet::Best || sweep_kernel(set).set == set;
}

std::string_view to_string(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::Best:
      return "best";
    case InstructionSet::Baseline:
      return "baseline";
    case InstructionSet::Avx2:
      return "avx2";
  }
  return "unknown";
}

Matrix34 multiply(const Matrix34& a, const Matrix34& b) noexcept {
  Matrix34 c;
  sweep_baseline::multiply(a.m.data(), b.m.data(), c.m.data());
  return c;
}

}  // namespace pantin
