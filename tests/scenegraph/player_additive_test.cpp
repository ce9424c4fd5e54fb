// Additive plays, and plays of a part of what a clip has: masks and channel weights.
#include <gtest/gtest.h>

#include <support/blends.hpp>

namespace pantin {
namespace {

using test::clip;
using test::OneNode;
using test::random_clip;
using test::stands_at;
using test::track;
using test::turned_by;

TEST(Additive, AddsTheDifferenceFromItsReference) {
  // x: 3 + 0.5 (7 - 4). Angle: 0.2 + 2 (0.5 - 0.3), exact at any weight. Scale: 2 (1 + 0.5 (3 / 1.5 - 1)).
  const auto both = [](double first, double second) {
    return track(Channel::Translation, Interpolation::Linear, {0, 1}, {first, 0, 0, second, 0, 0});
  };
  OneNode it;
  it.play(stands_at(3));
  it.play(clip({both(4, 10)}, 1), {.offset = 0.5, .speed = 0, .weight = 0.5, .blend = Blend::Additive});
  EXPECT_DOUBLE_EQ(it.x(), 3 + 0.5 * 3);
  OneNode turn;
  turn.play(turned_by(0.2));
  const double c0 = std::cos(0.15), s0 = std::sin(0.15), c1 = std::cos(0.25), s1 = std::sin(0.25);
  const Clip turns =
      clip({track(Channel::Rotation, Interpolation::Linear, {0, 1}, {c0, 0, 0, s0, c1, 0, 0, s1})}, 1);
  turn.play(turns, {.offset = 1, .speed = 0, .loop = Loop::Once, .weight = 2, .blend = Blend::Additive});
  EXPECT_NEAR(turn.angle(), 0.2 + 2 * 0.2, 1e-15);
  OneNode grown;
  grown.scene.set_local(grown.node, Affine{Eigen::Scaling(2.0)});
  const Clip grows =
      clip({track(Channel::Scale, Interpolation::Linear, {0, 1}, {1.5, 1.5, 1.5, 3, 3, 3})}, 1);
  grown.play(grows, {.offset = 1, .speed = 0, .loop = Loop::Once, .weight = 0.5, .blend = Blend::Additive});
  EXPECT_DOUBLE_EQ(grown.player.motion(grown.node, 0).value(0, 0), 2 * 1.5);
}

TEST(Additive, IsNothingAtItsReferenceAndExactAtFullWeight) {
  // r^-1 b at w = 1 on a base of r is b; at the reference time nothing is added at all.
  std::mt19937_64 random{84};
  const Clip moving = random_clip(random);
  OneNode it;
  it.play(moving, {.offset = 0.3, .speed = 0});
  it.play(moving, {.blend = Blend::Additive, .reference = 0.3});
  const Player alone{it.scene, moving, {it.node}};
  for (const double t : {0.0, 0.3, 0.8})
    EXPECT_LT((it.player.motion(it.node, t).value - alone.motion(it.node, t).value).norm(), 1e-13);
}

TEST(Mask, TakesSubtreesByTheNearestEntry) {
  // Everything below the spine but the arm; the hand again by half; nothing outside.
  Scene scene;
  const NodeId hips = scene.create(scene.root(), "hips"), spine = scene.create(hips, "spine");
  const NodeId arm = scene.create(spine, "arm"), hand = scene.create(arm, "hand");
  const std::vector<NodeId> nodes{hips, spine, arm, hand};
  Clip all = stands_at(4);
  for (std::uint32_t k = 1; k < 4; ++k) all.tracks.push_back(all.tracks[0]), all.tracks[k].target = k;
  Player player;
  const PlayId id = player.play(scene, all, nodes, {.mask = {{spine, 1}, {hand, 0.5}, {arm, 0}}});
  EXPECT_EQ(player.nodes(), (std::vector<NodeId>{spine, hand}));
  EXPECT_EQ(player.nodes_of(id), player.nodes());
  EXPECT_EQ(player.motion(spine, 0).value(0, 3), 4);
  EXPECT_EQ(player.motion(hand, 0).value(0, 3), 2);
  EXPECT_FALSE(player.animates(arm));
  EXPECT_FALSE(player.animates(hips));
}

TEST(ChannelWeights, WeighEachChannelByItself) {
  // A quarter of the way, half the turn, nothing of the scale.
  OneNode it;
  Clip both = stands_at(4);
  both.tracks.push_back(turned_by(1).tracks[0]);
  both.tracks.push_back(track(Channel::Scale, Interpolation::Step, {0}, {5, 5, 5}));
  it.play(both, {.channels = {.translation = 0.25, .rotation = 0.5, .scale = 0}});
  EXPECT_DOUBLE_EQ(it.x(), 1);
  EXPECT_NEAR(it.angle(), 0.5, 1e-15);
  EXPECT_NEAR(it.player.motion(it.node, 0).value.col(2).norm(), 1, 1e-15);
}

}  // namespace
}  // namespace pantin
