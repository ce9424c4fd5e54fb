#pragma once
// Private to scenegraph. From play time to clip time and back.
#include <pantin/scenegraph/player_settings.hpp>
#include <pantin/scenegraph/prepared_clip.hpp>

namespace pantin {

/// Where a clip stands at some play time.
struct ClockReading {
  double clip_time{0};           ///< [s], within 0 .. duration
  KeySide side{KeySide::After};  ///< which limit to take at a key there
  double position{0};            ///< [s], clip_time before it was clamped (Once)
  double lap{0};                 ///< how often the clip was played through, a whole number; 0 for Once
  double slack{0};               ///< [s], round-off of clip_time: keys so near are meant exactly
  double unwrapped{0};           ///< [s], clip time as if the clip went on for ever in both directions
  double rate{0};                ///< clip seconds per play second
  double rate_change{0};         ///< the rate's derivative with respect to play time [1/s]

  [[nodiscard]] SamplePoint point() const noexcept { return {clip_time, side, slack}; }
};

class PlayClock {
 public:
  PlayClock(const PlayerSettings& settings, double duration);

  /// A play time computed by `play_time` reads back as exactly the clip time it was computed from, at ends
  /// and seams.
  [[nodiscard]] ClockReading read(double play_time, KeySide side) const;
  /// First play time at which lap * duration + position has the given value; infinite if there is none. Speed
  /// is not 0.
  [[nodiscard]] double play_time(double unwrapped) const;
  /// The first play time > `time` at which the warp may break.
  [[nodiscard]] double next_warp_break(double time) const;

  [[nodiscard]] double speed() const noexcept { return speed_; }
  /// Whether the clip starts over at its ends.
  [[nodiscard]] bool wraps() const noexcept { return wraps_; }
  [[nodiscard]] double duration() const noexcept { return duration_; }

 private:
  double begin_, offset_, speed_, duration_;
  bool wraps_;
  std::optional<Curve> warp_;
};

}  // namespace pantin
