#pragma once
// A prescribed motion: the trajectory of an animated body in the world, or of one body relative to another
// across a driven joint. Physics asks for pose, velocity and acceleration at any time of a step; a pose alone
// would feel like a fixed body to everything that touches it.
#include <limits>

#include <pantin/physics/pose.hpp>

namespace pantin {

/// Which of two one-sided limits is meant where a motion breaks.
enum class Side { Before, After };

class Driver {
 public:
  virtual ~Driver() = default;

  /// Motion of body B in A (the world, or the other body of a driven joint) at time `t` [s]; smooth between
  /// breaks, with derivatives that are the exact ones of the pose. Called several times a step, also for
  /// times ahead.
  [[nodiscard]] virtual RigidMotion motion(double t, Side side) const = 0;

  /// The first time > `t` at which pose, velocity or acceleration may jump; infinity if none. Steps land on
  /// it: a jump in velocity is an impulse on what hangs on the body, a jump in pose a teleport.
  [[nodiscard]] virtual double next_break(double t) const {
    (void)t;
    return std::numeric_limits<double>::infinity();
  }
};

}  // namespace pantin
