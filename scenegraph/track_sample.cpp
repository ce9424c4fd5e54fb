// Interpolation of glTF 2.0, appendix C, with derivatives. Between keys k and k + 1, d = t_{k+1} - t_k, u =
// (t - t_k) / d:
//   STEP         v_k
//   LINEAR       (1 - u) v_k + u v_{k+1}; rotations: slerp, written as a turn at constant speed (below)
//   CUBICSPLINE  (2u^3 - 3u^2 + 1) v_k + d (u^3 - 2u^2 + u) b_k + (-2u^3 + 3u^2) v_{k+1} + d (u^3 - u^2)
//   a_{k+1}
//                with out-tangent b_k and in-tangent a_{k+1}; rotations: normalised afterwards
// Slerp from q0 to q1, A the angle between them as 4-vectors, f = uA, and w = q1 - cos(A) q0 (orthogonal to
// q0, length sin A):  q = cos(f) q0 + (sin f / sin A) w,  q' = A/d (-sin(f) q0 + (cos f / sin A) w),  q'' =
// -(A/d)^2 q. A and w are taken from q1 - q0, which keeps them accurate for nearly equal keys.
#include <algorithm>
#include <cmath>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/track_parts.hpp>

namespace pantin {
namespace {

using Vector4 = Eigen::Vector4d;

/// A curve's value and derivatives at one time; w, x, y, z.
struct RotationSample {
  Vector4 value{Vector4::Zero()};
  Vector4 first{Vector4::Zero()};
  Vector4 second{Vector4::Zero()};
};

/// sin(x) / x.
double sinc(double x) {
  if (std::abs(x) < 1e-4) return 1 - x * x / 6;  // the next term, x^4 / 120, is below round-off
  return std::sin(x) / x;
}

Vector4 unit_key(const double* numbers) { return Eigen::Map<const Vector4>{numbers}.stableNormalized(); }

RotationSample slerp(const Vector4& q0, Vector4 q1, double u, double d) {
  if (q0.dot(q1) < 0) q1 = -q1;
  const Vector4 chord = q1 - q0;
  const double angle = 2 * std::atan2(chord.norm(), (q1 + q0).norm());
  const Vector4 w = chord + (chord.squaredNorm() / 2) * q0;  // 1 - cos(angle) = |chord|^2 / 2
  const double f = u * angle;
  RotationSample out;
  out.value = (std::cos(f) * q0 + (u * sinc(f) / sinc(angle)) * w).normalized();
  out.first = (-angle * std::sin(f) * q0 + (std::cos(f) / sinc(angle)) * w) / d;
  out.second = -(angle / d) * (angle / d) * out.value;
  return out;
}

/// Weights of v_k, b_k, v_{k+1}, a_{k+1} for value, first and second time derivative.
struct HermiteWeights {
  HermiteWeights(double u, double d)
      : value{(1 + 2 * u) * (1 - u) * (1 - u), d * u * (1 - u) * (1 - u), u * u * (3 - 2 * u),
              d * u * u * (u - 1)},
        first{6 * u * (u - 1) / d, (3 * u - 1) * (u - 1), 6 * u * (1 - u) / d, u * (3 * u - 2)},
        second{(12 * u - 6) / (d * d), (6 * u - 4) / d, (6 - 12 * u) / (d * d), (6 * u - 2) / d} {}
  Vector4 value;
  Vector4 first;
  Vector4 second;
};

/// q = p / n, n = |p|:  n' = q.p',  q' = (p' - n' q) / n,  n'' = (p'.p' + p.p'' - n'^2) / n,
/// q'' = (p'' - 2 n' q' - n'' q) / n.
RotationSample normalised(const RotationSample& p) {
  const double n = p.value.norm();
  RotationSample q;
  q.value = p.value / n;
  const double n1 = q.value.dot(p.first);
  q.first = (p.first - n1 * q.value) / n;
  const double n2 = (p.first.squaredNorm() + p.value.dot(p.second) - n1 * n1) / n;
  q.second = (p.second - 2 * n1 * q.first - n2 * q.value) / n;
  return q;
}

/// One part of a track between keys k and k + 1.
class Interval {
 public:
  Interval(const Track& track, std::size_t k, double time)
      : track_{track},
        k_{k},
        d_{track.times[k + 1] - track.times[k]},
        u_{(time - track.times[k]) / d_},
        weights_{u_, d_} {}

  void numbers(const TrackPart& part, TrackSample& out) const {
    for (int j = part.first; j < part.first + part.count; ++j) {
      const std::size_t i = static_cast<std::size_t>(j);
      const double v0 = key_value(track_, k_)[j];
      const double v1 = key_value(track_, k_ + 1)[j];
      if (track_.interpolation == Interpolation::Linear) {
        out.value[i] = (1 - u_) * v0 + u_ * v1;
        out.first[i] = (v1 - v0) / d_;
        continue;
      }
      const Vector4 controls = this->controls(j);
      out.value[i] = weights_.value.dot(controls);
      out.first[i] = weights_.first.dot(controls);
      out.second[i] = weights_.second.dot(controls);
    }
  }

  void rotation(const TrackPart& part, TrackSample& out) const {
    const RotationSample q = rotation(part.first);
    for (int j = 0; j < 4; ++j) {
      const std::size_t i = static_cast<std::size_t>(part.first + j);
      out.value[i] = q.value[j];
      out.first[i] = q.first[j];
      out.second[i] = q.second[j];
    }
  }

 private:
  /// v_k, b_k, v_{k+1}, a_{k+1} of number j.
  [[nodiscard]] Vector4 controls(int j) const {
    const double* left = key_value(track_, k_);
    const double* right = key_value(track_, k_ + 1);
    return {left[j], left[j + track_.width], right[j], right[j - track_.width]};
  }

  [[nodiscard]] RotationSample rotation(int first) const {
    const double* left = key_value(track_, k_) + first;
    const double* right = key_value(track_, k_ + 1) + first;
    if (track_.interpolation == Interpolation::Linear) return slerp(unit_key(left), unit_key(right), u_, d_);
    RotationSample p;
    for (int j = 0; j < 4; ++j) {
      const Vector4 controls = this->controls(first + j);
      p.value[j] = weights_.value.dot(controls);
      p.first[j] = weights_.first.dot(controls);
      p.second[j] = weights_.second.dot(controls);
    }
    const double scale = Eigen::Map<const Vector4>{left}.norm() + Eigen::Map<const Vector4>{right}.norm();
    if (p.value.norm() > 1e-9 * scale) return normalised(p);
    return {unit_key(u_ < 0.5 ? left : right), Vector4::Zero(), Vector4::Zero()};
  }

  const Track& track_;
  std::size_t k_;
  double d_;
  double u_;
  HermiteWeights weights_;
};

void hold(const Track& track, std::size_t k, TrackSample& out) {
  for (const TrackPart& part : parts_of(track)) {
    const double* key = key_value(track, k) + part.first;
    double* value = out.value.data() + part.first;
    std::copy(key, key + part.count, value);
    if (part.is_rotation) Eigen::Map<Vector4>{value} = unit_key(key);
  }
}

}  // namespace

std::span<const TrackPart> parts_of(const Track& track) noexcept {
  static constexpr TrackPart kNumber[] = {{0, 1, false}};
  static constexpr TrackPart kTwo[] = {{0, 2, false}};
  static constexpr TrackPart kVector[] = {{0, 3, false}};
  static constexpr TrackPart kRotation[] = {{0, 4, true}};
  static constexpr TrackPart kPose[] = {{0, 3, false}, {3, 4, true}};
  switch (track.width) {
    case 1:
      return kNumber;
    case 2:
      return kTwo;
    case 3:
      return kVector;
    case 4:
      return kRotation;
    case 7:
      return kPose;
    default:
      return {};
  }
}

TrackSample sample(const Track& track, double time, KeySide side) {
  PANTIN_EXPECTS(!track.times.empty() && track.values.size() == track.times.size() * values_per_key(track),
                 "a track of " + std::to_string(track.times.size()) + " keys with " +
                     std::to_string(track.values.size()) + " numbers cannot be sampled; see problem_with");
  PANTIN_EXPECTS(!std::isnan(time), "the time to sample at is not a number");
  const std::vector<double>& times = track.times;
  const auto beyond = side == KeySide::After ? std::upper_bound(times.begin(), times.end(), time)
                                             : std::lower_bound(times.begin(), times.end(), time);
  const std::size_t right = static_cast<std::size_t>(beyond - times.begin());
  const std::size_t left = right == 0 ? 0 : right - 1;
  TrackSample out;
  if (right == 0 || right == times.size() || track.interpolation == Interpolation::Step) {
    hold(track, left, out);
    return out;
  }
  const Interval interval{track, left, time};
  for (const TrackPart& part : parts_of(track)) {
    if (part.is_rotation) interval.rotation(part, out);
    else interval.numbers(part, out);
  }
  return out;
}

}  // namespace pantin
