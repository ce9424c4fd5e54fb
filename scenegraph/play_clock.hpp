#pragma once
// Private to scenegraph. From play time to clip time and back.
#include <pantin/scenegraph/player.hpp>

namespace pantin {

/// Where a clip stands at some play time.
struct ClockReading {
  double clip_time{0};           ///< [s], within 0 .. duration
  KeySide side{KeySide::After};  ///< which limit to take at a key there
  double position{0};            ///< [s], clip_time before it was clamped (Once)
  double lap_begin{
      0};           ///< [s], what position + lap_begin counts from: 0 at `offset` (Once), laps of the clip
  double slack{0};  ///< [s], round-off of clip_time: keys so near are meant exactly
};

class PlayClock {
 public:
  PlayClock(const PlayerSettings& settings, double duration) : settings_{settings}, duration_{duration} {}

  /// A play time computed by `play_time` reads back as exactly the clip time it was computed from, at ends
  /// and seams.
  [[nodiscard]] ClockReading read(double play_time, KeySide side) const;
  /// Play time at which position + lap_begin has the given value; speed is not 0.
  [[nodiscard]] double play_time(double unwrapped) const;

  [[nodiscard]] double speed() const noexcept { return settings_.speed; }
  /// Whether the clip starts over at its ends.
  [[nodiscard]] bool wraps() const noexcept { return settings_.loop == Loop::Repeat && duration_ > 0; }
  [[nodiscard]] double duration() const noexcept { return duration_; }
  [[nodiscard]] const PlayerSettings& settings() const noexcept { return settings_; }

 private:
  PlayerSettings settings_;
  double duration_;
};

}  // namespace pantin
