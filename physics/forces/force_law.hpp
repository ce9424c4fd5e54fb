#pragma once
// The family of forces. To add one: a file with a settings struct, problem_with(settings) and make_law(settings) that
// returns the law object; ForceManager::add finds them by the settings type. No list is to be edited.
#include <memory>
#include <span>

#include <pantin/physics/bodies_at.hpp>
#include <pantin/physics/ids.hpp>

namespace pantin {

/// A force as a function of time and state. Called at every stage of the integrator, once for all bodies, so that
/// every integrator keeps its order. Must depend on its arguments and constants only.
class ForceLaw {
 public:
  virtual ~ForceLaw() = default;

  /// Adds to the wrench of each body it acts on: force in W, torque about the centre of gravity in W. What is added to
  /// a body that is not simulated is ignored.
  virtual void add_wrenches(const BodiesAt& at, std::span<Wrench> wrenches) const = 0;

  /// Potential energy of the simulated bodies under this law [J]; 0 for a law that has none.
  [[nodiscard]] virtual double potential_energy(const BodiesAt& at) const {
    (void)at;
    return 0;
  }
  /// Whether the law looks at velocities; lets integrators save evaluations.
  [[nodiscard]] virtual bool depends_on_velocity() const { return false; }
  /// Whether the law names this body; it is removed with the body.
  [[nodiscard]] virtual bool names(BodyId body) const {
    (void)body;
    return false;
  }
};

}  // namespace pantin
