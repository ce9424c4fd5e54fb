#pragma once
// What all integrators need: the check of a step's arguments, work space that only grows, and fused loops
// over plain arrays (independent iterations, so that compilers turn them into vector instructions).
#include <cstddef>
#include <span>
#include <vector>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

/// Contract of Integrator::step: finite t, finite h > 0, q and v of the sizes that `dynamics` states.
void expect_step(const Dynamics& dynamics, double t, double h, std::span<const double> q,
                 std::span<const double> v);

/// Arrays for one step, cut from one block that is kept and only ever grows.
class WorkSpace {
 public:
  /// Makes room for `count` numbers; arrays taken before become invalid.
  void reserve(std::size_t count) {
    if (numbers_.size() < count) numbers_.resize(count);
    used_ = 0;
  }
  /// The next `count` numbers of the room, with any content.
  [[nodiscard]] std::span<double> take(std::size_t count) {
    used_ += count;
    return std::span<double>{numbers_}.subspan(used_ - count, count);
  }

 private:
  std::vector<double> numbers_{};
  std::size_t used_{0};
};

/// x += s d
inline void add_scaled(std::span<double> x, double s, std::span<const double> d) {
  double* to = x.data();
  const double* from = d.data();
  for (std::size_t i = 0, n = x.size(); i < n; ++i) to[i] += s * from[i];
}

/// out = x + s d
inline void set_sum(std::span<double> out, std::span<const double> x, double s, std::span<const double> d) {
  double* to = out.data();
  const double* base = x.data();
  const double* from = d.data();
  for (std::size_t i = 0, n = out.size(); i < n; ++i) to[i] = base[i] + s * from[i];
}

}  // namespace pantin
