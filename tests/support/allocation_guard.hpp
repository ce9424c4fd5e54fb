#pragma once
// Counts allocations of the whole program, to prove that something allocates nothing. Works in executables
// that contain physics/allocation_guard_test.cpp, where the counting is.
#include <cstddef>

namespace pantin::test {

/// Allocations since the program started, of all threads: every call of operator new, and, where no sanitizer
/// owns the heap, every call of malloc and its kin (dynamic matrices of Eigen come from there).
[[nodiscard]] std::size_t allocations_so_far() noexcept;

/// Counts from where it was made.
class AllocationGuard {
 public:
  [[nodiscard]] std::size_t count() const noexcept { return allocations_so_far() - start_; }

 private:
  std::size_t start_{allocations_so_far()};
};

}  // namespace pantin::test
