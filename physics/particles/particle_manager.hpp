#pragma once
// Owns the particle systems, with their emitters and ties. Reached by PhysicsManager::particles().
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <pantin/physics/bodies_at.hpp>
#include <pantin/physics/integrators/integrator.hpp>
#include <pantin/physics/particle_system.hpp>
#include <pantin/physics/particles/emitter.hpp>
#include <pantin/physics/particles/ties.hpp>
#include <pantin/physics/step_report.hpp>

namespace pantin {

class BodyStore;
class DeflectorManager;
class Dynamics;
class ForceManager;
class WorldDynamics;

/// Every id argument must be alive and every setting right, or the contract is broken. A verb changes what is
/// there at once; the next step goes on from it.
class ParticleManager {
 public:
  ParticleManager(BodyStore& bodies, ForceManager& forces, DeflectorManager& deflectors);
  ~ParticleManager();

  // Systems
  ParticleSystemId add(const ParticleSystemSettings& settings);
  void remove(ParticleSystemId id);
  [[nodiscard]] bool contains(ParticleSystemId id) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept;  ///< number of systems
  [[nodiscard]] std::vector<ParticleSystemId> ids() const;
  [[nodiscard]] ParticleSystem system(ParticleSystemId id) const;

  // Particles
  /// The system must have room (capacity).
  ParticleId add_particle(ParticleSystemId system, const ParticleSettings& particle);
  void remove(ParticleId id);
  void set_position(ParticleId id, const Vector3& p_WP);  ///< [m]; what lies between is not swept
  void set_velocity(ParticleId id, const Vector3& v_WP);  ///< [m/s]
  /// Lets a particle go that sticks to a deflector; it keeps its velocity.
  void unstick(ParticleId id);

  // Emitters
  EmitterId add_emitter(ParticleSystemId system, EmitterSettings settings);
  void remove(EmitterId id);

  // Ties and pins
  ParticleConstraintId add(const DistanceTie& settings);
  ParticleConstraintId add(const BendTie& settings);
  ParticleConstraintId add(const HingeTie& settings);
  void remove(ParticleConstraintId id);
  /// From now on the particle is where this point is.
  void pin(ParticleId id, const Attachment& to);
  void unpin(ParticleId id);

  /// The integrator of systems that are neither tied nor coupled with simulated bodies. Unless set (null
  /// unsets), it is another of the bodies', its tolerance included. One that chooses its steps does so batch
  /// by batch (ParticleBlock::kMost particles), from the whole step on; systems that laws couple with each
  /// other go together.
  void set_integrator(std::unique_ptr<Integrator> integrator);

  /// Kinetic and potential energy of all particles at the state reached [J].
  [[nodiscard]] Energy energy() const;

  // For PhysicsManager.
  [[nodiscard]] bool fits(std::span<const ParticleSystemState> states) const;  ///< same systems and emitters
  void reserve_again();             ///< after the state was replaced
  void remove_all_of(BodyId body);  ///< emitters and pins on it
  void integrator_of_bodies_changed();
  void begin_step();
  /// The one that was set; null = none.
  [[nodiscard]] Integrator* own_integrator() noexcept;
  [[nodiscard]] std::uint64_t integrator_revision() const noexcept;  ///< counts settings of it
  /// Before the bodies move: gathers what is integrated with these ones. Null = the bodies go alone.
  [[nodiscard]] Dynamics* begin_update(WorldDynamics& bodies);
  [[nodiscard]] std::span<double> coordinates_now();
  [[nodiscard]] std::span<double> velocities_now();
  void bodies_have_moved();
  /// After the bodies have moved from t [s] for h [s]. False = a particle is not finite; then nothing has
  /// changed, but for impulses on bodies.
  [[nodiscard]] bool update(double t, double h, const Integrator& integrator_of_bodies);
  [[nodiscard]] const ParticleReport& finish_step();
  [[nodiscard]] ParticleId not_finite() const noexcept;

 private:
  [[nodiscard]] std::size_t at(ParticleSystemId id) const;
  std::size_t position(ParticleId id, std::size_t& system) const;
  ParticleConstraintId add_tie(ParticleSystemId system, Tie tie);
  [[nodiscard]] Vector3 place(ParticleId id) const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pantin
