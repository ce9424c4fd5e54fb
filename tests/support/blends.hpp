#pragma once
// Smooth clips and scenes for tests of blended players.
#include <support/animated_scene.hpp>
#include <support/finite_differences.hpp>
#include <support/random_affine.hpp>

namespace pantin::test {

/// A smooth track from 0 to 1 s with random keys; those of rotations near to each other.
inline Track random_cubic(Channel channel, int width, bool is_rotation, std::mt19937_64& random) {
  Track cubic{
      .channel = channel, .interpolation = Interpolation::CubicSpline, .width = width, .times = {0, 1}};
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < width; ++j) {
      const bool is_w = is_rotation && j == width - 4 && k % 3 == 1;
      cubic.values.push_back(uniform(random, -1, 1) + (is_w ? 2 : 0));
    }
  return cubic;
}

/// Translation, rotation and scale of one node, all smooth.
inline Clip random_clip(std::mt19937_64& random) {
  Track scale = random_cubic(Channel::Scale, 3, false, random);
  for (std::size_t i = 3; i < 6; ++i) scale.values[i] = 2, scale.values[9 + i] = 3;  // away from 0
  return clip({random_cubic(Channel::Translation, 3, false, random),
               random_cubic(Channel::Rotation, 4, true, random), scale},
              1);
}

/// Derivatives of motion() against sixth order differences of its values, h = 0.01 of curves that vary over a
/// second: truncation h^6 / 140 of a seventh derivative of some 1e4, round-off eps / h^2.
inline void expect_derivatives(const Player& player, NodeId node, double t) {
  const auto curve = [&](double time) { return player.motion(node, time).value; };
  const LocalMotion at = player.motion(node, t);
  EXPECT_LT((at.first - first_difference(curve, t, 0.01)).norm(), 1e-7 * (1 + at.first.norm())) << "at " << t;
  EXPECT_LT((at.second - second_difference(curve, t, 0.01)).norm(), 1e-6 * (1 + at.second.norm()))
      << "at " << t;
}

/// x stands at a number.
inline Clip stands_at(double x) {
  return clip({track(Channel::Translation, Interpolation::Step, {0}, {x, 0, 0})}, 1);
}
/// Turned about z by an angle.
inline Clip turned_by(double angle) {
  return clip(
      {track(Channel::Rotation, Interpolation::Step, {0}, {std::cos(angle / 2), 0, 0, std::sin(angle / 2)})},
      1);
}

struct OneNode {
  Scene scene{};
  NodeId node = scene.create(scene.root(), "node");
  Player player{};

  PlayId play(Clip given, PlayerSettings settings = {}) {
    return player.play(scene, std::move(given), {node}, std::move(settings));
  }
  [[nodiscard]] double x(double t = 0) const { return player.motion(node, t).value(0, 3); }
  /// Angle about z.
  [[nodiscard]] double angle(double t = 0) const {
    const Eigen::Matrix<double, 3, 4> M = player.motion(node, t).value;
    return std::atan2(M(1, 0), M(0, 0));
  }
};

}  // namespace pantin::test
