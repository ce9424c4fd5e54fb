#pragma once
// Private to scenegraph. How the numbers of a track are laid out.
#include <span>

#include <pantin/scenegraph/clip.hpp>

namespace pantin {

/// Numbers of a value that are interpolated together: a quaternion, or numbers each for itself.
struct TrackPart {
  int first{0};
  int count{0};
  bool is_rotation{false};
};

/// The parts of a value of so many numbers, in order.
[[nodiscard]] std::span<const TrackPart> parts_of(int width) noexcept;
[[nodiscard]] inline std::span<const TrackPart> parts_of(const Track& track) noexcept {
  return parts_of(track.width);
}

/// How many numbers are stored for each key.
[[nodiscard]] inline std::size_t values_per_key(const Track& track) noexcept {
  const std::size_t width = static_cast<std::size_t>(track.width);
  return track.interpolation == Interpolation::CubicSpline ? 3 * width : width;
}

/// The value of key k; for CubicSpline the in-tangent is `width` numbers before it, the out-tangent as many
/// after.
[[nodiscard]] inline const double* key_value(const Track& track, std::size_t k) noexcept {
  const std::size_t in_tangent =
      track.interpolation == Interpolation::CubicSpline ? std::size_t(track.width) : 0;
  return track.values.data() + k * values_per_key(track) + in_tangent;
}

}  // namespace pantin
