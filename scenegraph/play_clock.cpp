// s = offset + speed (warp(t) - begin); Once clamps s to the clip, Repeat takes it modulo the duration. A
// time that somebody got from next_break and stepped onto must read as that key and no bit less, or a step
// would show its old value. So positions within the round-off of s count as exactly at an end, and `slack`
// says how near a key counts as hit.
#include <cmath>
#include <limits>

#include <pantin/scenegraph/play_clock.hpp>

namespace pantin {

PlayClock::PlayClock(const PlayerSettings& settings, double duration)
    : begin_{settings.begin},
      offset_{settings.offset},
      speed_{settings.speed},
      duration_{duration},
      wraps_{settings.loop == Loop::Repeat && duration > 0},
      warp_{settings.warp} {}

double PlayClock::play_time(double unwrapped) const {
  const double warped = begin_ + (unwrapped - offset_) / speed_;
  return warp_ ? time_of(*warp_, warped) : warped;
}

double PlayClock::next_warp_break(double time) const {
  if (!warp_) return std::numeric_limits<double>::infinity();
  // A warp of one key may still bend there.
  const std::vector<double>& times = warp_->keys().times;
  if (times.size() == 1) return times[0] > time ? times[0] : std::numeric_limits<double>::infinity();
  return next_break(*warp_, time);
}

ClockReading PlayClock::read(double play_time, KeySide side) const {
  const CurveSample warped = warp_ ? sample_warp(*warp_, play_time, side) : CurveSample{play_time, 1, 0};
  const double s = offset_ + speed_ * (warped.value - begin_);
  const double round_off = 8 * std::numeric_limits<double>::epsilon();
  ClockReading at;
  at.unwrapped = s;
  at.rate = speed_ * warped.first;
  at.rate_change = speed_ * warped.second;
  at.slack =
      round_off * (offset_ + std::abs(speed_) * (std::abs(warped.value) + std::abs(begin_)) + duration_);
  if (warp_) at.slack += round_off * std::abs(at.rate * play_time);
  // Backwards, what comes after in play time comes before in the clip; standing still, there is only one
  // value.
  at.side = side;
  if (speed_ == 0) at.side = KeySide::After;
  if (speed_ < 0) at.side = side == KeySide::After ? KeySide::Before : KeySide::After;

  if (wraps_) {
    const double boundary = std::round(s / duration_);
    const bool at_seam = std::abs(s - boundary * duration_) <= at.slack;
    at.lap = at_seam ? boundary - (at.side == KeySide::Before ? 1 : 0) : std::floor(s / duration_);
    at.position = at_seam ? (at.side == KeySide::Before ? duration_ : 0) : s - at.lap * duration_;
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
