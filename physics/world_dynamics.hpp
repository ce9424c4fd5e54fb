#pragma once
// The world, or a part of it, as an integrator sees it. Coordinates: for each free body position and
// quaternion, then the joint coordinates of all trees; velocities: for each free body P and L, then the joint
// rates. P and L of a body without forces stay constant to the bit.
#include <span>
#include <vector>

#include <pantin/physics/body_store.hpp>
#include <pantin/physics/constraints/constraint_manager.hpp>
#include <pantin/physics/forces/force_manager.hpp>
#include <pantin/physics/forces/line_force.hpp>
#include <pantin/physics/forces/wrench_derivatives.hpp>
#include <pantin/physics/integrators/integrator.hpp>
#include <pantin/physics/lanes/loop_lanes.hpp>
#include <pantin/physics/lanes/tree_lanes.hpp>
#include <pantin/physics/world_part.hpp>

namespace pantin {

/// What else exerts wrenches on the bodies, at every stage.
class WrenchSource {
 public:
  virtual ~WrenchSource() = default;
  virtual void add_wrenches(const BodiesAt& bodies, std::span<Wrench> wrenches) = 0;
};

/// By which a joint that is cut to make a tree of a loop acts on its B at p_WJ, and the other way on its A.
struct CutWrench {
  Vector3 p_WJ{Vector3::Zero()}, force{Vector3::Zero()}, torque{Vector3::Zero()};
};

/// What the dynamics of all parts of the world share, by body position: where bodies are at the instant that
/// is looked at, the wrenches on them, and the motion of those that are not simulated.
struct BodyRoom {
  std::vector<BodyKinematics> stage{};
  std::vector<Wrench> wrenches{};
  std::vector<RigidMotion> grounds{};
  bool has_animated{false};
  /// Everything where it is now; the constraint manager must be prepared.
  void begin(const BodyStore& bodies, const ConstraintManager& constraints);
};

class WorldDynamics final : public Dynamics {
 public:
  /// Of everything.
  WorldDynamics(BodyStore& bodies, ConstraintManager& constraints, ForceManager& forces, BodyRoom& room)
      : bodies_{bodies},
        constraints_{constraints},
        forces_{forces},
        room_{room},
        layout_{constraints.layout()},
        kernel_{constraints.kernel()},
        loops_{constraints.loops()},
        loads_{constraints.loads()} {}
  /// Of a part that nothing couples with what is outside it. The others stand in the room as they were left.
  WorldDynamics(BodyStore& bodies, ConstraintManager& constraints, ForceManager& forces, BodyRoom& room,
                WorldPart& part)
      : bodies_{bodies},
        constraints_{constraints},
        forces_{forces},
        room_{room},
        layout_{part.layout},
        kernel_{part.kernel},
        loops_{part.loops},
        loads_{part.loads},
        part_{&part} {}

  /// Fits the work space to the bodies and trees of now; the room must have begun.
  void begin();
  /// Leaves the room as it was when it began, the state not yet being written back.
  void put_back();
  /// To be called when what the kernel holds (Articulated::hold) has changed since begin.
  void holds_have_changed() noexcept { lane_.fits = false; }
  /// Coordinates and velocities of the state reached.
  [[nodiscard]] std::span<double> coordinates_now();
  [[nodiscard]] std::span<double> velocities_now();
  /// The arrays that write_back reads, for whoever integrates elsewhere.
  [[nodiscard]] std::span<double> coordinates_reached() { return q_; }
  [[nodiscard]] std::span<double> velocities_reached() { return v_; }
  /// Position of the first body whose numbers are not finite, or, for a tree, of the first of its bodies; -1
  /// if all are.
  [[nodiscard]] std::int32_t first_not_finite() const;
  /// Writes coordinates and velocities back to the bodies, at the end of an update. What did not change is
  /// not written.
  void write_back(double t);
  /// Accelerations of all bodies at the state reached, as (angular, of the centre of gravity), and the
  /// external wrenches that act.
  void accelerations_now(std::vector<Wrench>& external, std::vector<Vector3>& alpha,
                         std::vector<Vector3>& a_cm);
  /// Puts the bodies in the room where q and v are, and those whose motion is given where that is.
  void place(Instant at, std::span<const double> q, std::span<const double> v);
  /// Whose velocity stands at this place of v: the position of a body without joints or, for a tree, of a
  /// joint (of a floating root: of its first body).
  struct Mover {
    std::int32_t body{-1}, joint{-1};
  };
  [[nodiscard]] Mover mover_of(std::size_t velocity) const;
  /// Of a closure, as accelerations_now has left it.
  [[nodiscard]] CutWrench cut_wrench(std::uint32_t closure) const;

  [[nodiscard]] std::size_t coordinates() const override { return q_.size(); }
  [[nodiscard]] std::size_t velocities() const override { return v_.size(); }
  void rate(Instant at, std::span<const double> q, std::span<const double> v,
            std::span<double> q_dot) override;
  void acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                    std::span<double> v_dot) override;
  void derivative(Instant at, std::span<const double> q, std::span<const double> v, std::span<double> q_dot,
                  std::span<double> v_dot) override;
  void settle(Instant at, std::span<double> q, std::span<double> v) override;
  [[nodiscard]] bool has_constraints() const override { return !layout_.closures.empty(); }
  /// A loop or coupling that the state settled last leaves open.
  [[nodiscard]] const OpenLoop& open_loop() const noexcept { return open_loop_; }
  [[nodiscard]] bool rates_are_velocities() const override {
    return free_bodies().empty() && layout_.coordinates == layout_.rates;
  }
  [[nodiscard]] bool acceleration_depends_on_velocity() const override;
  double motion_error(std::span<const double> q, std::span<const double> v, std::span<const double> q_error,
                      std::span<const double> v_error, double h) override;

  void derivatives(const Stages& stages) override;
  void rates(const Stages& stages) override;
  void weights(std::span<double> q_weight, std::span<double> v_weight) override;
  /// Islands.
  void list_groups(NumberGroups& groups) override;
  /// Of islands of free bodies exact, from what the laws state; of trees by differences.
  void jacobian(const JacobianPoint& point, Jacobian& J) override;

  /// Force laws that act along one number (world_lines.cpp).
  [[nodiscard]] std::span<const LineStiffness> lines() override;
  void place_lines(const Stages& stages, const LineStages& out) override;
  void jacobian_beside_lines(const JacobianPoint& point, Jacobian& J) override;

  /// What stages are computed in; they are computed one after the other where this is off.
  bool uses_lanes{true};
  int evaluations{0};           ///< of v' since it was last set to 0
  double loop_margin{1};        ///< least ClosureSolver::margin since it was last set to 1
  WrenchSource* also{nullptr};  ///< asked after the force laws; not owned

 private:
  void place_free(std::span<const double> q, std::span<const double> v, std::span<double> q_dot);
  void place_grounds(Instant at);
  void place_trees(Instant at, std::span<const double> q, std::span<const double> v);
  void tree_rates(std::span<const double> q, std::span<const double> v, std::span<double> q_dot) const;
  void evaluate(Instant at, std::span<const double> q, std::span<const double> v, std::span<double> q_dot,
                std::span<double> v_dot);
  void gather_wrenches(Instant at);
  [[nodiscard]] BodiesAt bodies_at(Instant at) const;
  void evaluate_loops(Instant at, const Tree& tree, std::span<const double> q, std::span<const double> v,
                      std::span<double> v_dot);
  void settle_loops(Instant at, std::span<double> q, std::span<double> v);
  /// Whether nothing of a tree moves, its driven parts included (they jump only at breaks, where trees are
  /// rewritten).
  [[nodiscard]] bool is_at_rest(const Tree& whole, Instant at);
  /// Tree k as it stands in the layout, and the state, of everything.
  [[nodiscard]] const Tree& tree_of_whole(std::size_t k) const;
  /// Where the numbers of the cut joints of tree k begin, here and in the state, and how many they are.
  struct CutNumbers {
    std::ptrdiff_t here{0}, whole{0}, count{0};
  };
  [[nodiscard]] CutNumbers cut_numbers(std::size_t k) const;
  void begin_cut_joints();
  [[nodiscard]] LawList laws() const {
    return LawList{part_ == nullptr ? forces_.laws() : std::span<const ForceLaw* const>{part_->laws}};
  }
  // The parts of motion_error (motion_error.cpp).
  [[nodiscard]] double free_error(std::span<const double> q, std::span<const double> q_error,
                                  std::span<const double> v_error, double h) const;
  [[nodiscard]] double tree_error(std::span<const double> q, std::span<const double> q_error,
                                  std::span<const double> v_error, double h);
  void count_link(std::uint32_t link, double& greatest) const;
  [[nodiscard]] const std::vector<std::uint32_t>& free_bodies() const { return layout_.free_bodies; }

  BodyStore& bodies_;
  ConstraintManager& constraints_;
  ForceManager& forces_;
  BodyRoom& room_;
  std::vector<BodyKinematics>& stage_{room_.stage};
  std::vector<Wrench>& wrenches_{room_.wrenches};
  std::vector<RigidMotion>& grounds_{room_.grounds};
  const TreeLayout& layout_;
  Articulated& kernel_;
  LoopCloser& loops_;
  const JointLoads& loads_;
  WorldPart* part_{nullptr};  ///< null = everything
  std::vector<double> q_{}, v_{};
  std::span<const double> trees_before_{}, rates_before_{};  ///< of all trees here, at the begin
  std::vector<double> part_q_{}, part_v_{};                  ///< the same, of a part
  std::vector<double> efforts_{};   ///< on rates, of all stages; empty where joints bear no loads
  std::vector<double> cut_near_{};  ///< numbers of cut joints where the last part of the update ended
  std::vector<double> error_rates_{}, reach_{};  // work space of motion_error, weights, accelerations_now

  // Stages in lanes (lane_dynamics.cpp).
  struct LaneRoom {
    bool fits{false};  ///< to the bodies and trees of now
    std::vector<lanes::LinkConstants> links{};
    std::vector<lanes::FreeConstants> free{};
    std::vector<double> motions{}, wrenches{}, q{}, v{};
    lanes::AlignedRoom work{};
    // Where there are closures:
    std::vector<lanes::ClosureConstants> closures{};
    std::vector<double> couplings{};
    lanes::AlignedRoom loop_work{};
    lanes::LoopSizes loop_sizes{};
  };
  void fit_lanes(const lanes::Kernel& kernel);
  void lane_group(const Stages& stages, const lanes::Kernel& kernel, std::size_t first,
                  const std::optional<Vector3>& uniform);
  void given_motions(const Stages& stages, std::size_t first, std::size_t count);
  [[nodiscard]] RigidMotion motion_of_ground(std::int32_t body, Instant at) const;
  /// A stage's numbers into the room for one.
  void take_stage(const Stages& stages, std::size_t stage);
  void place_lane(const Stages& stages, std::size_t stage);
  void collect_wrenches(const Stages& stages, std::size_t first, std::size_t lane, std::size_t count);
  void put_wrench(std::size_t link, std::size_t lane, std::size_t count, const Vector3& force,
                  const Vector3& torque, const Vector3& p_WQ);
  void free_forces(const Stages& stages, const Vector3& g_W);
  // Their closures (lane_loops.cpp).
  /// The given motions of links count `given`; returns how many there are with those of closures.
  [[nodiscard]] std::int32_t fit_loops(const lanes::Kernel& kernel, std::int32_t given);
  void given_loop_motions(const Stages& stages, std::size_t first, std::size_t count);
  void coupling_numbers(const Stages& stages, std::size_t first, std::size_t count);
  [[nodiscard]] lanes::LoopTask loop_task(const Tree& tree);
  LaneRoom lane_{};
  OpenLoop open_loop_{};

  // Lines (world_lines.cpp).
  struct LineRoom {
    std::vector<const LineForce*> laws{};
    std::vector<LineStiffness> stiffness{};
    std::vector<double> kept{};  ///< efforts that stay; empty = none do
    std::int32_t pulled{-1};     ///< the line on which a unit of effort more acts; -1 = none
    std::vector<double> q_dot{}, v_dot{}, by_rate{};
    std::vector<Wrench> on_links{};
  };
  void adjust_lines(const BodiesAt& bodies);
  void project_line(std::span<const double> q, std::size_t stage, std::size_t stages, std::span<double> by_q,
                    std::span<double> by_v);
  void project_on_trees(std::span<const double> q, std::size_t stage, std::size_t stages,
                        std::span<double> by_q, std::span<double> by_v);
  LineRoom line_{};

  // The Jacobian (world_jacobian.cpp).
  struct FreeBlock {
    std::size_t group{0}, q{0}, v{0};  ///< where its 7 and 6 numbers begin in the group
    double inverse_mass{0};
    Matrix3 inverse_inertia_W{Matrix3::Zero()}, spin_by_turn{Matrix3::Zero()};
    Eigen::Matrix<double, 3, 4> turn_by_q{Eigen::Matrix<double, 3, 4>::Zero()};
  };
  struct JacobianRoom {
    std::uint64_t layout{0}, forces{0};  ///< what the groups are of; 0 = nothing yet
    NumberGroups groups{};
    std::vector<std::uint8_t> is_free{};     ///< by group: no trees
    std::vector<FreeBlock> free{};           ///< by free body here
    std::vector<std::int32_t> free_place{};  ///< by position: which of the free bodies here; -1 = none
    std::vector<std::size_t> wanted{};
    WrenchDerivatives derivatives{};
  };
  void fit_groups();
  void add_free_motion(const JacobianPoint& point, Jacobian& J);
  void add_laws(Jacobian& J);
  JacobianRoom jacobian_{};
};

}  // namespace pantin
