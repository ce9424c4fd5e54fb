#pragma once
// Private to scenegraph. A clip with what sampling needs again and again computed once. Many players share
// one.
//
// All that a key has to say up to the next one stands in one row, so that sampling touches little memory:
//   time, then for each part of the value
//     Step, Linear   numbers: the value;  rotations: an arc: from (4), across (4), angle
//     CubicSpline    numbers: in-tangent, value, out-tangent of each;  rotations: the same, then the unit key
//     (4)
// An arc is a turn at constant speed to the next key's quaternion: q(f) = cos(f) from + sin(f) across, f from
// 0 to `angle`. `across` is orthogonal to `from` and of length 1, or 0 if there is no turn.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <pantin/scenegraph/clip.hpp>

namespace pantin {

/// How many numbers a row of this track has; at most 26.
[[nodiscard]] std::size_t row_size(const Track& track) noexcept;
/// Fills in the row of key k.
void fill_row(const Track& track, std::size_t k, double* row);

struct PreparedTrack {
  explicit PreparedTrack(const Track& given);

  [[nodiscard]] const double* row(std::size_t k) const noexcept { return rows.data() + k * stride; }

  const Track* track;
  std::size_t stride;
  std::vector<double> rows{};
};

struct PreparedClip {
  /// The clip must have no problem.
  explicit PreparedClip(Clip given) : clip{std::move(given)} {
    tracks.reserve(clip.tracks.size());
    for (const Track& track : clip.tracks) tracks.emplace_back(track);
  }
  PreparedClip(const PreparedClip&) = delete;  // the tracks point into the clip
  PreparedClip& operator=(const PreparedClip&) = delete;

  Clip clip;
  std::vector<PreparedTrack> tracks{};  ///< as in the clip
};

/// A place in a track: the number of keys passed.
using KeyCursor = std::uint32_t;

/// Where and how to sample.
struct SamplePoint {
  double time{0};  ///< [s], clip time
  KeySide side{KeySide::After};
  double slack{0};  ///< [s], a key so near is meant exactly
};

/// `sample` of a track of the clip. The cursor may be anything, and is left where the next call for a time
/// nearby will look first.
[[nodiscard]] TrackSample sample(const PreparedTrack& track, const SamplePoint& at, KeyCursor& cursor);
/// The values alone, with the same bits.
void sample_values(const PreparedTrack& track, const SamplePoint& at, KeyCursor& cursor,
                   std::array<double, 7>& values);

}  // namespace pantin
