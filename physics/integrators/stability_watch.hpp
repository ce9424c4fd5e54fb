#pragma once
// How fast the fastest part of the motion is: whether a step that is given is one that an explicit integrator
// bears. The spectral radius of the derivative d(q', v')/d(q, v) by a nonlinear power method: differences
// along a direction that each look turns towards the fastest part (B. P. Sommeijer, L. F. Shampine, J. G.
// Verwer, RKC: an explicit solver for parabolic PDEs, 1997, 3.4, for the method and for keeping the
// direction).
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

/// What the watch keeps from look to look, as part of State.
struct StabilityMemory {
  double rate{0};                   ///< [1/s]
  int age{0};                       ///< steps since it was found
  double enough{0};                 ///< the rate that mattered then [1/s]
  std::uint64_t scene{0};           ///< the caller's: what it was found for
  std::vector<double> direction{};  ///< q and v of the fastest part, of length one in `Dynamics::weights`
};

class StabilityWatch {
 public:
  /// Greatest |eigenvalue| of the derivative [1/s], to some per cent: what decays fastest, or swings fastest.
  /// Known for kSteps steps, kStepsNear where it is not far below `enough`, then looked at again from the
  /// direction known; where the memory is empty, from any. `enough`: the rate that matters, > 0 [1/s]; lower
  /// ones need not be known as well.
  double fastest_rate(Dynamics& dynamics, Instant at, std::span<const double> q, std::span<const double> v,
                      double enough, StabilityMemory& memory);
  /// The velocity that takes the greatest part in the fastest motion, as it moves bodies.
  [[nodiscard]] std::size_t fastest_velocity(Dynamics& dynamics, const StabilityMemory& memory);

  static constexpr int kSteps = 32, kStepsNear = 4;

 private:
  void start(std::size_t count, StabilityMemory& memory);
  [[nodiscard]] double product(std::span<const double> x, std::span<const double> y) const;
  [[nodiscard]] double rate_of_pair(std::span<const double> z, double stretch) const;

  std::vector<double> weight_{}, y_{}, slope_{}, there_{}, before_{};
};

/// Into how many equal parts a step h has to be cut so that an integrator bears motion of this rate.
[[nodiscard]] int parts_for(double rate, double h, const Integrator& integrator);

}  // namespace pantin
