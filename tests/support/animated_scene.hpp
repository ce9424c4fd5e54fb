#pragma once
// Clips and scenes for tests of the player.
#include <string>

#include <pantin/scenegraph/player.hpp>

namespace pantin::test {

inline Track track(Channel channel, Interpolation interpolation, std::vector<double> times,
                   std::vector<double> values) {
  Track track{.channel = channel,
              .interpolation = interpolation,
              .times = std::move(times),
              .values = std::move(values)};
  const std::size_t per_key = track.values.size() / track.times.size();
  track.width = static_cast<int>(interpolation == Interpolation::CubicSpline ? per_key / 3 : per_key);
  return track;
}

inline Clip clip(std::vector<Track> tracks, double duration) {
  return {.name = "walk", .duration = duration, .tracks = std::move(tracks)};
}

/// A scene with one node, and the player of a clip with one target on it.
struct AnimatedScene {
  explicit AnimatedScene(Clip clip, PlayerSettings settings = {}, const Affine& M_PN = Affine::Identity())
      : node{scene.create(scene.root(), "node", M_PN)}, player{scene, std::move(clip), {node}, settings} {}

  [[nodiscard]] double x(double time, KeySide side = KeySide::After) const {
    return player.motion(node, time, side).value(0, 3);
  }
  [[nodiscard]] double x_rate(double time, KeySide side = KeySide::After) const {
    return player.motion(node, time, side).first(0, 3);
  }

  Scene scene{};
  NodeId node;
  Player player;
};

}  // namespace pantin::test
