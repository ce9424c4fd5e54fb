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
#include <pantin/physics/step_group.hpp>
#include <pantin/physics/stops/axis_guard.hpp>
#include <pantin/physics/stops/joint_wrenches.hpp>
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
  AxisGuard guard{bodies, constraints, dynamics};
  JointWrenches wrenches{bodies, constraints, dynamics};
  std::vector<BodyId> moved{};
  std::vector<RigidMotion> grounds{};
  bool watches_stability{false};
  StabilityWatch watch{};
  std::unique_ptr<Integrator> implicit{};  ///< for motion that would take too many parts
  FastMotion fast{};                       ///< the fastest in the step at hand
  bool keeps_motion{false};
  std::uint64_t motion_topology{0};  ///< that the motion inside the last step was recorded with
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
  void apply_impulses();
  void list_moved();
  // The same between events at stops and in dry friction, where all bodies are one group (guarded_step.cpp).
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

  // Groups of islands (step_groups.cpp, integrate_islands.cpp, dense_output.cpp).
  void fit_groups();  ///< to bodies, joints, laws and integrators of now; the constraints must be prepared
  void make_groups();
  void lay_out_groups();
  [[nodiscard]] const BodyIntegrator* integrator_of(const Island& island) const;
  void forget_integrator_of(BodyId body);
  void begin_groups();
  /// All equations of motion from the time of the state over h. False = a group failed, and nothing changed.
  [[nodiscard]] bool integrate(double h);
  /// One group over h, in parts where steps are watched; its integrator's own control, if it has one.
  StepControl* advance(std::size_t group, Dynamics& system, double h, std::span<double> q,
                       std::span<double> v);
  void integrate(std::size_t group, Dynamics& system, double h, std::span<double> q, std::span<double> v);
  void integrate_part(StepGroup& group, Integrator& with, Dynamics& system, double t, double h,
                      std::span<double> q, std::span<double> v);
  [[nodiscard]] bool has_failed(std::size_t group);
  void take_counts();
  void add_counts(StepReport& report) const;
  // What watching adds (watched_steps.cpp).
  [[nodiscard]] int watched_parts(std::size_t group, Dynamics& system, double h, std::span<const double> q,
                                  std::span<const double> v);
  void note_fast_motion(std::size_t group, Dynamics& system, int parts);
};

}  // namespace pantin
