#pragma once
// A number as a function of time, given by keys: a weight that fades, a warp of time.
#include <limits>
#include <string>
#include <vector>

#include <pantin/scenegraph/clip.hpp>

namespace pantin {

/// A curve's value with its exact time derivatives.
struct CurveSample {
  double value{0};
  double first{0};   ///< [1/s]
  double second{0};  ///< [1/s^2]
};

/// Keys of one number, interpolated as a Track's; a plain number is a constant. Keys may be at negative
/// times.
class Curve {
 public:
  Curve(double constant = 0);  // NOLINT: `.weight = 0.5` is what one wants to write
  /// `values` as in a Track of width 1: for CubicSpline in-tangent, value, out-tangent for each key.
  Curve(Interpolation interpolation, std::vector<double> times, std::vector<double> values);

  [[nodiscard]] const Track& keys() const noexcept { return keys_; }
  [[nodiscard]] bool is_constant() const noexcept { return keys_.times.size() == 1; }
  /// The same curve later by `delay` [s] and higher by `rise`.
  [[nodiscard]] Curve shifted(double delay, double rise = 0) const;

 private:
  Track keys_;
};

/// From one value to another within a span of time, with the slope 0 at both ends:
/// from + (to - from) (3 u^2 - 2 u^3), u from 0 to 1.
struct FadeSettings {
  double begin{0};       ///< [s]
  double duration{0.3};  ///< [s], > 0
  double from{0};
  double to{1};
};
[[nodiscard]] std::string problem_with(const FadeSettings& settings);  ///< empty if nothing is
[[nodiscard]] Curve fade(const FadeSettings& settings);

/// What is wrong with a curve (no keys, unsorted, wrong count, not finite); empty if nothing is.
[[nodiscard]] std::string problem_with(const Curve& curve);
/// What is wrong with a curve as a warp of time: a Step in it, or a place where it runs back; empty if
/// nothing is.
[[nodiscard]] std::string problem_with_warp(const Curve& warp);

/// Held before its first and after its last key.
[[nodiscard]] CurveSample sample(const Curve& curve, double time, KeySide side = KeySide::After);
/// The same, but before its first and after its last key it goes on straight: Linear as between the two keys
/// there (at rate 1 if there is only one), CubicSpline with the first key's in-tangent and the last one's
/// out-tangent.
[[nodiscard]] CurveSample sample_warp(const Curve& warp, double time, KeySide side = KeySide::After);
/// The first time at which a warp reaches a value; infinity if it never does, minus infinity if it always
/// had.
[[nodiscard]] double time_of(const Curve& warp, double value);

/// The first key > `time` of a curve that has more than one; infinity if there is none.
[[nodiscard]] inline double next_break(const Curve& curve, double time) {
  return next_break(curve.keys(), time);
}

}  // namespace pantin
