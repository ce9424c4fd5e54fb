#pragma once
// Private to scenegraph. The kernel of `Scene::update`: products of 3x4 matrices along the dense arrays.
#include <cstdint>

#include <pantin/scenegraph/affine.hpp>

namespace pantin {

/// a * b, both extended by the row (0, 0, 0, 1). Same bits wherever it is called from.
[[nodiscard]] Matrix34 multiply(const Matrix34& a, const Matrix34& b) noexcept;

/// worlds[i] = worlds[parents[i]] * locals[i] for i in [begin, end), ascending; needs 0 < begin and
/// parents[i] < i.
void sweep(const Matrix34* locals, const std::uint32_t* parents, Matrix34* worlds, std::uint32_t begin,
           std::uint32_t end) noexcept;

}  // namespace pantin
