#pragma once
// What a PhysicsManager consists of. Private to physics.
#include <memory>
#include <vector>

#include <pantin/physics/body_store.hpp>
#include <pantin/physics/constraints/constraint_manager.hpp>
#include <pantin/physics/deflectors/deflector_manager.hpp>
#include <pantin/physics/forces/force_manager.hpp>
#include <pantin/physics/integrators/integrator.hpp>
#include <pantin/physics/particles/particle_manager.hpp>
#include <pantin/physics/physics_manager.hpp>
#include <pantin/physics/step_group.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

struct Island;

struct PhysicsManager::Impl {
  BodyStore bodies{};
  ForceManager forces{};
  ConstraintManager constraints{};
  std::unique_ptr<Integrator> integrator{make_integrator("rk4")};
  std::vector<BodyIntegrator> own_integrators{};  ///< in the order in which they were set
  std::uint64_t integrator_revision{0};           ///< counts settings of these two
  BodyRoom room{};
  WorldDynamics dynamics{bodies, constraints, forces, room};  ///< of everything
  DeflectorManager deflectors{bodies};
  ParticleManager particles{bodies, forces, deflectors};
  std::vector<StepGroup> groups{};  ///< at least one, where they fit
  GroupsKey groups_key{};
  std::uint64_t groups_stamp{0};  ///< State::groups of these
  std::size_t failed_group{0};    ///< by which the last step failed, if by one
  std::vector<BodyId> moved{};
  std::vector<RigidMotion> grounds{};
  bool keeps_motion{false};
  std::uint64_t motion_topology{0};  ///< that the motion inside the last step was recorded with
  std::vector<double> start{};       ///< work space: q and v at the begin of an update
  State before{};                    ///< to go back to, where a part of a step may fail after others are done

  // The parts of a step, in order (physics_step.cpp).
  void remember(bool with_particles);
  void go_back(bool with_particles);
  [[nodiscard]] double next_break(double t) const;
  void pass_break();
  [[nodiscard]] bool update(double h);
  void apply_impulses();
  void list_moved();
  [[nodiscard]] StepReport failure() const;
  [[nodiscard]] StepReport failure(const OpenLoop& open) const;
  [[nodiscard]] Energy energy() const;

  // Groups of islands (step_groups.cpp, integrate_islands.cpp, dense_output.cpp).
  void fit_groups();  ///< to bodies, joints, laws and integrators of now; the constraints must be prepared
  void make_groups();
  void lay_out_groups();
  [[nodiscard]] const BodyIntegrator* integrator_of(const Island& island) const;
  void forget_integrator_of(BodyId body);
  void begin_groups();
  /// All equations of motion from the time of the state over h. False = a group failed, and nothing changed.
  [[nodiscard]] bool integrate(double h);
  void advance(std::size_t group, Dynamics& system, double h, std::span<double> q, std::span<double> v);
  void integrate(StepGroup& group, Dynamics& system, double h, std::span<double> q, std::span<double> v);
  void add_counts(StepReport& report) const;
};

}  // namespace pantin
