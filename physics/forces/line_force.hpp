#pragma once
// What acts along one number, a stretch, as a spring does along the line between its ends: with an effort
// k (stretch) + c (its rate) that draws the stretch in. Implicit integrators follow how it turns with the
// motion, however stiff it is.
#include <span>

#include <pantin/physics/bodies_at.hpp>

namespace pantin {

class LineForce {
 public:
  virtual ~LineForce() = default;
  [[nodiscard]] virtual double stiffness() const = 0;  ///< k, of effort by stretch
  [[nodiscard]] virtual double damping() const = 0;    ///< c, of effort by rate of stretch
  [[nodiscard]] virtual double effort(const BodiesAt& at) const = 0;
  /// Adds the wrenches of an effort; their power is -effort times the rate of the stretch.
  virtual void add_effort(const BodiesAt& at, double effort, std::span<Wrench> wrenches) const = 0;
};

}  // namespace pantin
