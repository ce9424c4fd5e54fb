#pragma once
// Sets of numbers that grow together (union-find with path halving; R. E. Tarjan, J. van Leeuwen, J. ACM 31,
// 245 (1984)).
#include <cstddef>
#include <numeric>
#include <vector>

namespace pantin {

class DisjointSets {
 public:
  /// Each of 0 to count - 1 by itself.
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  /// One number of the set that stands for all of it, until the set grows.
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// False if they were together before.
  bool join(std::size_t a, std::size_t b) {
    const std::size_t from = root(a), to = root(b);
    parent_[from] = to;
    return from != to;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace pantin
