#pragma once
// Owns everything that is simulated and advances it. Bodies without joints are integrated as they are; bodies
// joined into a tree move in joint coordinates, eliminated along the hierarchy inside the derivative, so that
// every integrator keeps its order. Poses and momenta are the public truth.
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <pantin/physics/constraints/gear.hpp>
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/motor.hpp>
#include <pantin/physics/deflectors/deflector_manager.hpp>
#include <pantin/physics/forces/force_manager.hpp>
#include <pantin/physics/ids.hpp>
#include <pantin/physics/integrators/integrator.hpp>
#include <pantin/physics/island_group.hpp>
#include <pantin/physics/particles/particle_manager.hpp>
#include <pantin/physics/rigid_body.hpp>
#include <pantin/physics/state.hpp>
#include <pantin/physics/step_report.hpp>
#include <pantin/physics/stops/joint_event.hpp>

namespace pantin {

/// A type that describes a joint: has problem_with(settings) and define(settings).
template <class S>
concept JointSettings = requires(S settings) {
  { define(std::move(settings)) } -> std::same_as<JointDefinition>;
};

/// Every id argument must be alive, every number finite, or the contract is broken. Reading is safe from
/// several threads at once; two managers are independent.
class PhysicsManager {
 public:
  PhysicsManager();
  ~PhysicsManager();
  PhysicsManager(PhysicsManager&&) noexcept;
  PhysicsManager& operator=(PhysicsManager&&) noexcept;

  // Bodies
  BodyId add(RigidBodySettings settings);
  void remove(BodyId id);  ///< its joints, deflectors, emitters, pins and the laws that name it go first
  [[nodiscard]] bool contains(BodyId id) const noexcept;
  [[nodiscard]] RigidBody body(BodyId id) const;
  [[nodiscard]] std::span<const BodyId> bodies() const noexcept;

  /// Who decides from now on; pose and velocity stay what they are (an animated body's are then the
  /// driver's).
  void make_simulated(BodyId id);
  void make_animated(BodyId id, std::unique_ptr<Driver> driver);  ///< X_WB(t) of the body origin
  void make_static(BodyId id);
  /// Keeps the origin's pose and velocity, and the angular velocity.
  void set_mass_properties(BodyId id, const MassProperties& mass,
                           InertiaCheck check = InertiaCheck::Physical);

  /// Teleports: the previous pose becomes the new one. What hangs on the body through joints moves along. A
  /// pose that the body's own joint does not allow is brought back to the joint at the next step. In loops
  /// the rest follows; where it cannot, the next step says so.
  void set_pose(BodyId id, const Pose& X_WB);
  /// Of a simulated body. Velocities that joints do not allow are projected on them at the next step, momenta
  /// kept as far as the joints let them. Rotors on the joints of the body turn along; in impulses, and where
  /// a driven motion jumps, they keep their momentum.
  void set_velocity(BodyId id, const Vector3& v_WBcm, const Vector3& w_WB);

  /// Adds to the accumulators; they act on every step until clear_accumulators.
  void apply_force(BodyId id, const Vector3& f_W,
                   const Vector3& p_WQ);             ///< [N], acting at a point given in W [m]
  void apply_force(BodyId id, const Vector3& f_W);   ///< at the centre of gravity
  void apply_torque(BodyId id, const Vector3& t_W);  ///< [N m]
  /// Acts once, at the end of the next step: added to P and L, then joints are made to agree.
  void apply_impulse(BodyId id, const Vector3& j_W, const Vector3& p_WQ);  ///< [N s]
  void apply_impulse(BodyId id, const Vector3& j_W);
  void apply_angular_impulse(BodyId id, const Vector3& j_W);  ///< [N m s]
  void clear_accumulators();                                  ///< forces and torques; impulses stay

  // Joints
  template <JointSettings S>
  JointId add(S settings) {
    return add_joint(define(std::move(settings)));
  }
  JointId add_joint(JointDefinition joint);
  void remove(JointId id);  ///< its couplings go first
  [[nodiscard]] bool contains(JointId id) const noexcept;
  [[nodiscard]] std::vector<JointId> joints() const;
  [[nodiscard]] const JointDefinition& joint(JointId id) const;
  [[nodiscard]] std::vector<JointId> joints_of(BodyId id) const;
  /// Whether a joint between these two (null = world) would close a loop of joints; all bodies that are not
  /// simulated count as one with the world. Loops are held, at some cost: of each loop the joint with the
  /// fewest rows is cut and held by multipliers, also where loops are redundant or pass singular positions.
  [[nodiscard]] bool closes_loop(BodyId a, BodyId b) const;
  /// Joints that move nothing that resists (massless ends), floating bodies without mass, and joints whose
  /// loops cannot be closed, or whose coupling cannot be met, from where the bodies stand; call before
  /// stepping.
  [[nodiscard]] std::vector<std::pair<JointId, SettingsProblem>> singular_joints() const;

  /// Where B stands against A: pivot angle with its turns [rad], slider [m], ball (w, x, y, z); none for
  /// fixed and driven joints.
  [[nodiscard]] JointNumbers joint_value(JointId id) const;
  /// pivot [rad/s], slider [m/s], ball: angular velocity of B in A in axes of B's joint frame [rad/s].
  [[nodiscard]] JointNumbers joint_rate(JointId id) const;
  /// Moves B and all it carries; in a loop, and where joints are coupled, the rest follows, by the shortest
  /// way that its inertia knows. A value or rate that these do not allow breaks the contract.
  void set_joint_value(JointId id, const JointNumbers& value);
  /// The same for values that come from outside: where the loop does not allow it, nothing changes.
  [[nodiscard]] bool try_joint_value(JointId id, const JointNumbers& value);
  void set_joint_rate(JointId id, const JointNumbers& rate);
  /// Wrench that A exerts on B through the joint, at J, in W, at the present state: evaluated on demand.
  /// Where loops are redundant, the least that does it.
  [[nodiscard]] Wrench reaction(JointId id) const;
  // Motors (joint_motors.cpp). They are settings, as force laws are, and no part of State.
  /// From now on a motor acts along a number of a joint; in the place of one that does. Targets may be
  /// changed at any time: nothing is laid out anew. The joint's kind must have that number: not ball, fixed,
  /// driven.
  void set_motor(JointId id, const MotorSettings& motor, int axis = 0);
  void clear_motor(JointId id, int axis = 0);
  [[nodiscard]] std::optional<MotorSettings> motor(JointId id, int axis = 0) const;
  /// By which spring, damping and motor act on B along each number, all together, at the present state [N m
  /// or N]; of a ball by axis of B's joint frame. Not what the joint itself holds: that is its reaction.
  [[nodiscard]] JointNumbers joint_effort(JointId id) const;

  // Stops and dry friction
  /// How one of a joint's numbers moves, by what the last step decided: Free before the first step, and where
  /// a coupling leads the number: its stops and friction then act on the number that leads.
  [[nodiscard]] AxisMode axis_mode(JointId id, int axis = 0) const;
  /// What its stops and its dry friction exert along one of a joint's numbers at the present state [N m or
  /// N], positive where it pushes the number up: evaluated on demand.
  [[nodiscard]] double axis_effort(JointId id, int axis = 0) const;
  /// Numbers of joints whose stops and friction do not act: in a loop in which all joints have them, those of
  /// the joint that is cut; the distances of a planar joint whose B is nearer to the ground than its A.
  [[nodiscard]] std::vector<std::pair<JointId, int>> unguarded_axes() const;
  /// Greatest distance [m] and angle [rad] by which body poses miss their joints, and joints their couplings.
  [[nodiscard]] JointDrift joint_drift() const;

  // Couplings of joints (physics_couplings.cpp)
  /// Holds while the coupled joints both move something simulated. Joints that stand off it are brought
  /// together at once, by the shortest way that inertia knows; of a pivot b that nothing else is coupled to,
  /// whole turns are counted anew instead of made. Where that cannot be, singular_joints and the next step
  /// say so. Settings must be without problem_with(settings, joint(a), joint(b)).
  CouplingId add(GearSettings settings);
  void remove(CouplingId id);
  [[nodiscard]] bool contains(CouplingId id) const noexcept;
  [[nodiscard]] const std::vector<CouplingId>& couplings() const noexcept;  ///< in the order of adding
  [[nodiscard]] const GearSettings& coupling(CouplingId id) const;
  /// Generalised force by which it acts on joint b at the present state [N m] or [N], evaluated on demand; on
  /// joint a it acts with -ratio times that. 0 while it does not hold. Where couplings and loops are
  /// redundant, the least that does it.
  [[nodiscard]] double coupling_effort(CouplingId id) const;

  [[nodiscard]] ForceManager& forces() noexcept;
  [[nodiscard]] const ForceManager& forces() const noexcept;
  [[nodiscard]] ParticleManager& particles() noexcept;
  [[nodiscard]] const ParticleManager& particles() const noexcept;
  [[nodiscard]] DeflectorManager& deflectors() noexcept;
  [[nodiscard]] const DeflectorManager& deflectors() const noexcept;

  // Integrators
  /// Of all bodies, but for islands with one of their own. An integrator that chooses its own steps does so
  /// for each island by itself: simulated bodies that joints or laws couple. Free bodies that no law names go
  /// together, and so do all islands where there are more than 32, since for each of them the force laws are
  /// asked about all bodies. An integrator that takes the steps it is asked for advances all together.
  void set_integrator(std::unique_ptr<Integrator> integrator);
  /// Of the island of a body, as long as the body is simulated; null = that of all. Where bodies of one
  /// island ask for different ones, the one that was set last wins.
  void set_integrator(BodyId body, std::unique_ptr<Integrator> integrator);
  [[nodiscard]] const Integrator& integrator() const noexcept;  ///< of all; "rk4" unless set
  /// Whether all integrators set for bodies hold a tolerance, so that a step may be as long as one likes.
  [[nodiscard]] bool holds_tolerance() const noexcept;
  /// What is integrated together, by what, why so, and at what cost in the last step.
  [[nodiscard]] std::vector<IslandGroup> islands();

  /// Whether steps of integrators that take the steps they are asked for are watched: where something decays
  /// or swings faster than the integrator bears (Integrator::stability_radius), the step is cut into parts,
  /// or, where these were more than 32, taken by the implicit midpoint rule; StepReport::fast says so. Costs
  /// some evaluations every 32 steps. Off unless set.
  void watch_stability(bool watch);

  // Time
  [[nodiscard]] double time() const noexcept;  ///< [s]
  void set_time(double time);
  /// Advances by h > 0 [s]. If numbers go wrong nothing changes and the report says where.
  [[nodiscard]] StepReport step(double h);
  /// Bodies whose pose the last step changed, in the order of `bodies()`.
  [[nodiscard]] std::span<const BodyId> moved() const noexcept;
  /// What happened to joints in the last step, in the order of time.
  [[nodiscard]] std::span<const JointEvent> joint_events() const noexcept;
  [[nodiscard]] Energy energy() const;

  // Dense output
  /// Whether steps keep the motion inside them for motion_at. Costs memory, and with an integrator that has
  /// no interpolant of its own two evaluations a step. Off unless set.
  void keep_motion(bool keep);
  /// All bodies at a time inside the last step, in the order of bodies(), from the interpolant of the
  /// integrator: of order four for dormand-prince, one more than the stages for gauss and radau, a cubic
  /// between the ends of a step for others. Impulses that acted at the end of the step are not in it. The
  /// step must have gone well, and the same bodies, joints and kinds still be there.
  [[nodiscard]] std::vector<BodyKinematics> motion_at(double t);

  /// Everything integrated, as a value. Restoring continues bit for bit; bodies, joints, kinds, particle
  /// systems and emitters must be the same as when it was taken.
  [[nodiscard]] State snapshot();
  void restore(const State& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pantin
