#pragma once
// Keyframe animation as data: tracks of keys over time, and their value with first and second derivative at
// any time. A clip knows no scene: its targets are small numbers that a Player maps to nodes.
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <pantin/scenegraph/affine.hpp>

namespace pantin {

enum class Channel { Translation, Rotation, Scale, LinkValue };
enum class Interpolation { Step, Linear, CubicSpline };  ///< as glTF 2.0, appendix C, in double precision

/// Which of two one-sided limits is meant at a time where a curve breaks.
enum class KeySide { Before, After };

/// Keys of one channel of one target. Values per key: Translation 3 [m], Rotation 4 (w, x, y, z), Scale 3,
/// LinkValue as many as the link has: 1, 4 (a quaternion) or 7 (a translation and a quaternion). CubicSpline
/// stores in-tangent, value, out-tangent for each key.
struct Track {
  std::uint32_t target{0};
  Channel channel{Channel::Translation};
  Interpolation interpolation{Interpolation::Linear};
  int width{3};                  ///< numbers per value, 1..7
  std::vector<double> times{};   ///< [s], >= 0, strictly increasing, at least one
  std::vector<double> values{};  ///< times.size() * width numbers, three times as many for CubicSpline
};

/// Something that happens at a time of a clip: a footstep, say. Players report it when they pass it.
struct ClipEvent {
  double time{0};  ///< [s], within 0 .. the clip's duration
  std::string name{};
};

struct Clip {
  std::string name{};
  double duration{0};  ///< [s], not before the last key's time
  std::vector<Track> tracks{};
  std::vector<ClipEvent> events{};  ///< times not decreasing
};

/// What is wrong with a track (unsorted times, wrong count, not finite, ...); empty if nothing is. A `target`
/// may be any number. Quaternions need not be of length 1, only not of length 0.
[[nodiscard]] std::string problem_with(const Track& track);

/// Value of a track at one time with its exact time derivatives; the first `width` numbers count. Rotations
/// are unit quaternions (w, x, y, z) and their derivatives those of the normalised curve.
struct TrackSample {
  std::array<double, 7> value{};
  std::array<double, 7> first{};   ///< [1/s]
  std::array<double, 7> second{};  ///< [1/s^2]
};

/// Before the first and after the last key the value is held and the derivatives are zero. Linear rotations
/// are spherical (slerp, shorter arc: the sign of the quaternion may jump at a key, the rotation does not);
/// cubic ones are Hermite, then normalised; where they pass through 0 there is no rotation, and the nearer
/// key is given, at rest. The same holds for the quaternions of LinkValue tracks. `time` may be infinite, not
/// NaN.
[[nodiscard]] TrackSample sample(const Track& track, double time, KeySide side = KeySide::After);

/// The first time > `time` at which value, velocity or acceleration of the track may jump: its next key;
/// infinity if there is none or if the track has only one key.
[[nodiscard]] double next_break(const Track& track, double time);

}  // namespace pantin
