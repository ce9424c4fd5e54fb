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
#include <pantin/physics/stops/axis_guard.hpp>
#include <pantin/physics/stops/joint_wrenches.hpp>
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
  AxisGuard guard{bodies, constraints, dynamics};
  JointWrenches wrenches{bodies, constraints, dynamics};
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
  int crowded{0};                    ///< parts of the last step in which events crowded
  StepMemory memory_before{};        ///< work space of a guarded piece, as are the next
  std::vector<double> trial_q{}, trial_v{};
  State before{};  ///< to go back to, where a part of a step may fail after others are done

  // The parts of a step, in order (physics_step.cpp).
  void remember(bool with_particles);
  void go_back(bool with_particles);
  [[nodiscard]] double next_break(double t) const;
  void pass_break();
  [[nodiscard]] bool update(double h);
  /// What moves in an update: everything joined or free, and particles that act on bodies.
  struct Moving {
    Dynamics* system{nullptr};
    std::span<double> q{}, v{};
    bool coupled{false};
  };
  [[nodiscard]] Moving begin_update();
  /// The integrator's own control of the steps it took, not yet noted; null if it has none.
  StepControl* integrate_now(const Moving& now, double h);
  [[nodiscard]] bool end_update(const Moving& now, double h);
  void integrate(Dynamics& system, double h, std::span<double> q, std::span<double> v);
  void integrate_part(Integrator& with, Dynamics& system, double t, double h, std::span<double> q,
                      std::span<double> v);
  [[nodiscard]] int watched_parts(Dynamics& system, double h, std::span<const double> q,
                                  std::span<const double> v);
  void name_fast_motion(Dynamics& system);
  void note_control(const StepControl& control);
  void apply_impulses();
  void list_moved();
  // The same between events at stops and in dry friction (guarded_step.cpp).
  [[nodiscard]] bool guarded_update(double h);
  [[nodiscard]] double guarded_piece(double h);
  [[nodiscard]] std::optional<AxisCrossing> next_crossing(const Moving& now, std::size_t first);
  void put_numbers(const Moving& now);
  [[nodiscard]] bool short_steps(double h);
  void strike_now();
  /// Appends the joints that bear more than their strength now (stops/joint_wrenches.cpp).
  void find_overloaded(const PhysicsManager& physics, std::vector<JointId>& out);
  [[nodiscard]] StepReport failure() const;
  [[nodiscard]] StepReport failure(const OpenLoop& open) const;
  [[nodiscard]] Energy energy() const;
};

}  // namespace pantin
