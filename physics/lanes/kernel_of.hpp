#pragma once
// All that is compiled for each instruction set, as a Kernel.
#include <pantin/physics/lanes/loop_kernel.hpp>
#include <pantin/physics/lanes/stage_sums.hpp>
#include <pantin/physics/lanes/tree_kernel.hpp>

namespace pantin::lanes {

template <class T>
Kernel kernel_of(InstructionSet set) {
  using Trees = TreeKernel<T>;
  using Loops = LoopKernel<T>;
  return {.set = set,
          .lanes = T::kCount,
          .work_size = Trees::work_size,
          .outward = Trees::outward,
          .add_wrench = Trees::add_wrench,
          .solve = Trees::solve,
          .loop_size = Loops::work_size,
          .trace = Loops::trace,
          .close = Loops::close,
          .free_rates = Trees::free_rates,
          .sum_stages = sum_stages<T>};
}

}  // namespace pantin::lanes
