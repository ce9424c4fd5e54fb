#pragma once
// Carries one particle through an update past all deflectors: finds the first contact, lets the surface
// respond, goes on with what is left of the update, a bounded number of times.
#include <cstdint>
#include <span>

#include <pantin/physics/deflectors/response.hpp>

namespace pantin {

struct SweepCounts {
  std::uint64_t deflections{0};  ///< contacts
  std::uint64_t pushed_out{0};   ///< particles found inside a deflector and put on its surface
  std::uint64_t unresolved{0};   ///< particles that met more surfaces than are followed in one update
  std::uint64_t stuck{0};        ///< particles that began to stick
};

class Sweep {
 public:
  /// Contacts followed in one update; after the last a particle ends where that contact was.
  static constexpr int kMostContacts = 16;

  explicit Sweep(DeflectorManager& deflectors) : deflectors_{deflectors} {}
  /// Lowers the gaps of a batch by all deflectors.
  void cull(const CullBatch& batch);
  /// Moves the particle along its path; returns the deflector that it sticks to at the end, else nullptr.
  Deflector* carry(MovingParticle& particle);
  SweepCounts counts{};

 private:
  struct Met {
    Deflector* deflector{nullptr};
    SurfaceContact contact{};
  };
  [[nodiscard]] Met first_met(const MovingParticle& particle, const Deflector* slides_on);

  DeflectorManager& deflectors_;
  TriangleList triangles_{};
};

}  // namespace pantin
