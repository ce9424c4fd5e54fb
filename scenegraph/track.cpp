#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <pantin/scenegraph/clip.hpp>
#include <pantin/scenegraph/track_parts.hpp>

namespace pantin {
namespace {

std::string problem_with_width(const Track& track) {
  const int width = track.width;
  const std::string has = "and must not be " + std::to_string(width);
  switch (track.channel) {
    case Channel::Translation:
      return width == 3 ? "" : "a translation has width 3 " + has;
    case Channel::Rotation:
      return width == 4 ? "" : "a rotation has width 4 " + has;
    case Channel::Scale:
      return width == 3 ? "" : "a scale has width 3 " + has;
    case Channel::LinkValue:
      return (width >= 1 && width <= 4) || width == 7 ? "" : "a link value has width 1, 2, 3, 4 or 7 " + has;
  }
  return "unknown channel";
}

std::string problem_with_times(const std::vector<double>& times) {
  if (times.empty()) return "it has no keys";
  const auto key = [&](std::size_t k) {
    return "key " + std::to_string(k) + " at " + std::to_string(times[k]) + " s ";
  };
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (!std::isfinite(times[k])) return key(k) + "is not finite";
    if (times[k] < 0) return key(k) + "is before 0";
    if (k > 0 && !(times[k - 1] < times[k])) return key(k) + "is not after the key before it";
  }
  return {};
}

std::string problem_with_values(const Track& track) {
  const std::size_t per_key = values_per_key(track);
  const std::size_t expected = track.times.size() * per_key;
  if (track.values.size() != expected)
    return std::to_string(track.times.size()) + " keys need " + std::to_string(expected) + " numbers, not " +
           std::to_string(track.values.size());
  const auto bad =
      std::find_if_not(track.values.begin(), track.values.end(), [](double x) { return std::isfinite(x); });
  if (bad != track.values.end()) {
    const std::size_t key = static_cast<std::size_t>(bad - track.values.begin()) / per_key;
    return "a number of key " + std::to_string(key) + " is not finite";
  }
  for (const TrackPart& part : parts_of(track)) {
    if (!part.is_rotation) continue;
    for (std::size_t k = 0; k < track.times.size(); ++k)
      if (!(Eigen::Map<const Eigen::Vector4d>{key_value(track, k) + part.first}.stableNorm() > 0))
        return "the quaternion of key " + std::to_string(k) + " has length 0; the identity is 1, 0, 0, 0";
  }
  return {};
}

}  // namespace

std::string problem_with(const Track& track) {
  if (std::string text = problem_with_width(track); !text.empty()) return text;
  if (std::string text = problem_with_times(track.times); !text.empty()) return text;
  return problem_with_values(track);
}

double next_break(const Track& track, double time) {
  if (track.times.size() < 2) return std::numeric_limits<double>::infinity();
  const auto key = std::upper_bound(track.times.begin(), track.times.end(), time);
  return key == track.times.end() ? std::numeric_limits<double>::infinity() : *key;
}

}  // namespace pantin
