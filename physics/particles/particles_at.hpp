#pragma once
// Particles at one instant, as force laws see them: a batch of one system, as arrays. During a step a batch
// may be a part of its system, and a law sees it at a stage of the integrator.
#include <cstdint>
#include <span>

#include <pantin/physics/driver.hpp>
#include <pantin/physics/ids.hpp>
#include <pantin/physics/pose.hpp>

namespace pantin {

/// Position of a particle in arrays of `count` that are sorted by serial, where empty `serials` mean 0, 1, 2,
/// ...; `count` where it is not there.
[[nodiscard]] std::size_t position_of_serial(std::span<const std::uint64_t> serials, std::size_t count,
                                             std::uint64_t wanted);

struct ParticlesAt {
  double t{0};  ///< [s]
  Side side{Side::After};
  ParticleSystemId system{};
  std::span<const double> x{}, y{}, z{};     ///< [m], in W
  std::span<const double> vx{}, vy{}, vz{};  ///< [m/s], in W
  std::span<const double> mass{};            ///< [kg]

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] Vector3 p_WP(std::size_t i) const { return {x[i], y[i], z[i]}; }
  [[nodiscard]] Vector3 v_WP(std::size_t i) const { return {vx[i], vy[i], vz[i]}; }
};

/// Forces on the particles of a batch [N], in W; laws add to them.
struct ParticleForces {
  std::span<double> x{}, y{}, z{};

  void add(std::size_t i, const Vector3& f_W) const {
    x[i] += f_W.x();
    y[i] += f_W.y();
    z[i] += f_W.z();
  }
};

/// Which particles a force law acts on, and how.
enum class ParticleAction : std::uint8_t {
  None,
  Each,     ///< on each by itself: a function of time and of that particle alone; particles go in batches
  Coupled,  ///< on particles and bodies, or on particles among each other: whole systems, integrated with the
            ///< bodies
};

/// A whole system under a coupled law: who is there, and the forces to be added to.
struct CoupledParticles {
  ParticlesAt at{};
  ParticleForces force{};
  std::span<const std::uint64_t> serial{};  ///< ascending; empty = 0, 1, 2, ...

  /// Position of a particle in the arrays; at.size() where it is not there (any more).
  [[nodiscard]] std::size_t position_of(std::uint64_t wanted) const {
    return position_of_serial(serial, at.size(), wanted);
  }
};

}  // namespace pantin
