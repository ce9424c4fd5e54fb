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
// -(A/d)^2 q. A and e are taken from q1 - q0, which keeps them accurate for nearly equal keys.
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

Vector4 unit_key(const double* numbers) { return Eigen::Map<const Vector4>{numbers}.stableNormalized(); }

/// From a key's quaternion to the next one's; the last key's own.
Arc arc_from(const Track& track, std::size_t k, int first) {
  Arc arc;
  arc.from = unit_key(key_value(track, k) + first);
  if (k + 1 == track.times.size() || track.interpolation != Interpolation::Linear) return arc;
  Vector4 to = unit_key(key_value(track, k + 1) + first);
  if (arc.from.dot(to) < 0) to = -to;
  const Vector4 chord = to - arc.from;
  arc.angle = 2 * std::atan2(chord.norm(), (to + arc.from).norm());
  const Vector4 across = chord + (chord.squaredNorm() / 2) * arc.from;  // 1 - cos(angle) = |chord|^2 / 2
  if (across.norm() > 0) arc.across = across.normalized();
  return arc;
}

template <bool kDerivatives>
RotationSample slerp(const Arc& arc, double u, double d) {
  const double f = u * arc.angle;
  const double c = std::cos(f), s = std::sin(f);
  RotationSample out;
  out.value = c * arc.from + s * arc.across;
  if constexpr (!kDerivatives) return out;
  const double rate = arc.angle / d;
  out.first = rate * (c * arc.across - s * arc.from);
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

/// Numbers of a sample that are being filled in; the derivatives only where they are wanted.
struct SampleNumbers {
  double* value;
  double* first;
  double* second;

  template <bool kDerivatives>
  void set(std::size_t at, const RotationSample& q) const {
    for (int j = 0; j < 4; ++j) {
      const std::size_t i = at + static_cast<std::size_t>(j);
      value[i] = q.value[j];
      if constexpr (!kDerivatives) continue;
      first[i] = q.first[j];
      second[i] = q.second[j];
    }
  }
};

/// A track between keys k and k + 1.
template <bool kDerivatives>
class Interval {
 public:
  Interval(const Track& track, std::size_t k, double time, const SampleNumbers& out)
      : track_{track},
        k_{k},
        d_{track.times[k + 1] - track.times[k]},
        u_{(time - track.times[k]) / d_},
        out_{out} {}

  void numbers(const TrackPart& part) const {
    const std::size_t begin = static_cast<std::size_t>(part.first);
    const std::size_t end = begin + static_cast<std::size_t>(part.count);
    if (track_.interpolation == Interpolation::Linear) {
      const double* left = key_value(track_, k_);
      const double* right = key_value(track_, k_ + 1);
      for (std::size_t i = begin; i < end; ++i) {
        out_.value[i] = (1 - u_) * left[i] + u_ * right[i];
        if constexpr (kDerivatives) out_.first[i] = (right[i] - left[i]) / d_;
      }
      return;
    }
    const HermiteWeights weights{u_, d_};
    for (std::size_t i = begin; i < end; ++i) {
      const Vector4 controls = this->controls(static_cast<int>(i));
      out_.value[i] = weights.value.dot(controls);
      if constexpr (!kDerivatives) continue;
      out_.first[i] = weights.first.dot(controls);
      out_.second[i] = weights.second.dot(controls);
    }
  }

  /// `arc` is that from key k, of a linear track.
  void rotation(const TrackPart& part, const Arc& arc) const {
    const std::size_t first = static_cast<std::size_t>(part.first);
    if (track_.interpolation == Interpolation::Linear)
      return out_.set<kDerivatives>(first, slerp<kDerivatives>(arc, u_, d_));
    const HermiteWeights weights{u_, d_};
    RotationSample p;
    for (int j = 0; j < 4; ++j) {
      const Vector4 controls = this->controls(part.first + j);
      p.value[j] = weights.value.dot(controls);
      p.first[j] = weights.first.dot(controls);
      p.second[j] = weights.second.dot(controls);
    }
    const double* left = key_value(track_, k_) + part.first;
    const double* right = key_value(track_, k_ + 1) + part.first;
    const double scale = Eigen::Map<const Vector4>{left}.norm() + Eigen::Map<const Vector4>{right}.norm();
    const bool is_rotation = p.value.norm() > 1e-9 * scale;
    out_.set<kDerivatives>(first, is_rotation ? normalised(p)
                                              : RotationSample{unit_key(u_ < 0.5 ? left : right),
                                                               Vector4::Zero(), Vector4::Zero()});
  }

 private:
  /// v_k, b_k, v_{k+1}, a_{k+1} of number j.
  [[nodiscard]] Vector4 controls(int j) const {
    const double* left = key_value(track_, k_);
    const double* right = key_value(track_, k_ + 1);
    return {left[j], left[j + track_.width], right[j], right[j - track_.width]};
  }

  const Track& track_;
  std::size_t k_;
  double d_;
  double u_;
  SampleNumbers out_;
};

/// Number of keys at or before (side After) or before (side Before) a time, looked for around the cursor
/// first.
std::size_t keys_before(const std::vector<double>& times, double time, KeySide side, KeyCursor& cursor) {
  const auto is_passed = [&](std::size_t k) {
    return side == KeySide::After ? times[k] <= time : times[k] < time;
  };
  std::size_t right = cursor;
  for (int tries = 0; tries < 2 && right <= times.size(); ++tries, ++right) {
    if ((right == 0 || is_passed(right - 1)) && (right == times.size() || !is_passed(right))) {
      cursor = static_cast<KeyCursor>(right);
      return right;
    }
  }
  const auto beyond = side == KeySide::After ? std::upper_bound(times.begin(), times.end(), time)
                                             : std::lower_bound(times.begin(), times.end(), time);
  right = static_cast<std::size_t>(beyond - times.begin());
  cursor = static_cast<KeyCursor>(right);
  return right;
}

/// The same, after moving a time onto the key that it is meant to hit.
std::size_t locate(const std::vector<double>& times, SamplePoint& at, KeyCursor& cursor) {
  const std::size_t right = keys_before(times, at.time, at.side, cursor);
  const bool hits_left = right > 0 && at.time - times[right - 1] <= at.slack;
  const bool hits_right = right < times.size() && times[right] - at.time <= at.slack;
  if (!hits_left && !hits_right) return right;
  const std::size_t key = hits_left ? right - 1 : right;
  at.time = times[key];
  return at.side == KeySide::After ? key + 1 : key;
}

/// `arc_of(k, first)` gives the arc from key k for the rotation that begins at number `first`.
template <bool kDerivatives, class ArcOf>
void sample_at(const Track& track, SamplePoint at, KeyCursor& cursor, const ArcOf& arc_of,
               const SampleNumbers& out) {
  const std::size_t right = locate(track.times, at, cursor);
  const std::size_t left = right == 0 ? 0 : right - 1;
  const bool is_held =
      right == 0 || right == track.times.size() || track.interpolation == Interpolation::Step;
  if (is_held) {
    for (const TrackPart& part : parts_of(track)) {
      if (part.is_rotation) {
        Eigen::Map<Vector4>{out.value + part.first} = arc_of(left, part.first).from;
      } else {
        const double* key = key_value(track, left) + part.first;
        std::copy(key, key + part.count, out.value + part.first);
      }
    }
    return;
  }
  const Interval<kDerivatives> interval{track, left, at.time, out};
  for (const TrackPart& part : parts_of(track)) {
    if (part.is_rotation) interval.rotation(part, arc_of(left, part.first));
    else interval.numbers(part);
  }
}

}  // namespace

std::span<const TrackPart> parts_of(int width) noexcept {
  static constexpr TrackPart kNumbers[] = {{0, 1, false}};
  static constexpr TrackPart kVector[] = {{0, 3, false}};
  static constexpr TrackPart kRotation[] = {{0, 4, true}};
  static constexpr TrackPart kPose[] = {{0, 3, false}, {3, 4, true}};
  switch (width) {
    case 1:
      return kNumbers;
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
  TrackSample out;
  KeyCursor cursor = 0;
  sample_at<true>(track, {time, side, 0}, cursor,
                  [&](std::size_t k, int first) { return arc_from(track, k, first); },
                  {out.value.data(), out.first.data(), out.second.data()});
  return out;
}

TrackSample sample(const PreparedTrack& prepared, const SamplePoint& at, KeyCursor& cursor) {
  TrackSample out;
  sample_at<true>(*prepared.track, at, cursor,
                  [&](std::size_t k, int) -> const Arc& { return prepared.arcs[k]; },
                  {out.value.data(), out.first.data(), out.second.data()});
  return out;
}

void sample_values(const PreparedTrack& prepared, const SamplePoint& at, KeyCursor& cursor,
                   std::array<double, 7>& values) {
  sample_at<false>(*prepared.track, at, cursor,
                   [&](std::size_t k, int) -> const Arc& { return prepared.arcs[k]; },
                   {values.data(), nullptr, nullptr});
}

PreparedClip::PreparedClip(std::shared_ptr<const Clip> given) : clip{std::move(given)} {
  tracks.reserve(clip->tracks.size());
  for (const Track& track : clip->tracks) {
    tracks.push_back({.track = &track});
    for (const TrackPart& part : parts_of(track)) {
      if (!part.is_rotation) continue;
      for (std::size_t k = 0; k < track.times.size(); ++k)
        tracks.back().arcs.push_back(arc_from(track, k, part.first));
    }
  }
}

}  // namespace pantin
