#pragma once
// Private to scenegraph. The kernels of `Scene::update`: products of 3x4 matrices along the dense arrays, for
// each instruction set.
#include <cstdint>
#include <span>

#include <pantin/scenegraph/affine.hpp>
#include <pantin/scenegraph/index_range.hpp>
#include <pantin/scenegraph/instruction_set.hpp>

namespace pantin {

/// c = a * b, all extended by the row (0, 0, 0, 1). c may be a or b.
using MultiplyFunction = void(const double* a, const double* b, double* c) noexcept;
/// worlds[i] = worlds[parents[i]] * locals[i] for i in each of the ranges, none of which is empty; needs
/// parents[i] < i. Worlds that are read and not written must be right already.
using SweepFunction = void(const double* locals, const std::uint32_t* parents, double* worlds,
                           const IndexRange* ranges, std::size_t count) noexcept;

/// The functions compiled for one instruction set; all of them give the same bits. Matrices are twelve
/// doubles each, by rows; pointers need no more alignment than a double.
struct SweepKernel {
  InstructionSet set{InstructionSet::Baseline};
  MultiplyFunction* multiply{nullptr};
  SweepFunction* sweep{nullptr};              ///< one range after the other, ascending
  SweepFunction* sweep_independent{nullptr};  ///< in any order: no node may have its parent in another range
};

/// Those that this processor runs, the baseline first, the best last.
[[nodiscard]] std::span<const SweepKernel> sweep_kernels() noexcept;
/// The kernel of a set that `runs_here`.
[[nodiscard]] const SweepKernel& sweep_kernel(InstructionSet set) noexcept;

/// a * b, both extended by the row (0, 0, 0, 1): the bits of every kernel.
[[nodiscard]] Matrix34 multiply(const Matrix34& a, const Matrix34& b) noexcept;

}  // namespace pantin
