#pragma once
// Private to bridge. Whether something is the same to the last bit: what decides that a node need not be
// written.
#include <cstring>

#include <pantin/physics/pose.hpp>
#include <pantin/scenegraph/affine.hpp>

namespace pantin {

[[nodiscard]] inline bool same_bits(const Affine& a, const Affine& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * 16) == 0;
}
[[nodiscard]] inline bool same_bits(const Pose& a, const Pose& b) {
  return std::memcmp(a.p.data(), b.p.data(), sizeof(double) * 3) == 0 &&
         std::memcmp(a.q.coeffs().data(), b.q.coeffs().data(), sizeof(double) * 4) == 0;
}

}  // namespace pantin
