// Several plays on one node: layers, weights, cross-fades, additive plays, masks.
#include <gtest/gtest.h>

#include <support/blends.hpp>
#include <support/expect_contract.hpp>

namespace pantin {
namespace {

using test::clip;
using test::expect_derivatives;
using test::OneNode;
using test::random_clip;
using test::stands_at;
using test::track;
using test::turned_by;
using Matrix3x4 = Eigen::Matrix<double, 3, 4>;

TEST(Layers, TheUpperOneCoversTheLowerByItsWeight) {
  // x = (1 - w) below + w x, layer by layer from the rest pose at 8, by hand.
  OneNode it;
  it.scene.set_local(it.node, Affine{Eigen::Translation3d{8, 0, 0}});
  it.play(stands_at(4), {.weight = 0.5, .layer = 1});  // 6 over the rest
  EXPECT_DOUBLE_EQ(it.x(), 6);
  it.play(stands_at(0), {.weight = 0.25, .layer = 7});  // 4.5 above that
  EXPECT_DOUBLE_EQ(it.x(), 4.5);
  it.play(stands_at(100), {.layer = -3});  // 52 and 39 above it
  EXPECT_DOUBLE_EQ(it.x(), 39);
}

TEST(Layers, PlaysOfOneLayerShareItByWeight) {
  // Weights that add up to 1 or more are proportions; below 1 the rest shows through.
  OneNode it;
  it.scene.set_local(it.node, Affine{Eigen::Translation3d{8, 0, 0}});
  const PlayId a = it.play(stands_at(1), {.weight = 1});
  it.play(stands_at(5), {.weight = 1});
  EXPECT_DOUBLE_EQ(it.x(), 3);
  it.player.set_weight(a, 0.0);
  EXPECT_DOUBLE_EQ(it.x(), 5);
  it.player.set_weight(a, 0.25);
  EXPECT_DOUBLE_EQ(it.x(), (1 * 0.25 + 5) / 1.25);
  OneNode half;
  half.scene.set_local(half.node, Affine{Eigen::Translation3d{8, 0, 0}});
  half.play(stands_at(1), {.weight = 0.25});
  half.play(stands_at(5), {.weight = 0.5});
  EXPECT_DOUBLE_EQ(half.x(), 8 * 0.25 + 1 * 0.25 + 5 * 0.5);
}

TEST(Layers, OrderOfPlayingDoesNotMatterWithinALayer) {
  // The mean of the layer is symmetric; rotations are compared as matrices, to round-off of sums in another
  // order.
  std::mt19937_64 random{80};
  const Clip clips[] = {random_clip(random), random_clip(random), random_clip(random)};
  OneNode ab, ba;
  for (const int k : {0, 1, 2}) ab.play(clips[k], {.weight = 0.2 + 0.1 * k});
  for (const int k : {2, 0, 1}) ba.play(clips[k], {.weight = 0.2 + 0.1 * k});
  for (const double t : {0.1, 0.5, 0.9})
    EXPECT_LT((ab.player.motion(ab.node, t).value - ba.player.motion(ba.node, t).value).norm(), 1e-14);
}

TEST(Layers, RotationsTakeTheShorterWay) {
  // Two turns about one axis, half each: the mean angle, across the half turn too.
  OneNode it;
  it.play(turned_by(0.4), {.weight = 0.5});
  it.play(turned_by(1.0), {.weight = 0.5});
  EXPECT_NEAR(it.angle(), 0.7, 1e-15);
  OneNode across;
  across.play(turned_by(3.0), {.weight = 0.5});
  across.play(turned_by(-3.0), {.weight = 0.5});
  EXPECT_NEAR(std::abs(across.angle()), 3.14159265358979, 1e-13);
}

TEST(Layers, OppositeRotationsHaveNoMeanButAValue) {
  // Half a turn apart and half each, the quaternions still have a mean; negated ones would cancel. Whatever
  // is given must be a rotation.
  OneNode it;
  it.play(turned_by(0), {.weight = 0.5});
  it.play(turned_by(3.14159265358979323846), {.weight = 0.5});
  const Matrix3 R = it.player.motion(it.node, 0).value.leftCols<3>();
  EXPECT_LT((R * R.transpose() - Matrix3::Identity()).norm(), 1e-14);
}

TEST(Blend, HasExactDerivatives) {
  // Smooth clips under smooth weights, mixed within a layer, covered by another and added to: first and
  // second derivatives of motion against differences of its values.
  std::mt19937_64 random{81};
  for (int k = 0; k < 40; ++k) {
    OneNode it;
    const auto weight = [&](double least) {
      return fade({.begin = -1,
                   .duration = 3,
                   .from = test::uniform(random, least, 0.5),
                   .to = test::uniform(random, least, 0.5)});
    };
    it.play(random_clip(random), {.weight = weight(0), .channels = {.rotation = 0.5}});
    it.play(random_clip(random), {.offset = 0.5, .speed = -0.5, .weight = weight(0)});
    it.play(random_clip(random), {.speed = 0.8, .weight = weight(0), .layer = 1});
    it.play(random_clip(random), {.weight = weight(-0.5), .blend = Blend::Additive, .layer = k % 2});
    const double t = test::uniform(random, 0.1, 0.9);
    if (it.player.next_break(it.node, t - 0.04) < t + 0.04) continue;  // another way round: not smooth here
    expect_derivatives(it.player, it.node, t);
  }
}

TEST(Blend, OfLinkValuesHasExactDerivatives) {
  // A ball's quaternions are blended on the sphere, numbers of other links as numbers.
  std::mt19937_64 random{82};
  for (const LinkKind kind : {LinkKind::Pivot, LinkKind::Slider, LinkKind::Ball, LinkKind::Cylindrical,
                              LinkKind::Universal, LinkKind::Planar, LinkKind::Screw, LinkKind::Free})
    for (int k = 0; k < 10; ++k) {
      OneNode it;
      Link link{.kind = kind};
      link.M_PJ = test::random_affine(random);
      link.value = zero_value(kind);
      it.scene.set_link(it.node, link);
      const int width = value_size(kind);
      const auto link_clip = [&] {
        return clip({test::random_cubic(Channel::LinkValue, width, width > 3, random)}, 1);
      };
      it.play(link_clip(), {.weight = fade({.begin = 0, .duration = 1, .from = 1, .to = 0.2})});
      it.play(link_clip(), {.weight = fade({.begin = 0, .duration = 1})});
      it.play(link_clip(), {.weight = 0.3, .blend = Blend::Additive});
      const double t = test::uniform(random, 0.1, 0.9);
      if (it.player.next_break(it.node, t - 0.04) < t + 0.04) continue;
      expect_derivatives(it.player, it.node, t);
      it.player.set_time(t);
      it.player.apply(it.scene);  // the value that the link notes gives the matrix that was written
      const Affine M = local_matrix(link, it.scene.link(it.node)->value);
      EXPECT_LT((it.scene.local(it.node).affine() - M.affine()).norm(), 1e-15);
    }
}

TEST(Blend, IsWrittenAsItIsSampled) {
  // apply() has the bits of motion(), though it computes no derivatives.
  std::mt19937_64 random{83};
  OneNode it;
  it.play(random_clip(random), {.weight = 0.7});
  it.play(random_clip(random), {.weight = fade({.begin = 0.2, .duration = 5})});
  it.play(random_clip(random), {.weight = 0.6, .blend = Blend::Additive});
  for (double t = 0.01; t < 3; t += 0.0937) {
    it.player.set_time(t);
    it.player.apply(it.scene);
    ASSERT_EQ(it.scene.local(it.node).affine(), it.player.motion(it.node, t).value) << "at " << t;
  }
}

TEST(CrossFade, GoesFromOneToTheOther) {
  // Before it the one, after it the other, halfway the mean; the slope of 3 u^2 - 2 u^3 at the middle is 1.5
  // over the duration, and 0 at both ends.
  OneNode it;
  const PlayId from = it.play(stands_at(2));
  const PlayId to = it.play(stands_at(6), {.weight = 0});
  it.player.cross_fade(from, to, {.begin = 1, .duration = 0.5});
  EXPECT_EQ(it.x(0.5), 2);
  EXPECT_DOUBLE_EQ(it.x(1.25), 4);
  EXPECT_EQ(it.x(1.5), 6);
  EXPECT_NEAR(it.player.motion(it.node, 1.25).first(0, 3), 4 * 1.5 / 0.5, 1e-12);
  EXPECT_EQ(it.player.motion(it.node, 1).first(0, 3), 0);
  EXPECT_NEAR(it.player.motion(it.node, 1).second(0, 3), 4 * 6 / 0.25, 1e-10);
  EXPECT_EQ(it.player.motion(it.node, 1, KeySide::Before).second(0, 3), 0);
  EXPECT_EQ(it.player.next_break(it.node, 0), 1);
  EXPECT_EQ(it.player.next_break(it.node, 1), 1.5);
}

TEST(CrossFade, LeavesNoGapWhereOnlyOneAnimates) {
  // Where only the old clip moves a node it fades out to the rest pose, where only the new one does it fades
  // in.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a"), b = scene.create(scene.root(), "b");
  Player player;
  const PlayId from = player.play(scene, stands_at(2), {a});
  const PlayId to = player.play(scene, stands_at(6), {b}, {.weight = 0});
  player.cross_fade(from, to, {.begin = 0, .duration = 1});
  EXPECT_DOUBLE_EQ(player.motion(a, 0.5).value(0, 3), 1);
  EXPECT_DOUBLE_EQ(player.motion(b, 0.5).value(0, 3), 3);
  EXPECT_EQ(player.motion(a, 1).value(0, 3), 0);
}

TEST(NextBreakOfBlend, TellsWhereTheShorterWayChangesSides) {
  // One stands, one turns by 4 rad in a second: at pi rad the mean jumps by half a turn, at t = pi / 4.
  OneNode it;
  std::vector<double> numbers;
  for (int k = 0; k <= 4; ++k)
    for (const double number : {std::cos(k / 2.0), 0.0, 0.0, std::sin(k / 2.0)}) numbers.push_back(number);
  it.play(clip({track(Channel::Rotation, Interpolation::Linear, {0, 0.25, 0.5, 0.75, 1}, numbers)}, 1),
          {.weight = 0.5});
  it.play(turned_by(0), {.weight = 0.5});
  const double half_turn = 3.14159265358979323846 / 4;
  const double found = it.player.next_break(it.node, 0.76);
  EXPECT_NEAR(found, half_turn, 1e-12);
  const Matrix3x4 before = it.player.motion(it.node, found, KeySide::Before).value;
  const Matrix3x4 after = it.player.motion(it.node, found, KeySide::After).value;
  EXPECT_NEAR(std::atan2(before(1, 0), before(0, 0)), half_turn * 2, 1e-9);
  EXPECT_NEAR(std::atan2(after(1, 0), after(0, 0)), -half_turn * 2, 1e-9);
}

TEST(Plays, ComeAndGo) {
  // Ids are never used again; a node is animated as long as something plays on it; its rest pose is that of
  // the first play.
  OneNode it;
  const PlayId a = it.play(stands_at(2));
  const PlayId b = it.play(stands_at(6), {.weight = 0.5, .layer = -1});
  EXPECT_EQ(it.player.plays(), (std::vector<PlayId>{a, b}));
  EXPECT_EQ(it.player.plays_of(it.node), (std::vector<PlayId>{b, a}));  // from the lowest layer up
  EXPECT_EQ(it.player.clip(b).name, "walk");
  it.player.stop(a);
  EXPECT_FALSE(it.player.is_playing(a));
  EXPECT_EQ(it.x(), 3);
  it.player.stop(it.node);
  EXPECT_FALSE(it.player.animates(it.node));
  EXPECT_FALSE(it.player.is_playing(b));
  EXPECT_GT(it.play(stands_at(1)), b);
  it.scene.remove(it.node);
  it.player.stop_removed(it.scene);
  EXPECT_TRUE(it.player.plays().empty());
  test::expect_contract([&] { it.player.stop(a); }, "play 1 is null or was stopped");
}

TEST(Players, ShareASceneAndAClip) {
  // Two players with one clip on two nodes write what each says, at their own times.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a"), b = scene.create(scene.root(), "b");
  const SharedClip shared{
      clip({track(Channel::Translation, Interpolation::Linear, {0, 2}, {0, 0, 0, 4, 0, 0})}, 2)};
  Player first{scene, shared, {a}}, second{scene, shared, {b}};
  first.set_time(0.5);
  second.set_time(1.5);
  first.apply(scene);
  second.apply(scene);
  EXPECT_EQ(scene.local(a).translation().x(), 1);
  EXPECT_EQ(scene.local(b).translation().x(), 3);
}

}  // namespace
}  // namespace pantin
