#pragma once
// A motor on one number of a joint: an effort that follows a target as well as its limit lets it. Torque,
// velocity and position control are the same law with other gains.
#include <limits>
#include <memory>
#include <optional>
#include <string_view>

#include <pantin/physics/driver.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

/// What a motor is to do; units go by the number, [rad] for angles and [m] for distances.
struct MotorTarget {
  double effort{0};  ///< [N m or N]
  double value{0};   ///< [rad or m], angles with their turns
  double rate{0};    ///< [rad/s or m/s]
};

/// A target as a function of time, as a trajectory to be tracked is one.
class MotorPath {
 public:
  virtual ~MotorPath() = default;
  /// Smooth between breaks, finite. Called several times a step, also for times ahead.
  [[nodiscard]] virtual MotorTarget target(double t, Side side) const = 0;
  /// The first time > `t` [s] at which the target may jump; infinity if none. Steps land on it.
  [[nodiscard]] virtual double next_break(double t) const {
    (void)t;
    return std::numeric_limits<double>::infinity();
  }
};

/// The motor acts on the joint's B, and the other way on its A, by
///   clamp(effort + stiffness (value - q) + damping (rate - v), -limit, limit),
/// q and v the number and its rate, B relative to A, at every stage of the integrator. By default it does
/// nothing. Torque: `effort`. Velocity: `rate` and a `damping` that is great against what the load asks for.
/// Position: `value`, `stiffness` and `damping`. Where the limit is met the effort has a kink, not a jump.
struct MotorSettings {
  static constexpr double kUnlimited = std::numeric_limits<double>::infinity();

  double effort{0};                         ///< [N m or N]
  double value{0};                          ///< [rad or m], angles with their turns
  double rate{0};                           ///< [rad/s or m/s]
  double stiffness{0};                      ///< [N m/rad or N/m], >= 0
  double damping{0};                        ///< [N m s/rad or N s/m], >= 0
  double limit{kUnlimited};                 ///< greatest effort either way [N m or N], >= 0
  std::shared_ptr<const MotorPath> path{};  ///< added to effort, value and rate; null = none
};

/// `subject` names the joint and the number, as in "motor on pivot 'elbow'".
[[nodiscard]] std::optional<SettingsProblem> problem_with(const MotorSettings& motor,
                                                          std::string_view subject);

/// Effort of a motor [N m or N] at a number of its joint, on B.
[[nodiscard]] double effort_of(const MotorSettings& motor, double t, Side side, double value, double rate);

}  // namespace pantin
