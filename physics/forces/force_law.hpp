#pragma once
// The family of forces. To add one: a file with a settings struct, problem_with(settings) and
// make_law(settings) that returns the law object; ForceManager::add finds them by the settings type. No list
// is to be edited.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <pantin/physics/bodies_at.hpp>
#include <pantin/physics/ids.hpp>
#include <pantin/physics/particles/particles_at.hpp>

namespace pantin {

class LineForce;
class WrenchDerivatives;

/// How far a law reaches: which bodies it couples, in that what one of them feels depends on where another is
/// or how it moves. Bodies that are not simulated couple nothing.
struct Coupling {
  enum class Reach : std::uint8_t {
    Each,   ///< every body by itself, as gravity
    Named,  ///< the bodies named with each other, as a spring; no other body feels the law
    All,    ///< all bodies with each other
  };
  Reach reach{Reach::All};
  /// Named: those; null ids are skipped. All: by way of these, so that nothing is coupled unless one of them
  /// is simulated; empty = directly.
  std::vector<BodyId> bodies{};
};

/// A force as a function of time and state. Called at every stage of the integrator, once for all bodies, so
/// that every integrator keeps its order. Must depend on its arguments and constants only.
class ForceLaw {
 public:
  virtual ~ForceLaw() = default;

  /// Adds to the wrench of each body it acts on: force in W, torque about the centre of gravity in W. What is
  /// added to a body that is not simulated is ignored.
  virtual void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const = 0;

  /// Potential energy of the simulated bodies under this law [J]; 0 for a law that has none.
  [[nodiscard]] virtual double potential_energy(const BodiesAt& at) const {
    (void)at;
    return 0;
  }
  /// The acceleration that it gives to every body, always, where that is all it does [m/s^2].
  [[nodiscard]] virtual std::optional<Vector3> uniform_acceleration() const { return {}; }
  /// Whether the law looks at velocities; lets integrators save evaluations.
  [[nodiscard]] virtual bool depends_on_velocity() const { return false; }
  /// Adds how its wrenches change with the motion of bodies, for implicit integrators; bodies that are not
  /// simulated may be left out. False, with nothing added, where it does not say: differences are taken then.
  virtual bool add_derivatives(const BodiesAt& at, WrenchDerivatives& derivatives) const {
    (void)at, (void)derivatives;
    return false;
  }
  /// The law as an effort along one number, where it is no more than that.
  [[nodiscard]] virtual const LineForce* line() const { return nullptr; }
  /// Whether the law names this body; it is removed with the body.
  [[nodiscard]] virtual bool names(BodyId body) const {
    (void)body;
    return false;
  }

  /// Which bodies it couples: they are integrated together. Must not change while the law is there. Unless
  /// told otherwise, all; saying less than is true lets a body feel where others were at the begin of a step.
  /// Of a law that couples particles: the bodies that these are coupled with.
  [[nodiscard]] virtual Coupling coupling() const { return {}; }

  // Particles. A law that acts on them says how, and has one of the two verbs below.
  [[nodiscard]] virtual ParticleAction acts_on(ParticleSystemId system) const {
    (void)system;
    return ParticleAction::None;
  }
  /// ParticleAction::Each: adds to the forces on a batch of particles.
  virtual void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const {
    (void)at, (void)forces;
  }
  /// ParticleAction::Coupled: adds to the forces on the particles of the systems it couples, and to the
  /// wrenches of the bodies it ties them to; what is added for a body that is not simulated is ignored.
  virtual void add_coupled_forces(const BodiesAt& bodies, std::span<Wrench> wrenches,
                                  std::span<const CoupledParticles> systems) const {
    (void)bodies, (void)wrenches, (void)systems;
  }
  /// Potential energy of particles under this law [J]; of a coupled law: with the bodies it ties them to.
  [[nodiscard]] virtual double particle_energy(const ParticlesAt& at) const {
    (void)at;
    return 0;
  }
  [[nodiscard]] virtual double coupled_energy(const BodiesAt& bodies,
                                              std::span<const CoupledParticles> systems) const {
    (void)bodies, (void)systems;
    return 0;
  }
};

}  // namespace pantin
