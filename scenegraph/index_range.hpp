#pragma once
// A run of positions in the dense arrays of a Scene. By itself, because code compiled for one instruction set
// alone (sweep_kernel.inc) may include nothing that brings functions along.
#include <cstddef>

namespace pantin {

/// Half-open range of positions in `Scene::order()` and `Scene::worlds()`.
struct IndexRange {
  std::size_t begin{0};
  std::size_t end{0};
};

}  // namespace pantin
