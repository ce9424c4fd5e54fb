// Replaces the allocator of this test program by one that counts, and tests the counting.
// With a sanitizer, which brings a heap of its own, only operator new is replaced, and forwards to malloc.
// Without one, malloc itself is: that also sees what goes around operator new, which ends in malloc anyway.
#include <support/allocation_guard.hpp>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Core>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define PANTIN_COUNTS_MALLOC 0
#else
#define PANTIN_COUNTS_MALLOC 1
#endif

namespace {

std::atomic<std::size_t> allocations{0};

void count() noexcept { allocations.fetch_add(1, std::memory_order_relaxed); }

}  // namespace

std::size_t pantin::test::allocations_so_far() noexcept {
  return allocations.load(std::memory_order_relaxed);
}

#if PANTIN_COUNTS_MALLOC

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* block, std::size_t size) {
  count();
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  count();
  *block = __libc_memalign(alignment, size);
  return *block != nullptr ? 0 : ENOMEM;
}
}

#else

namespace {

void* counted(std::size_t size) {
  count();
  if (void* block = std::malloc(size != 0 ? size : 1)) return block;
  throw std::bad_alloc{};
}

void* counted(std::size_t size, std::align_val_t alignment) {
  count();
  const std::size_t unit = static_cast<std::size_t>(alignment);
  if (void* block = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return block;
  throw std::bad_alloc{};
}

}  // namespace

// Where g++ takes only one of a pair into a caller, it does not see that the other is ours too.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

// The nothrow forms of the standard library call these; those of a sanitizer do not, so they stand here too.
void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return counted(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return counted(size, alignment); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return counted(size); }
void operator delete(void* block) noexcept { std::free(block); }
void operator delete[](void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete[](void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

#endif

namespace pantin::test {
namespace {

/// Keeps the compiler from leaving an allocation out.
template <class T>
void use(T* pointer) {
  asm volatile("" : : "r"(pointer) : "memory");
}

TEST(AllocationGuard, CountsNothingWhereNothingIsAllocated) {
  // Arithmetic on the stack and in memory that is there already.
  std::vector<double> numbers(100);
  const AllocationGuard guard;
  for (double& number : numbers) number += 1;
  use(numbers.data());
  numbers.clear();
  numbers.resize(50);
  EXPECT_EQ(guard.count(), 0U);
}

TEST(AllocationGuard, CountsEveryFormOfNew) {
  // One object, an array, an over-aligned object and a nothrow one: four allocations, and none for giving
  // them back.
  struct alignas(64) Wide {
    double numbers[8];
  };
  const AllocationGuard guard;
  {
    const std::unique_ptr<int> one{new int{1}};
    const std::unique_ptr<int[]> many{new int[10]};
    const std::unique_ptr<Wide> wide{new Wide{}};
    const std::unique_ptr<int> quiet{new (std::nothrow) int{1}};
    use(one.get());
    use(many.get());
    use(wide.get());
    use(quiet.get());
    EXPECT_EQ(guard.count(), 4U);
  }
  EXPECT_EQ(guard.count(), 4U);
}

TEST(AllocationGuard, CountsGrowingContainers) {
  // A vector that is filled one by one doubles its room at least a few times on the way to 1000.
  const AllocationGuard guard;
  std::vector<int> numbers;
  for (int i = 0; i < 1000; ++i) numbers.push_back(i);
  use(numbers.data());
  EXPECT_GE(guard.count(), 3U);
}

TEST(AllocationGuard, CountsDynamicMatricesWhereMallocIsCounted) {
  // Eigen takes its memory from malloc, past operator new; under a sanitizer this cannot be seen.
  const AllocationGuard guard;
  const Eigen::VectorXd numbers = Eigen::VectorXd::Zero(100);
  use(numbers.data());
  EXPECT_EQ(guard.count(), PANTIN_COUNTS_MALLOC ? 1U : 0U);
}

}  // namespace
}  // namespace pantin::test
