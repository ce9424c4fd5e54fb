#include <cmath>

#include <pantin/scenegraph/root_extraction.hpp>

namespace pantin {

void sample_channel(const PreparedTrack& track, const ClockReading& at, KeyCursor& cursor,
                    std::array<double, 7>& value) {
  sample_values(track, at.point(), cursor, value);
}

// x(s(t)): x' = x_s s',  x'' = x_ss s'^2 + x_s s''.
void sample_channel(const PreparedTrack& track, const ClockReading& at, KeyCursor& cursor,
                    std::array<Jet, 7>& value) {
  const TrackSample s = sample(track, at.point(), cursor);
  for (std::size_t i = 0; i < value.size(); ++i)
    value[i] = {s.value[i], s.first[i] * at.rate,
                s.second[i] * (at.rate * at.rate) + s.first[i] * at.rate_change};
}

RootExtraction::RootExtraction(const RootMotion& settings, const PreparedTrack& translation,
                               const PreparedTrack* rotation, double duration)
    : along_{settings.along}, axis_{settings.turn_about}, translation_{&translation}, rotation_{rotation} {
  from_start_ = extracted(sampled<double>({.clip_time = 0})).inverse();
  lap_ = within_lap(sampled<double>({.clip_time = duration, .side = KeySide::Before}));
}

template <class S>
Rigid<S> RootExtraction::sampled(const ClockReading& at) const {
  Rigid<S> pose;
  std::array<S, 7> numbers{};
  KeyCursor cursor = 0;
  sample_channel(*translation_, at, cursor, numbers);
  for (std::size_t i = 0; i < 3; ++i) pose.p[i] = numbers[i];
  if (rotation_ == nullptr) return pose;
  sample_channel(*rotation_, at, cursor, numbers);
  for (std::size_t i = 0; i < 4; ++i) pose.q[i] = numbers[i];
  return pose;
}

template Rigid<double> RootExtraction::sampled<double>(const ClockReading&) const;
template Rigid<Jet> RootExtraction::sampled<Jet>(const ClockReading&) const;

// By halving n, so that a late lap costs no more than an early one.
Rigid<double> RootExtraction::laps(double n) const {
  Rigid<double> power = n < 0 ? lap_.inverse() : lap_;
  Rigid<double> out;
  for (double left = std::abs(n); left >= 1; left = std::floor(left / 2)) {
    if (std::fmod(left, 2) == 1) out = out * power;
    power = power * power;
    power.q = unit(power.q);
  }
  return out;
}

}  // namespace pantin
