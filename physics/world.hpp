#pragma once
// What a PhysicsManager consists of. Private to physics.
#include <memory>
#include <vector>

#include <pantin/physics/body_store.hpp>
#include <pantin/physics/constraints/constraint_manager.hpp>
#include <pantin/physics/deflectors/deflector_manager.hpp>
#include <pantin/physics/forces/force_manager.hpp>
#include <pantin/physics/integrators/integrator.hpp>
#include <pantin/physics/integrators/stability_watch.hpp>
#include <pantin/physics/particles/particle_manager.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

struct PhysicsManager::Impl {
  BodyStore bodies{};
  ForceManager forces{};
  ConstraintManager constraints{};
  std::unique_ptr<Integrator> integrator{make_integrator("rk4")};
  WorldDynamics dynamics{bodies, constraints, forces};
  DeflectorManager deflectors{bodies};
  ParticleManager particles{bodies, forces, deflectors, dynamics};
  std::vector<BodyId> moved{};
  std::vector<RigidMotion> grounds{};
  StepControl inner{};  ///< sums over the parts of a step
  bool watches_stability{false};
  StabilityWatch watch{};
  std::unique_ptr<Integrator> implicit{};  ///< for motion that would take too many parts
  FastMotion fast{};                       ///< in the step at hand
  bool keeps_motion{false};
  MotionRecord motion{};             ///< inside the last step, where it is kept
  std::uint64_t motion_topology{0};  ///< that it was recorded with
  std::vector<double> start{};       ///< work space: q and v at the begin of an update
  State before{};                    ///< to go back to, where a part of a step may fail after others are done

  // The parts of a step, in order (physics_step.cpp).
  void remember(bool with_particles);
  void go_back(bool with_particles);
  [[nodiscard]] double next_break(double t) const;
  void pass_break();
  [[nodiscard]] bool update(double h);
  void integrate(Dynamics& system, double h, std::span<double> q, std::span<double> v);
  void integrate_part(Integrator& with, Dynamics& system, double t, double h, std::span<double> q,
                      std::span<double> v);
  [[nodiscard]] int watched_parts(Dynamics& system, double h, std::span<const double> q,
                                  std::span<const double> v);
  void name_fast_motion(Dynamics& system);
  void note_control(StepControl& control);
  void apply_impulses();
  void list_moved();
  [[nodiscard]] StepReport failure() const;
  [[nodiscard]] StepReport failure(const OpenLoop& open) const;
  [[nodiscard]] Energy energy() const;
};

}  // namespace pantin
