// Interpolation of glTF 2.0, appendix C, with derivatives. Between keys k and k + 1, d = t_{k+1} - t_k, u =
// (t - t_k) / d:
//   STEP         v_k
//   LINEAR       (1 - u) v_k + u v_{k+1}; rotations: slerp, written as a turn at constant speed (below)
//   CUBICSPLINE  (2u^3 - 3u^2 + 1) v_k + d (u^3 - 2u^2 + u) b_k + (-2u^3 + 3u^2) v_{k+1} + d (u^3 - u^2)
//   a_{k+1}
//                with out-tangent b_k and in-tangent a_{k+1}; rotations: normalised afterwards
// Slerp from q0 to q1, A the angle between them as 4-vectors, f = uA, and e = (q1 - cos(A) q0) / sin(A),
// which is of length 1 and orthogonal to q0:  q = cos(f) q0 + sin(f) e,  q' = A/d (-sin(f) q0 + cos(f) e),
// q'' =
// -(A/d)^2 q.
#include <algorithm>
#include <cmath>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/prepared_clip.hpp>
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

template <bool kDerivatives>
RotationSample slerp(const double* arc, double u, double d) {
  const Eigen::Map<const Vector4> from{arc}, across{arc + 4};
  const double angle = arc[8];
  const double c = std::cos(u * angle), s = std::sin(u * angle);
  RotationSample out;
  out.value = c * from + s * across;
  if constexpr (!kDerivatives) return out;
  const double rate = angle / d;
  out.first = rate * (c * across - s * from);
  out.second = -rate * rate * out.value;
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

/// Where the numbers of a sample go; the derivatives only where they are wanted.
struct SampleNumbers {
  double* value;
  double* first;
  double* second;
};

/// What lies between two rows of a track.
template <bool kDerivatives>
class Interval {
 public:
  Interval(const Track& track, const double* left, const double* right, double time)
      : parts_{parts_of(track)},
        left_{left + 1},
        right_{right + 1},
        d_{*right - *left},
        u_{(time - *left) / d_} {}

  void linear(SampleNumbers out) {
    for (const TrackPart& part : parts_) {
      if (part.is_rotation) {
        set(slerp<kDerivatives>(left_, u_, d_), out);
        pass(9);
      } else {
        for (int i = 0; i < part.count; ++i) {
          out.value[i] = (1 - u_) * left_[i] + u_ * right_[i];
          if constexpr (kDerivatives) out.first[i] = (right_[i] - left_[i]) / d_;
        }
        pass(part.count);
      }
      skip(part.count, out);
    }
  }

  void cubic(SampleNumbers out) {
    const HermiteWeights weights{u_, d_};
    for (const TrackPart& part : parts_) {
      if (part.is_rotation) {
        set(cubic_rotation(weights), out);
        pass(16);
      } else {
        for (int i = 0; i < part.count; ++i) {
          const Vector4 controls = this->controls(i);
          out.value[i] = weights.value.dot(controls);
          if constexpr (!kDerivatives) continue;
          out.first[i] = weights.first.dot(controls);
          out.second[i] = weights.second.dot(controls);
        }
        pass(3 * part.count);
      }
      skip(part.count, out);
    }
  }

 private:
  /// v_k, b_k, v_{k+1}, a_{k+1} of number i of the part.
  [[nodiscard]] Vector4 controls(int i) const {
    return {left_[3 * i + 1], left_[3 * i + 2], right_[3 * i + 1], right_[3 * i]};
  }
  /// Where the curve passes through 0 there is no rotation: the nearer key, at rest.
  [[nodiscard]] RotationSample cubic_rotation(const HermiteWeights& weights) const {
    RotationSample p;
    double scale = 0;
    for (int j = 0; j < 4; ++j) {
      const Vector4 controls = this->controls(j);
      p.value[j] = weights.value.dot(controls);
      p.first[j] = weights.first.dot(controls);
      p.second[j] = weights.second.dot(controls);
      scale += std::abs(controls[0]) + std::abs(controls[2]);
    }
    if (p.value.norm() > 1e-9 * scale) return normalised(p);
    RotationSample key;
    key.value = Eigen::Map<const Vector4>{(u_ < 0.5 ? left_ : right_) + 12};
    return key;
  }
  void pass(int numbers) {
    left_ += numbers;
    right_ += numbers;
  }
  static void skip(int numbers, SampleNumbers& out) {
    out.value += numbers;
    if constexpr (!kDerivatives) return;
    out.first += numbers;
    out.second += numbers;
  }
  static void set(const RotationSample& q, const SampleNumbers& out) {
    Eigen::Map<Vector4>{out.value} = q.value;
    if constexpr (!kDerivatives) return;
    Eigen::Map<Vector4>{out.first} = q.first;
    Eigen::Map<Vector4>{out.second} = q.second;
  }

  std::span<const TrackPart> parts_;
  const double* left_;
  const double* right_;
  double d_;
  double u_;
};

/// The value of a key, from its row.
void hold(const Track& track, const double* row, double* value) {
  const bool is_cubic = track.interpolation == Interpolation::CubicSpline;
  ++row;
  for (const TrackPart& part : parts_of(track)) {
    if (part.is_rotation) {
      if (is_cubic) row += 12;
      value = std::copy(row, row + 4, value);
      row += is_cubic ? 4 : 9;
    } else {
      for (int i = 0; i < part.count; ++i) *value++ = row[is_cubic ? 3 * i + 1 : i];
      row += is_cubic ? 3 * part.count : part.count;
    }
  }
}

template <bool kDerivatives>
void interpolate(const Track& track, const double* left, const double* right, double time,
                 const SampleNumbers& out) {
  Interval<kDerivatives> interval{track, left, right, time};
  if (track.interpolation == Interpolation::Linear) interval.linear(out);
  else interval.cubic(out);
}

bool is_passed(double key, double time, KeySide side) {
  return side == KeySide::After ? key <= time : key < time;
}

/// Number of keys at or before (side After) or before (side Before) a time.
std::size_t keys_before(const std::vector<double>& times, double time, KeySide side) {
  const auto beyond = side == KeySide::After ? std::upper_bound(times.begin(), times.end(), time)
                                             : std::lower_bound(times.begin(), times.end(), time);
  return static_cast<std::size_t>(beyond - times.begin());
}

/// The same, looked for at the cursor and right after it first.
std::size_t keys_before(const PreparedTrack& track, double time, KeySide side, KeyCursor& cursor) {
  const std::size_t count = track.track->times.size();
  std::size_t right = cursor;
  if (right > 0 && right <= count && is_passed(*track.row(right - 1), time, side)) {
    if (right < count && is_passed(*track.row(right), time, side)) ++right;
    if (right == count || !is_passed(*track.row(right), time, side))
      return cursor = static_cast<KeyCursor>(right);
  }
  return cursor = static_cast<KeyCursor>(keys_before(track.track->times, time, side));
}

template <bool kDerivatives>
void sample_at(const PreparedTrack& prepared, const SamplePoint& at, KeyCursor& cursor,
               const SampleNumbers& out) {
  const Track& track = *prepared.track;
  const std::size_t count = track.times.size();
  std::size_t right = keys_before(prepared, at.time, at.side, cursor);
  double time = at.time;
  // A time that is meant to hit a key is moved onto it.
  const bool hits_left = right > 0 && time - *prepared.row(right - 1) <= at.slack;
  const bool hits_right = right < count && *prepared.row(right) - time <= at.slack;
  if (hits_left || hits_right) {
    const std::size_t key = hits_left ? right - 1 : right;
    time = *prepared.row(key);
    right = at.side == KeySide::After ? key + 1 : key;
  }
  const std::size_t left = right == 0 ? 0 : right - 1;
  if (right == 0 || right == count || track.interpolation == Interpolation::Step)
    hold(track, prepared.row(left), out.value);
  else interpolate<kDerivatives>(track, prepared.row(left), prepared.row(right), time, out);
}

}  // namespace

TrackSample sample(const Track& track, double time, KeySide side) {
  PANTIN_EXPECTS(!track.times.empty() && track.values.size() == track.times.size() * values_per_key(track),
                 "a track of " + std::to_string(track.times.size()) + " keys with " +
                     std::to_string(track.values.size()) + " numbers cannot be sampled; see problem_with");
  PANTIN_EXPECTS(!std::isnan(time), "the time to sample at is not a number");
  const std::size_t right = keys_before(track.times, time, side);
  std::array<double, 26> left_row, right_row;
  fill_row(track, right == 0 ? 0 : right - 1, left_row.data());
  TrackSample out;
  if (right == 0 || right == track.times.size() || track.interpolation == Interpolation::Step) {
    hold(track, left_row.data(), out.value.data());
    return out;
  }
  fill_row(track, right, right_row.data());
  interpolate<true>(track, left_row.data(), right_row.data(), time,
                    {out.value.data(), out.first.data(), out.second.data()});
  return out;
}

TrackSample sample(const PreparedTrack& prepared, const SamplePoint& at, KeyCursor& cursor) {
  TrackSample out;
  sample_at<true>(prepared, at, cursor, {out.value.data(), out.first.data(), out.second.data()});
  return out;
}

void sample_values(const PreparedTrack& prepared, const SamplePoint& at, KeyCursor& cursor,
                   std::array<double, 7>& values) {
  sample_at<false>(prepared, at, cursor, {values.data(), nullptr, nullptr});
}

}  // namespace pantin
