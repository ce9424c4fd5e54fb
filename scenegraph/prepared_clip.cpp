#include <algorithm>
#include <cmath>

#include <pantin/scenegraph/prepared_clip.hpp>
#include <pantin/scenegraph/track_parts.hpp>

namespace pantin {
namespace {

using Vector4 = Eigen::Vector4d;

Vector4 unit_key(const Track& track, std::size_t k, int first) {
  return Eigen::Map<const Vector4>{key_value(track, k) + first}.stableNormalized();
}

/// From a key's quaternion to the next one's; the last key's own. The angle and the direction are taken from
/// the difference of the two, which keeps them accurate for nearly equal keys.
void fill_arc(const Track& track, std::size_t k, int first, double* arc) {
  Eigen::Map<Vector4> from{arc}, across{arc + 4};
  from = unit_key(track, k, first);
  across.setZero();
  arc[8] = 0;
  if (k + 1 == track.times.size() || track.interpolation != Interpolation::Linear) return;
  Vector4 to = unit_key(track, k + 1, first);
  if (from.dot(to) < 0) to = -to;
  const Vector4 chord = to - from;
  arc[8] = 2 * std::atan2(chord.norm(), (to + from).norm());
  const Vector4 direction = chord + (chord.squaredNorm() / 2) * from;  // 1 - cos(angle) = |chord|^2 / 2
  if (direction.norm() > 0) across = direction.normalized();
}

}  // namespace

std::span<const TrackPart> parts_of(int width) noexcept {
  static constexpr TrackPart kNumber[] = {{0, 1, false}};
  static constexpr TrackPart kTwo[] = {{0, 2, false}};
  static constexpr TrackPart kVector[] = {{0, 3, false}};
  static constexpr TrackPart kRotation[] = {{0, 4, true}};
  static constexpr TrackPart kPose[] = {{0, 3, false}, {3, 4, true}};
  switch (width) {
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

std::size_t row_size(const Track& track) noexcept {
  const bool is_cubic = track.interpolation == Interpolation::CubicSpline;
  std::size_t size = 1;
  for (const TrackPart& part : parts_of(track)) {
    const std::size_t count = static_cast<std::size_t>(part.count);
    size += part.is_rotation ? (is_cubic ? 3 * count + 4 : 9) : (is_cubic ? 3 * count : count);
  }
  return size;
}

void fill_row(const Track& track, std::size_t k, double* row) {
  *row++ = track.times[k];
  const double* value = key_value(track, k);
  for (const TrackPart& part : parts_of(track)) {
    if (track.interpolation == Interpolation::CubicSpline) {
      for (int j = part.first; j < part.first + part.count; ++j) {
        *row++ = value[j - track.width];
        *row++ = value[j];
        *row++ = value[j + track.width];
      }
      if (!part.is_rotation) continue;
      Eigen::Map<Vector4>{row} = unit_key(track, k, part.first);
      row += 4;
    } else if (part.is_rotation) {
      fill_arc(track, k, part.first, row);
      row += 9;
    } else {
      row = std::copy(value + part.first, value + part.first + part.count, row);
    }
  }
}

PreparedTrack::PreparedTrack(const Track& given) : track{&given}, stride{row_size(given)} {
  rows.resize(stride * given.times.size());
  for (std::size_t k = 0; k < given.times.size(); ++k) fill_row(given, k, rows.data() + k * stride);
}

}  // namespace pantin
