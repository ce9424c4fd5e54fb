#pragma once
// What is integrated of particle systems: part of State. Arrays over the particles of a system, in order of
// birth; a death closes the gap, so serials stay sorted. An array that would hold one value for all is left
// empty.
#include <cstdint>
#include <limits>
#include <vector>

#include <pantin/physics/ids.hpp>
#include <pantin/physics/particles/particles_at.hpp>
#include <pantin/physics/pose.hpp>

namespace pantin {

/// Positions [m] and velocities [m/s] in W.
struct ParticleArrays {
  std::vector<double> x{}, y{}, z{};
  std::vector<double> vx{}, vy{}, vz{};

  [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
  void resize(std::size_t n) {
    for (std::vector<double>* a : {&x, &y, &z, &vx, &vy, &vz}) a->resize(n);
  }
  void reserve(std::size_t n) {
    for (std::vector<double>* a : {&x, &y, &z, &vx, &vy, &vz}) a->reserve(n);
  }
  [[nodiscard]] Vector3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
  [[nodiscard]] Vector3 velocity(std::size_t i) const { return {vx[i], vy[i], vz[i]}; }
  void set(std::size_t i, const Vector3& p, const Vector3& v) {
    x[i] = p.x(), y[i] = p.y(), z[i] = p.z();
    vx[i] = v.x(), vy[i] = v.y(), vz[i] = v.z();
  }
  friend bool operator==(const ParticleArrays&, const ParticleArrays&) = default;
};

/// A particle that sticks to a deflector and is carried by it.
struct StuckParticle {
  std::uint64_t serial{0};
  DeflectorId deflector{};
  Vector3 p_DP{Vector3::Zero()};  ///< in the deflector's frame [m]
  friend bool operator==(const StuckParticle&, const StuckParticle&) = default;
};

/// What an emitter has done so far; its random numbers are a function of this count and its seed.
struct EmitterState {
  EmitterId id{};
  std::uint64_t emitted{0};  ///< by its rate
  std::uint64_t burst{0};    ///< bursts done
  std::uint64_t draws{0};    ///< particles born, or dropped for want of room
  friend bool operator==(const EmitterState&, const EmitterState&) = default;
};

struct ParticleSystemState {
  ParticleSystemId id{};
  ParticleArrays now{};
  std::vector<double> mass{};           ///< [kg]; empty = the system's for all
  std::vector<double> death{};          ///< when [s]; empty = nobody dies
  std::vector<std::uint64_t> serial{};  ///< ascending; empty = 0, 1, 2, ...
  std::uint64_t next_serial{0};
  std::uint64_t population{0};         ///< counts changes of who is there
  std::vector<StuckParticle> stuck{};  ///< by serial
  std::vector<EmitterState> emitters{};

  [[nodiscard]] std::size_t size() const noexcept { return now.size(); }
  [[nodiscard]] std::uint64_t serial_of(std::size_t i) const { return serial.empty() ? i : serial[i]; }
  /// Position of a particle in the arrays; size() where it is not there.
  [[nodiscard]] std::size_t position_of(std::uint64_t wanted) const {
    return position_of_serial(serial, size(), wanted);
  }
  friend bool operator==(const ParticleSystemState&, const ParticleSystemState&) = default;
};

}  // namespace pantin
