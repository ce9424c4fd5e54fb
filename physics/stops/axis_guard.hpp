#pragma once
// Keeps numbers of joints between their stops and lets dry friction act: which of them are locked and which
// slide, what holds them, when that ends, and what blows on stops do. Bodies joined to each other answer
// exactly, by the elimination; what several stops and frictions exert at once is a complementarity problem
// (boxed_problem.hpp; D. Stewart, J. Trinkle, Int. J. Numerical Methods in Engineering 39, 2673 (1996); F.
// Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral Contacts, 1996).
//
//   locked   v = 0, v' = 0 by an effort e:  stuck |e| <= F;  at the lower stop e >= -F;  at the upper e <= F
//   sliding  the effort -F sign(v)
//   a blow   v+ = v- + M^-1 S x,  x >= 0 complementary to v+ + r v- >= 0 at lower stops (r the restitution),
//            the other way at upper ones; dry friction, being finite, does nothing in no time
//
// A number that starts beyond a stop, or gets there by rounding, meets the stop where it stands, until it has
// moved back.
#include <optional>
#include <span>
#include <vector>

#include <pantin/physics/body_store.hpp>
#include <pantin/physics/constraints/constraint_manager.hpp>
#include <pantin/physics/integrators/integrator.hpp>
#include <pantin/physics/stops/axis_response.hpp>
#include <pantin/physics/stops/boxed_problem.hpp>
#include <pantin/physics/stops/guarded_axis.hpp>
#include <pantin/physics/stops/joint_event.hpp>

namespace pantin {

class WorldDynamics;

/// What moves at an instant: q and v of all that `system` sees, trees' numbers as WorldDynamics orders them.
struct GuardedMotion {
  Dynamics& system;
  Instant at{};
  std::span<double> q{}, v{};
};

/// The next thing to happen to a number of a joint.
struct AxisCrossing {
  enum class Kind : std::uint8_t {
    Stop,
    Rest,
    Effort
  };                    ///< reaches a stop; slides no more; passes what holds it
  double time{0};       ///< [s]
  std::size_t axis{0};  ///< position among the axes
  Kind kind{Kind::Stop};
  bool upper{false};  ///< Stop: which; Effort: that of the bounds of what holds it
  double slope{0};    ///< of the number that crosses, by time
};

class AxisGuard {
 public:
  AxisGuard(BodyStore& bodies, ConstraintManager& constraints, WorldDynamics& dynamics)
      : bodies_{bodies}, constraints_{constraints}, dynamics_{dynamics}, response_{constraints} {}

  /// Fits to the layout of now, which is prepared; numbers of another layout begin free.
  void fit();
  /// The same, and forgets the events of the step before.
  void begin_step() {
    events.clear();
    released_.reset();
    fit();
  }
  [[nodiscard]] bool any() const noexcept { return !axes_.empty(); }
  [[nodiscard]] std::span<const GuardedAxis> axes() const noexcept { return axes_; }
  /// Position of one of a joint's numbers among the axes; nothing where it is not guarded.
  [[nodiscard]] std::optional<std::size_t> find(std::size_t joint, int axis) const;

  /// Begin of a smooth part: notes where the stops are from here, and does what blows at stops do to v.
  /// Whether v has changed.
  bool strike(const GuardedMotion& motion);
  /// Decides what holds and what slides from here, but for a number that has just been let go.
  void decide(const GuardedMotion& motion);
  /// Locks what is held in the kernel, and lets friction act on what slides, until `let_go`.
  void hold();
  void let_go();

  /// The first crossing in the parts of a record from `first` on.
  [[nodiscard]] std::optional<AxisCrossing> first_crossing(const MotionRecord& record, std::size_t first,
                                                           std::size_t coordinates) const;
  /// By how much what holds a number passes its bounds [1]: the greatest, where any does; > 0 = passes.
  struct Excess {
    double amount{-1};
    std::size_t axis{0};
    bool upper{false};
  };
  [[nodiscard]] Excess excess(const GuardedMotion& motion);
  [[nodiscard]] bool any_bounded_hold() const;
  /// By how much time a number has passed its crossing in q and v [s], < 0 where it is yet to come; 0 within
  /// rounding.
  [[nodiscard]] double miss(const AxisCrossing& crossing, const GuardedMotion& motion) const;
  /// Lets it happen in q, v and modes.
  void pass(const AxisCrossing& crossing, const GuardedMotion& motion);

  /// In the place of `decide`: what holds and what slides over a short step of h [s] whose events are not
  /// looked for. Whether v has changed.
  bool decide_over(const GuardedMotion& motion, double h);

  /// What stops and friction exert at the present state, by axis.
  [[nodiscard]] std::span<const double> efforts(const GuardedMotion& motion);

  std::vector<JointEvent> events{};  ///< of this step

 private:
  struct Range {
    double lower{0}, upper{0};
  };
  [[nodiscard]] AxisMode& mode(std::size_t i) const { return bodies_.state.axis_modes[i]; }
  [[nodiscard]] double& q_of(std::size_t i, const GuardedMotion& motion) const;
  [[nodiscard]] double& v_of(std::size_t i, const GuardedMotion& motion) const;
  [[nodiscard]] std::span<const double> tree_q(const GuardedMotion& motion) const;
  [[nodiscard]] bool at_lower(std::size_t i, const GuardedMotion& motion) const;
  [[nodiscard]] bool at_upper(std::size_t i, const GuardedMotion& motion) const;
  /// Efforts by which an axis at rest may be held.
  [[nodiscard]] Range bearing(std::size_t i, const GuardedMotion& motion) const;
  void note(std::size_t i, JointEventKind kind, const GuardedMotion& motion);
  void note_change(std::size_t i, const GuardedMotion& motion);  ///< of mode, against before_
  /// The axes of a tree, as positions from .first to .second.
  [[nodiscard]] std::pair<std::size_t, std::size_t> range_of(const Tree& tree) const;
  void accelerate(const GuardedMotion& motion);
  void fill_response(const Tree& tree, const GuardedMotion& motion);
  void strike_tree(const Tree& tree, const GuardedMotion& motion);
  void decide_tree(const Tree& tree, const GuardedMotion& motion);
  void add_response(const Tree& tree, const GuardedMotion& motion);
  void foresee(const Tree& tree, const GuardedMotion& motion, double h);
  bool bring_to_rest(const Tree& tree, const GuardedMotion& motion);
  void hold(bool locks);

  BodyStore& bodies_;
  ConstraintManager& constraints_;
  WorldDynamics& dynamics_;
  AxisResponse response_;
  BoxedProblem problem_{};
  std::uint64_t topology_{0};
  bool fits_{false};
  std::vector<GuardedAxis> axes_{};
  std::vector<Range> stops_{};  ///< where they are in this part
  std::optional<std::size_t> released_{};
  std::vector<std::size_t> picked_{};  ///< axes of the problem at hand
  std::vector<RigidMotion> grounds_{};
  std::vector<double> q_dot_{}, v_dot_{}, change_{}, efforts_{}, effort_of_axis_{};
  std::vector<std::uint8_t> locked_{}, open_{};  ///< by rate; by axis: to be decided
  std::vector<AxisMode> before_{};               ///< modes that are being decided anew
};

}  // namespace pantin
