#pragma once
// Private to scenegraph. A clip with what sampling needs again and again computed once. Many players share
// one.
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <pantin/scenegraph/clip.hpp>

namespace pantin {

/// A turn at constant speed from one unit quaternion to another: q(f) = cos(f) from + sin(f) across, f from 0
/// to `angle`. `across` is orthogonal to `from` and of length 1, or 0 if there is no turn.
struct Arc {
  Eigen::Vector4d from{Eigen::Vector4d::Zero()};
  Eigen::Vector4d across{Eigen::Vector4d::Zero()};
  double angle{0};  ///< [rad], between the quaternions as 4-vectors: half the angle of the rotation
};

struct PreparedTrack {
  const Track* track{nullptr};
  std::vector<Arc> arcs{};  ///< from each key to the next; empty if the track has no rotation
};

struct PreparedClip {
  /// The clip must have no problem.
  explicit PreparedClip(std::shared_ptr<const Clip> given);

  std::shared_ptr<const Clip> clip;
  std::vector<PreparedTrack> tracks{};  ///< as in the clip
};

/// A place in a track: the key that begins the interval, counted from 1 so that 0 is before the first.
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
