#pragma once
// Random numbers as a function of seed, stream and draw, the same on every machine: the finaliser of
// splitmix64 (G. Steele, D. Lea, C. Flood, OOPSLA 2014) over a counter. Private to physics.
#include <cstdint>

namespace pantin {

class RandomDraws {
 public:
  RandomDraws(std::uint64_t seed, std::uint64_t stream) : state_{mixed(mixed(seed) + stream)} {}
  /// The next number, evenly in [0, 1).
  double operator()() {
    state_ += 0x9e3779b97f4a7c15ull;
    return static_cast<double>(mixed(state_) >> 11) * 0x1p-53;
  }

 private:
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
  }
  std::uint64_t state_;
};

}  // namespace pantin
