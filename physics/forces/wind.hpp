#pragma once
// Wind with gusts, the same everywhere, and the drag that it exerts: F = -(c + d |v - u|) (v - u) at the
// centre of gravity. It has no potential and depends on time and velocity.
//
// The gusts are a sum of harmonics along each axis of W, u = mean + rms sqrt(2/n) sum cos(omega_k t + phi_k):
// a smooth function of time (integrators keep their order) and of the seed alone. Frequencies and phases are
// drawn so that the power spectrum is that of Dryden's longitudinal gusts, S(omega) = (2 T / pi) rms^2 / (1 +
// (T omega)^2), cut off at `cutoff` / T: each of n bands of equal power holds one harmonic (MIL-F-8785C,
// 3.7.2). Over a long time the mean square along an axis is rms^2.
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct Wind {
  Vector3 mean{Vector3::Zero()};      ///< in W [m/s]
  Vector3 gust_rms{Vector3::Zero()};  ///< along the axes of W [m/s], each >= 0
  double gust_time{5};                ///< T, the time that a gust lasts [s], > 0
  double cutoff{20};                  ///< highest frequency times T [rad], > 0
  int harmonics{24};                  ///< along each axis, 1 .. 1000
  std::uint64_t seed{0};
  double linear_drag{0};         ///< c [N s/m], >= 0
  double quadratic_drag{0};      ///< d [N s^2/m^2], >= 0
  BodyId body{};                 ///< null, and no system = every simulated body and particle
  ParticleSystemId particles{};  ///< the particles of this system only
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const Wind& settings);
[[nodiscard]] std::unique_ptr<ForceLaw> make_law(const Wind& settings);

/// The velocity of the air, for whoever wants to see it.
class WindVelocity {
 public:
  explicit WindVelocity(const Wind& settings);  ///< without a problem
  /// u at time t [s], in W [m/s].
  [[nodiscard]] Vector3 operator()(double t) const;

 private:
  struct Harmonic {
    Vector3 frequency{Vector3::Zero()}, phase{Vector3::Zero()};
  };
  Vector3 mean_, amplitude_;
  std::vector<Harmonic> harmonics_{};
};

}  // namespace pantin
