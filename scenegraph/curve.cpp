#include <algorithm>
#include <cmath>

#include <pantin/scenegraph/curve.hpp>
#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/track_parts.hpp>

namespace pantin {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double value_of_key(const Curve& curve, std::size_t k) { return *key_value(curve.keys(), k); }

/// Slope of a warp outside its keys.
double slope_before(const Curve& warp) {
  const Track& keys = warp.keys();
  if (keys.interpolation == Interpolation::CubicSpline) return key_value(keys, 0)[-1];
  if (keys.times.size() == 1) return 1;
  return (value_of_key(warp, 1) - value_of_key(warp, 0)) / (keys.times[1] - keys.times[0]);
}
double slope_after(const Curve& warp) {
  const Track& keys = warp.keys();
  const std::size_t last = keys.times.size() - 1;
  if (keys.interpolation == Interpolation::CubicSpline) return key_value(keys, last)[1];
  if (last == 0) return 1;
  return (value_of_key(warp, last) - value_of_key(warp, last - 1)) /
         (keys.times[last] - keys.times[last - 1]);
}

/// Whether its least slope between keys k and k + 1 is below 0. A cubic's slope is a parabola in u.
bool runs_back(const Curve& warp, std::size_t k) {
  const Track& keys = warp.keys();
  const double d = keys.times[k + 1] - keys.times[k];
  const double mean = (value_of_key(warp, k + 1) - value_of_key(warp, k)) / d;
  if (keys.interpolation != Interpolation::CubicSpline) return mean < 0;
  const double m0 = key_value(keys, k)[1], m1 = key_value(keys, k + 1)[-1];
  // slope(u) = m0 + b u + a u^2
  const double b = 6 * mean - 4 * m0 - 2 * m1, a = 3 * (m0 + m1) - 6 * mean;
  double least = std::min(m0, m1);
  const double u = a != 0 ? -b / (2 * a) : 0;
  if (u > 0 && u < 1) least = std::min(least, m0 + u * (b + a * u));
  constexpr double kRoundOff = 1e-12;
  return least < -kRoundOff * (std::abs(m0) + std::abs(m1) + std::abs(mean));
}

}  // namespace

Curve::Curve(double constant) : Curve{Interpolation::Step, {0}, {constant}} {}

Curve::Curve(Interpolation interpolation, std::vector<double> times, std::vector<double> values)
    : keys_{.channel = Channel::LinkValue,
            .interpolation = interpolation,
            .width = 1,
            .times = std::move(times),
            .values = std::move(values)} {}

Curve Curve::shifted(double delay, double rise) const {
  Curve later = *this;
  for (double& time : later.keys_.times) time += delay;
  if (rise == 0) return later;
  const std::size_t stride = values_per_key(keys_);
  for (std::size_t i = stride / 2; i < keys_.values.size(); i += stride) later.keys_.values[i] += rise;
  return later;
}

std::string problem_with(const FadeSettings& settings) {
  for (const double number : {settings.begin, settings.from, settings.to})
    if (!std::isfinite(number)) return "begin, from and to of a fade must be finite";
  if (!(settings.duration > 0) || !std::isfinite(settings.duration) ||
      !(settings.begin + settings.duration > settings.begin))
    return "duration " + std::to_string(settings.duration) + " s of a fade is not positive";
  return {};
}

Curve fade(const FadeSettings& settings) {
  const std::string problem = problem_with(settings);
  PANTIN_EXPECTS(problem.empty(), problem);
  return {Interpolation::CubicSpline,
          {settings.begin, settings.begin + settings.duration},
          {0, settings.from, 0, 0, settings.to, 0}};
}

std::string problem_with(const Curve& curve) {
  // Times before 0 are fine here, so the keys are judged as if they began at 0.
  Track keys = curve.keys();
  if (!keys.times.empty() && std::isfinite(keys.times.front()))
    for (double& time : keys.times) time -= curve.keys().times.front();
  if (std::string text = problem_with(keys); !text.empty()) return text;
  for (std::size_t k = 1; k < keys.times.size(); ++k)
    if (!(curve.keys().times[k - 1] < curve.keys().times[k]))
      return "key " + std::to_string(k) + " is not after the key before it";
  return {};
}

std::string problem_with_warp(const Curve& warp) {
  if (std::string text = problem_with(warp); !text.empty()) return text;
  const Track& keys = warp.keys();
  if (keys.interpolation == Interpolation::Step) return "time cannot go on in steps; use Linear keys";
  if (slope_before(warp) < 0) return "it runs back before its first key";
  if (slope_after(warp) < 0) return "it runs back after its last key";
  for (std::size_t k = 0; k + 1 < keys.times.size(); ++k)
    if (runs_back(warp, k))
      return "it runs back between keys " + std::to_string(k) + " and " + std::to_string(k + 1) +
             "; for playing backwards there is a negative speed";
  return {};
}

CurveSample sample(const Curve& curve, double time, KeySide side) {
  const TrackSample at = sample(curve.keys(), time, side);
  return {at.value[0], at.first[0], at.second[0]};
}

CurveSample sample_warp(const Curve& warp, double time, KeySide side) {
  const std::vector<double>& times = warp.keys().times;
  const bool at_or_before = side == KeySide::After ? time < times.front() : time <= times.front();
  if (at_or_before) {
    const double slope = slope_before(warp);
    return {value_of_key(warp, 0) + slope * (time - times.front()), slope, 0};
  }
  const bool at_or_after = side == KeySide::After ? time >= times.back() : time > times.back();
  if (at_or_after) {
    const double slope = slope_after(warp);
    return {value_of_key(warp, times.size() - 1) + slope * (time - times.back()), slope, 0};
  }
  return sample(warp, time, side);
}

double time_of(const Curve& warp, double value) {
  const std::vector<double>& times = warp.keys().times;
  const std::size_t last = times.size() - 1;
  if (value <= value_of_key(warp, 0)) {
    const double slope = slope_before(warp), missing = value - value_of_key(warp, 0);
    if (slope > 0) return times.front() + missing / slope;
    return missing < 0 ? -kInfinity : times.front();
  }
  if (value > value_of_key(warp, last)) {
    const double slope = slope_after(warp);
    return slope > 0 ? times.back() + (value - value_of_key(warp, last)) / slope : kInfinity;
  }
  std::size_t k = 0;
  while (value_of_key(warp, k + 1) < value) ++k;
  if (warp.keys().interpolation == Interpolation::Linear) {
    const double v0 = value_of_key(warp, k), v1 = value_of_key(warp, k + 1);
    const double u = (value - v0) / (v1 - v0);
    return u < 1 ? (1 - u) * times[k] + u * times[k + 1] : times[k + 1];
  }
  // Monotone, so halving finds the first time to the last bit.
  double before = times[k], after = times[k + 1];
  while (true) {
    const double middle = before + (after - before) / 2;
    if (!(before < middle && middle < after)) return after;
    (sample(warp, middle, KeySide::After).value < value ? before : after) = middle;
  }
}

}  // namespace pantin
