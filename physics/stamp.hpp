#pragma once
// Numbers that tell what something was made of: 64-bit FNV-1a. Private to physics.
#include <cstdint>

namespace pantin {

inline constexpr std::uint64_t kStampSeed = 0xcbf29ce484222325ull;

/// The stamp with one more number mixed in.
[[nodiscard]] constexpr std::uint64_t stamped(std::uint64_t stamp, std::uint64_t x) {
  return (stamp ^ x) * 0x100000001b3ull;
}

}  // namespace pantin
