#pragma once
// What takes part in the comparison: one method of one engine on one problem, with a row of settings from
// coarse to fine.
#include <array>
#include <string>
#include <vector>

namespace pantin::bench {

using Point = std::array<double, 3>;

class Contender {
 public:
  virtual ~Contender() = default;

  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual int order() const = 0;
  /// What setting number k >= 0 is, in words; each costs more than the one before.
  [[nodiscard]] virtual std::string setting(int k) const = 0;
  /// Goes back to the start, to run at setting k. Not timed.
  virtual void prepare(int k) = 0;
  /// From the start to the end: what is timed. False if the engine gave up.
  [[nodiscard]] virtual bool run() = 0;
  /// Derivatives evaluated in the last run.
  [[nodiscard]] virtual long evaluations() const = 0;
  /// Where things are after the run [m]: of a chain the centres of gravity, of the top the ends of three unit
  /// vectors that turn with it.
  [[nodiscard]] virtual std::vector<Point> points() = 0;
};

/// What the contenders of fixed steps do at setting number k.
[[nodiscard]] inline long steps_per_second(int k) { return 16L << k; }

/// Columns of the rotation matrix of the quaternion (w, x, y, z), made a unit.
[[nodiscard]] inline std::vector<Point> axes_of(double w, double x, double y, double z) {
  const double s = 2 / (w * w + x * x + y * y + z * z);
  return {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
          {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
          {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}};
}

}  // namespace pantin::bench
