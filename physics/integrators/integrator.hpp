#pragma once
// The family of integrators and what they see of the world: coordinates q, velocities v and two functions of
// time and state. An integrator knows no body, joint or force. To add one: a file with a class, and one line
// in catalogue.cpp.
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pantin/physics/integrators/jacobian.hpp>
#include <pantin/physics/integrators/motion_record.hpp>

namespace pantin {

/// States at several instants, side by side: number i of stage s stands at [i * at.size() + s].
struct Stages {
  std::span<const Instant> at{};
  std::span<const double> q{}, v{};
  std::span<double> q_dot{}, v_dot{};
};

/// Forces of one number each that may be stiff, at several states side by side: how its stretch changes with
/// a change of q, and the stretch's rate with one of v; how v' changes with its effort. Of line r, number i
/// of stage s stands at [(r * n + i) * stages + s], n the size of q, v, v.
struct LineStages {
  std::span<double> stretch_by_q{}, rate_by_v{}, response{};
};
struct LineStiffness {
  double stiffness{0}, damping{0};  ///< effort = stiffness * stretch + damping * its rate, drawing it in
};

/// q' = rate(q, v), v' = acceleration(t, q, v). Coordinates and rates need not be of one size: an attitude is
/// a quaternion (four coordinates, embedded in R^4, used as if normalised) with three angular momenta or
/// rates. All functions may be called at any stage, with any q near the manifold.
class Dynamics {
 public:
  virtual ~Dynamics() = default;

  [[nodiscard]] virtual std::size_t coordinates() const = 0;  ///< size of q
  [[nodiscard]] virtual std::size_t velocities() const = 0;   ///< size of v

  virtual void rate(Instant at, std::span<const double> q, std::span<const double> v,
                    std::span<double> q_dot) = 0;
  virtual void acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                            std::span<double> v_dot) = 0;
  /// Both of the above at one state, for the price of the second.
  virtual void derivative(Instant at, std::span<const double> q, std::span<const double> v,
                          std::span<double> q_dot, std::span<double> v_dot) {
    rate(at, q, v, q_dot);
    acceleration(at, q, v, v_dot);
  }
  /// The derivative at several states side by side, for methods whose stages can be computed at once. Unless
  /// told otherwise, one after the other.
  virtual void derivatives(const Stages& stages);
  /// q' alone at several states; of `stages` q_dot is written, v_dot is not touched.
  virtual void rates(const Stages& stages);
  /// Which numbers touch each other. Unless told otherwise all do: one group.
  virtual void list_groups(NumberGroups& groups);
  /// Fills the blocks of J, which fits the groups of list_groups and is zero. Unless told otherwise by
  /// one-sided differences: as many derivatives as the greatest group has numbers.
  virtual void jacobian(const JacobianPoint& point, Jacobian& J);
  /// The lines along which stiff forces act. Unless told otherwise, none.
  [[nodiscard]] virtual std::span<const LineStiffness> lines() { return {}; }
  /// How they lie at the stages, of which v_dot is known.
  virtual void place_lines(const Stages& stages, const LineStages& out) { (void)stages, (void)out; }
  /// As jacobian, by differences, with the efforts along lines staying what they are at the point.
  virtual void jacobian_beside_lines(const JacobianPoint& point, Jacobian& J) { jacobian(point, J); }
  /// Upper estimates of how far a unit of each coordinate and velocity moves any body [m or rad per unit], at
  /// any state: what iterations may stop by. Unless told otherwise, one.
  virtual void weights(std::span<double> q_weight, std::span<double> v_weight);
  /// Brings q and v back to the manifold (unit quaternions, constraints that only the dynamics sees) without
  /// changing numbers that are on it.
  virtual void settle(Instant at, std::span<double> q, std::span<double> v) { (void)at, (void)q, (void)v; }
  /// Whether `settle` may change more than lengths of quaternions, so that a derivative known from before it
  /// is no longer that of the settled state.
  [[nodiscard]] virtual bool has_constraints() const { return false; }
  /// How far bodies are off where q' is wrong by `q_error` and v' by `v_error` over a step of h from (q, v),
  /// per unit time: the greatest distance [m/s] or angle [rad/s], an error of velocity counting h times.
  /// Unless told otherwise, every number counts as a metre.
  [[nodiscard]] virtual double motion_error(std::span<const double> q, std::span<const double> v,
                                            std::span<const double> q_error, std::span<const double> v_error,
                                            double h);
  /// Whether q' is v, number by number. Unless told otherwise, it is not.
  [[nodiscard]] virtual bool rates_are_velocities() const { return false; }
  /// Whether v' depends on v besides through constraints that the caller does not see.
  [[nodiscard]] virtual bool acceleration_depends_on_velocity() const { return true; }

 protected:
  /// The blocks of these groups by differences.
  void take_differences(const JacobianPoint& point, std::span<const std::size_t> wanted, Jacobian& J);
  /// All blocks by differences.
  void take_differences(const JacobianPoint& point, Jacobian& J);

 private:
  /// Columns first .. first + count of these groups' blocks.
  void take_columns(const JacobianPoint& point, std::span<const std::size_t> wanted, std::size_t first,
                    std::size_t count, Jacobian& J);

  static constexpr std::size_t kSideBySide = 4;  ///< states that differences are taken at together
  struct Differences {
    std::vector<std::size_t> wanted{};
    std::vector<double> state{}, slope{};
    std::vector<Instant> at{};
  };
  std::vector<double> one_stage_{};  // work space of derivatives and rates
  Differences differences_{};        // work space of jacobian
};

/// What a method that looks back keeps from step to step, as part of State. It counts only where the state
/// presented is to the bit the one reached.
struct StepMemory {
  double next{0};                   ///< step to be tried first [s]; 0 = the step asked for
  double last{0};                   ///< step that the slopes are of [s]
  std::vector<double> reached{};    ///< q and v at its end
  std::vector<double> slopes{};     ///< q' and v' over it, as Legendre coefficients
  std::vector<double> kept_back{};  ///< what rounding has kept back from q and v
};

/// What an integrator that chooses its own steps, inside the step asked for, keeps and says of them.
struct StepControl {
  StepMemory memory{};
  int accepted{0};     ///< of the last step asked for
  int refused{0};      ///< for missing the tolerance
  double shortest{0};  ///< accepted [s]
};

/// Advances q and v by one step of size h. Keeps its work space between steps: a steady step allocates
/// nothing.
class Integrator {
 public:
  virtual ~Integrator() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;  ///< as in the catalogue
  [[nodiscard]] virtual int order() const = 0;              ///< global order of accuracy
  /// Evaluations of v' in one step; the least, where the integrator decides that itself.
  [[nodiscard]] virtual int evaluations(const Dynamics& dynamics) const = 0;
  /// From t to t + h, h > 0. The derivative is asked with Side::After at t and Side::Before at later times. q
  /// and v are settled at the end.
  virtual void step(Dynamics& dynamics, double t, double h, std::span<double> q, std::span<double> v) = 0;
  /// A new one of the same kind and settings. Unless told otherwise, by name from the catalogue; rk4 for a
  /// name that is not there.
  [[nodiscard]] virtual std::unique_ptr<Integrator> another() const;
  /// Error per unit time that it keeps to by choosing its steps; infinity: it takes the steps it is asked
  /// for.
  [[nodiscard]] virtual double tolerance() const { return std::numeric_limits<double>::infinity(); }
  /// Steps up to this over the rate of the fastest motion are borne: |eigenvalue| h of what decays and what
  /// swings. Infinity: of any length, or it chooses its own.
  [[nodiscard]] virtual double stability_radius() const { return std::numeric_limits<double>::infinity(); }
  /// Its own control of steps; null if it takes the steps it is asked for.
  [[nodiscard]] virtual StepControl* control() { return nullptr; }
  /// Where to add the motion inside steps from now on; null = nowhere. Ignored by an integrator that has no
  /// interpolant of its own.
  void record_into(MotionRecord* record) noexcept { record_ = record; }

 protected:
  MotionRecord* record_{nullptr};
};

/// A new integrator by name; null for an unknown name.
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(std::string_view name);
/// One that keeps to a tolerance: local error per unit time of body position [m/s] and attitude [rad/s], > 0;
/// infinity: no control. Null for an unknown name or an integrator that does not choose its steps.
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(std::string_view name, double tolerance);
/// All known names: "euler", "semi-implicit-euler", "verlet", "rk4", "implicit-midpoint", "dormand-prince",
/// "gauss8", "gauss16", "radau".
[[nodiscard]] std::vector<std::string> integrator_names();

}  // namespace pantin
