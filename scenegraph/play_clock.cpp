// s = offset + speed (t - begin); Once clamps s to the clip, Repeat takes it modulo the duration. A time that
// somebody got from next_break and stepped onto must read as that key and no bit less, or a step would show
// its old value. So positions within the round-off of s count as exactly at an end, and `slack` says how near
// a key counts as hit.
#include <cmath>
#include <limits>

#include <pantin/scenegraph/play_clock.hpp>

namespace pantin {

double PlayClock::play_time(double unwrapped) const {
  return settings_.begin + (unwrapped - settings_.offset) / settings_.speed;
}

ClockReading PlayClock::read(double play_time, KeySide side) const {
  const double speed = settings_.speed;
  const double s = settings_.offset + speed * (play_time - settings_.begin);
  ClockReading at;
  at.slack =
      8 * std::numeric_limits<double>::epsilon() *
      (settings_.offset + std::abs(speed) * (std::abs(play_time) + std::abs(settings_.begin)) + duration_);
  // Backwards, what comes after in play time comes before in the clip; standing still, there is only one
  // value.
  at.side = side;
  if (speed == 0) at.side = KeySide::After;
  if (speed < 0) at.side = side == KeySide::After ? KeySide::Before : KeySide::After;

  if (wraps()) {
    const double boundary = std::round(s / duration_);
    const bool at_seam = std::abs(s - boundary * duration_) <= at.slack;
    const double lap = at_seam ? boundary - (at.side == KeySide::Before ? 1 : 0) : std::floor(s / duration_);
    at.lap_begin = lap * duration_;
    at.position = at_seam ? (at.side == KeySide::Before ? duration_ : 0) : s - at.lap_begin;
    at.clip_time = at.position;
    return at;
  }
  at.position = s;
  if (std::abs(s) <= at.slack) at.position = 0;
  if (std::abs(s - duration_) <= at.slack) at.position = duration_;
  at.clip_time = at.position;
  if (at.position < 0) at.clip_time = 0, at.side = KeySide::Before;
  if (at.position > duration_) at.clip_time = duration_, at.side = KeySide::After;
  return at;
}

}  // namespace pantin
