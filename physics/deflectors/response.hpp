#pragma once
// What a surface does to a particle at a contact: bounce, friction, stickiness, and the impulse that is given
// back.
#include <cstdint>

#include <pantin/physics/deflectors/deflector_manager.hpp>

namespace pantin {

/// A particle on its way.
struct MovingParticle {
  ParticlePath path{};
  double mass{1};
  double radius{0};
  /// Velocity at the end where it is not the path's: the particle comes to rest on a surface before [m/s].
  Vector3 v_end{Vector3::Zero()};
  bool ends_otherwise{false};

  [[nodiscard]] Vector3 end_position() const { return path.at(1); }
  [[nodiscard]] Vector3 end_velocity() const { return ends_otherwise ? v_end : path.velocity(1); }
};

enum class Response : std::uint8_t {
  Bounced,
  Slides,  ///< pressed to the surface for the rest of the update
  Sticks,  ///< carried by the deflector from now on
};

/// Turns the particle's path at the contact and gives the deflector's body its part.
[[nodiscard]] Response respond(MovingParticle& particle, const SurfaceContact& contact,
                               const Deflector& deflector, DeflectorManager& deflectors);

}  // namespace pantin
