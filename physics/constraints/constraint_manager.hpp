#pragma once
// Owns the joints, lays them out as trees, and keeps the trees' coordinates in step with the bodies. Poses
// and momenta of the bodies are the public truth; coordinates live in State beside them and are measured
// afresh only when joints, bodies or kinds have changed, so that nothing drifts by conversion.
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <pantin/physics/body_store.hpp>
#include <pantin/physics/constraints/articulated.hpp>
#include <pantin/physics/constraints/couplings.hpp>
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/joint_loads.hpp>
#include <pantin/physics/constraints/loop_closer.hpp>
#include <pantin/physics/constraints/tree.hpp>
#include <pantin/physics/step_report.hpp>

namespace pantin {

class ConstraintManager {
 public:
  // Joints
  JointId add(JointDefinition joint);
  void remove(JointId id);
  [[nodiscard]] bool contains(JointId id) const noexcept;
  [[nodiscard]] std::size_t at(JointId id) const;  ///< position of a living joint
  [[nodiscard]] const JointDefinition& joint(std::size_t j) const { return *joints_[j]; }
  [[nodiscard]] std::size_t size() const noexcept { return joints_.size(); }
  [[nodiscard]] JointId id(std::size_t j) const { return ids_[j]; }
  [[nodiscard]] std::vector<JointId> joints_of(BodyId body) const;
  [[nodiscard]] bool closes_loop(const BodyStore& bodies, BodyId a, BodyId b) const;

  // Springs, rotors and motors (joint_energy.cpp); an axis must be one of the joint's.
  void set_motor(std::size_t j, int axis, const MotorSettings& motor);
  void clear_motor(std::size_t j, int axis);
  [[nodiscard]] std::optional<MotorSettings> motor(std::size_t j, int axis) const;
  [[nodiscard]] const JointLoads& loads() const noexcept { return loads_; }
  /// Lists the loads of another layout of these joints, until the revision of the layout changes.
  void list_loads(TreeLayout& layout, JointLoads& loads) const { loads.list(layout, joints_, motors_); }
  /// Of springs and rotors.
  [[nodiscard]] Energy energy(const BodyStore& bodies) const;
  /// Of spring, motors and damping along each number, on B.
  [[nodiscard]] JointNumbers effort(const BodyStore& bodies, std::size_t j) const;
  /// Rotors turn as the bodies of a tree do, whose velocities were set.
  void measure_rotors(BodyStore& bodies, const Tree& tree) const;

  // Couplings (coupled_joints.cpp)
  /// Of b the turn is taken, if it counts turns and nothing else is coupled to it, in which the coupling has
  /// the least to move.
  CouplingId add(const BodyStore& bodies, GearSettings settings);
  void remove(CouplingId id) { couplings_.remove(id); }
  [[nodiscard]] const Couplings& couplings() const noexcept { return couplings_; }

  // Layout
  /// Bodies, joints, kinds or masses are about to change: keeps what is known of the coordinates, by joint.
  void stale(const BodyStore& bodies);
  /// Brings layout, coordinates and rates up to date with the bodies; bodies that miss their joints are put
  /// back.
  void prepare(BodyStore& bodies);
  [[nodiscard]] bool is_stale() const noexcept { return stale_; }
  [[nodiscard]] const TreeLayout& layout() const noexcept { return layout_; }
  /// Counts how often the layout was made anew, or motors came to a joint that had none or went.
  [[nodiscard]] std::uint64_t layout_revision() const noexcept { return layout_revision_; }
  [[nodiscard]] Articulated& kernel() noexcept { return kernel_; }
  [[nodiscard]] LoopCloser& loops() noexcept { return loops_; }

  /// Rates of a tree from the momenta of its bodies: the motion that the joints allow and that has the same
  /// momentum along it (an articulated impulse solve); rotors keep the momentum of the rates in State.
  /// Writes velocities and momenta.
  void project(BodyStore& bodies, const Tree& tree, std::span<const RigidMotion> grounds, Instant at);
  /// Writes poses, velocities and momenta of a tree's bodies from its coordinates and rates.
  void commit(BodyStore& bodies, const Tree& tree, std::span<const RigidMotion> grounds, Instant at);
  /// Closes the loops of a tree whose coordinates or grounds were set from outside. False, with coordinates
  /// as they were, if there is no way; the tree then counts as open until it is closed.
  bool reclose(BodyStore& bodies, std::size_t tree, std::span<const RigidMotion> grounds, Instant at);
  /// A body that is not simulated has been placed: what hangs on it moves along.
  void ground_has_moved(BodyStore& bodies, std::int32_t ground, Instant at);
  /// A loop or coupling of the present state, which is prepared, that could not be closed, tried again.
  [[nodiscard]] OpenLoop find_open_loop(BodyStore& bodies);
  /// What is wrong with an open loop, and what to do.
  [[nodiscard]] SettingsProblem problem_with(const OpenLoop& loop) const;
  /// Motion of all bodies that are not simulated, by body position.
  void ground_motions(const BodyStore& bodies, Instant at, std::vector<RigidMotion>& out) const;

  // Numbers of a joint, seen as B relative to A.
  [[nodiscard]] JointNumbers value(const BodyStore& bodies, std::size_t j) const;
  [[nodiscard]] JointNumbers rate(const BodyStore& bodies, std::size_t j) const;
  /// False, and nothing has changed, where the joint's loop does not allow the value.
  [[nodiscard]] bool set_value(BodyStore& bodies, std::size_t j, const JointNumbers& value);
  void set_rate(BodyStore& bodies, std::size_t j, const JointNumbers& rate);
  [[nodiscard]] JointDrift drift(const BodyStore& bodies) const;
  /// Moves a body of a tree with all that hangs on it; its own joint is kept, and loops are closed again.
  void teleport(BodyStore& bodies, std::size_t body, const Pose& X_WB);
  [[nodiscard]] std::vector<std::pair<JointId, SettingsProblem>> singular_joints(BodyStore& bodies);

 private:
  struct Numbers {  ///< of one joint, as its model stores them, B relative to A
    double q[7]{};
    double v[6]{};
    bool known{false};
  };
  [[nodiscard]] Numbers numbers(const BodyStore& bodies, std::size_t j) const;
  void put_numbers(BodyStore& bodies, std::size_t j, const Numbers& numbers);
  void keep_numbers(BodyStore& bodies, std::size_t j, const Numbers& numbers) const;
  void measure(const BodyStore& bodies, const Tree& tree, std::vector<double>& q) const;
  [[nodiscard]] Pose link_pose(const BodyStore& bodies, const TreeLink& link) const;
  void write_state(BodyStore& bodies, const Tree& tree, bool poses) const;
  void measure_cut_joints(BodyStore& bodies, const Tree& tree) const;
  [[nodiscard]] std::span<const double> rotor_momenta(std::span<const double> rates);
  void keep_cut_rotors(const BodyStore& bodies, const Tree& tree, std::span<const RigidMotion> grounds,
                       Instant at);
  void list_storing();
  void list_motors();
  void lay_out_anew(BodyStore& bodies);
  [[nodiscard]] std::vector<JointCoupling> placed_couplings() const;
  [[nodiscard]] bool is_idle(const BodyStore& bodies, std::size_t j) const;
  [[nodiscard]] SettingsProblem problem_with_coupling(const OpenLoop& loop) const;
  void add_coupling_drift(const BodyStore& bodies, JointDrift& drift) const;
  void measure_anew(BodyStore& bodies, std::size_t tree, Instant now);
  [[nodiscard]] TreeView view(const Tree& tree, std::span<const RigidMotion> grounds, Instant at) {
    return {layout_, tree, kernel_, grounds, at};
  }
  // Trees with loops (held_joint.cpp).
  [[nodiscard]] std::int32_t tree_of_joint(std::size_t j) const;
  [[nodiscard]] bool is_in_loop(std::size_t j) const;
  [[nodiscard]] bool set_value_in_loop(BodyStore& bodies, std::size_t j, const JointNumbers& to);
  void set_rate_in_loop(BodyStore& bodies, std::size_t j, const JointNumbers& rate);
  [[nodiscard]] Pose relative_pose(const BodyStore& bodies, const JointDefinition& joint) const;

  std::vector<std::unique_ptr<JointDefinition>> joints_{};
  std::vector<JointId> ids_{};
  std::vector<std::unique_ptr<JointMotors>> motors_{};  ///< by joint position; null where there is none
  std::vector<std::uint32_t> storing_{};  ///< positions of joints with springs or rotors, ascending
  JointLoads loads_{};
  std::vector<Numbers> last_{};               ///< by joint position
  std::vector<std::uint32_t> position_of_{};  ///< JointId::index -> position
  std::vector<std::uint32_t> generation_{};
  std::vector<std::uint32_t> free_{};
  std::vector<std::vector<JointId>> joints_of_{};  ///< by BodyId::index

  Couplings couplings_{};
  TreeLayout layout_{};
  std::uint64_t layout_revision_{0};
  Articulated kernel_{};
  LoopCloser loops_{};
  std::vector<OpenLoop> open_{};  ///< by tree
  bool stale_{true};
  std::vector<RigidMotion> grounds_{};
  std::vector<double> zero_rates_{}, efforts_{};
};

}  // namespace pantin
