#include <gtest/gtest.h>

#include <limits>
#include <support/animated_scene.hpp>
#include <support/expect_contract.hpp>
#include <support/random_affine.hpp>

namespace pantin {
namespace {

using test::AnimatedScene;
using test::clip;
using test::track;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Clip sliding() {
  return clip({track(Channel::Translation, Interpolation::Linear, {0, 2}, {0, 0, 0, 4, 0, 0})}, 2);
}

Link slider() {
  Link link;
  link.kind = LinkKind::Slider;
  link.value = 0.0;
  return link;
}

TEST(Player, AppliesTheMotionOfItsTime) {
  // What is written is what motion() says for the present time, bit for bit.
  AnimatedScene it{sliding()};
  EXPECT_EQ(it.player.time(), 0);
  it.player.set_time(0.5);
  it.player.advance(0.25);
  EXPECT_EQ(it.player.time(), 0.75);
  it.player.apply(it.scene);
  EXPECT_EQ(it.scene.local(it.node).affine(), it.player.motion(it.node, 0.75).value);
  EXPECT_DOUBLE_EQ(it.scene.local(it.node).translation().x(), 1.5);
}

TEST(Player, NeverWritesHeldNodes) {
  // Held from now on, written again after release; a node it does not animate may be held as well.
  AnimatedScene it{sliding()};
  const NodeId other = it.scene.create(it.scene.root(), "other");
  it.player.hold(it.node);
  it.player.hold(other);
  EXPECT_TRUE(it.player.holds(it.node));
  EXPECT_TRUE(it.player.holds(other));
  it.player.set_time(1);
  it.player.apply(it.scene);
  EXPECT_EQ(it.scene.local(it.node).matrix(), Affine::Identity().matrix());
  it.player.release(it.node);
  EXPECT_FALSE(it.player.holds(it.node));
  it.player.apply(it.scene);
  EXPECT_EQ(it.scene.local(it.node).translation().x(), 2);
}

TEST(Player, SkipsRemovedNodes) {
  // A node may go while a clip plays on it and others.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  const NodeId b = scene.create(scene.root(), "b");
  Clip both = sliding();
  both.tracks.push_back(both.tracks[0]);
  both.tracks[1].target = 1;
  Player player{scene, both, {a, b}};
  scene.remove(a);
  player.set_time(1);
  player.apply(scene);
  EXPECT_EQ(scene.local(b).translation().x(), 2);
}

TEST(Player, KnowsItsNodes) {
  // Those with a track, in order of the tracks; null targets are not played.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  const NodeId b = scene.create(scene.root(), "b");
  Clip both = sliding();
  both.tracks.push_back(both.tracks[0]);
  both.tracks[0].target = 1;
  Player player{scene, both, {a, b}, {.speed = 3}};
  EXPECT_EQ(player.nodes(), (std::vector<NodeId>{b, a}));
  EXPECT_TRUE(player.animates(a));
  EXPECT_FALSE(player.animates(scene.root()));
  EXPECT_EQ(player.clip(player.plays()[0]).name, "walk");
  EXPECT_EQ(player.settings(player.plays()[0]).speed, 3);
  const Player half{scene, both, {NodeId{}, b}};
  EXPECT_EQ(half.nodes(), std::vector<NodeId>{b});
}

TEST(Player, KeepsWhatTheClipDoesNotAnimate) {
  // Only the translation has a track: rotation and scale, a mirror too, stay those of the node.
  std::mt19937_64 random{50};
  Affine M = Affine::Identity();
  M.linear() = test::random_rotation(random).toRotationMatrix() * Vector3{-2, 1, 0.5}.asDiagonal();
  AnimatedScene it{sliding(), {}, M};
  it.player.set_time(1);
  it.player.apply(it.scene);
  EXPECT_LT((it.scene.local(it.node).linear() - M.linear()).norm(), 1e-14);
}

TEST(Player, PlaysLinkValues) {
  // The node gets the matrix of its link at the sampled value, bit for bit, and the link notes the value.
  Scene scene;
  const NodeId node = scene.create(scene.root(), "drawer");
  Link link = slider();
  link.axis = Vector3{0.6, 0.8, 0};
  scene.set_link(node, link);
  Player player{scene, clip({track(Channel::LinkValue, Interpolation::Linear, {0, 1}, {0, 3})}, 1), {node}};
  player.set_time(0.5);
  player.apply(scene);
  EXPECT_EQ(scene.link(node)->value, LinkValue{1.5});
  EXPECT_EQ(scene.local(node).matrix(), local_matrix(link, 1.5).matrix());
  scene.clear_link(node);
  player.set_time(0.25);
  player.apply(scene);
  EXPECT_EQ(scene.local(node).matrix(), local_matrix(link, 0.75).matrix());
}

TEST(Player, MovesAsAValue) {
  // The tracks a player points to move along with it.
  AnimatedScene it{sliding()};
  Player moved = std::move(it.player);
  EXPECT_EQ(moved.motion(it.node, 1).value(0, 3), 2);
}

TEST(Player, RefusesBrokenContracts) {
  // Times that are not finite, going back by a negative step, nodes it knows nothing about.
  AnimatedScene it{sliding()};
  test::expect_contract([&] { it.player.set_time(kNaN); }, "play time nan s is not finite");
  test::expect_contract([&] { it.player.advance(-1); }, "elapsed time -1.000000 s is negative");
  test::expect_contract([&] { static_cast<void>(it.player.motion(it.scene.root(), 0)); },
                        "no clip animates node id (index 0, generation 1)");
  test::expect_contract([&] { static_cast<void>(it.player.next_break(it.scene.root(), 0)); },
                        "no clip animates");
  test::expect_contract([&] { static_cast<void>(it.player.motion(it.node, kNaN)); },
                        "play time nan s is not finite");
  test::expect_contract([&] { static_cast<void>(it.player.next_break(it.node, kNaN)); }, "is not finite");
  test::expect_contract([&] { Player(it.scene, sliding(), {}); },
                        "target 0 has no entry among the 0 nodes given");
  test::expect_contract([&] { Player(it.scene, sliding(), {it.node}, {.offset = 3}); },
                        "offset 3.000000 s is not");
}

TEST(ProblemWithPlayerSettings, NamesEachFault) {
  // Begin and speed finite, offset within the clip, its ends included.
  EXPECT_EQ(problem_with(PlayerSettings{.begin = -5, .offset = 2, .speed = -1}, sliding()), "");
  EXPECT_EQ(problem_with(PlayerSettings{.speed = kNaN}, sliding()),
            "begin and speed of a player must be finite");
  EXPECT_EQ(problem_with(PlayerSettings{.begin = kNaN}, sliding()),
            "begin and speed of a player must be finite");
  EXPECT_EQ(problem_with(PlayerSettings{.offset = -0.5}, sliding()),
            "offset -0.500000 s is not within the clip's 0 .. 2.000000 s");
}

TEST(ProblemWithPlayerSettings, NamesFaultsOfBlending) {
  // Weights within 0 .. 1 unless something is added; references within the clip; warps that do not run back.
  const Clip clip = sliding();
  EXPECT_EQ(problem_with(PlayerSettings{.weight = -3, .blend = Blend::Additive}, clip), "");
  EXPECT_EQ(problem_with(PlayerSettings{.weight = 1.5}, clip),
            "weight 1.500000 is not within 0 .. 1; only Additive may go beyond");
  EXPECT_EQ(problem_with(PlayerSettings{.channels = {.rotation = -1}}, clip),
            "channel weight -1.000000 is not within 0 .. 1; only Additive may go beyond");
  EXPECT_EQ(problem_with(PlayerSettings{.blend = Blend::Additive, .channels = {.scale = kNaN}}, clip),
            "channel weight nan is not finite");
  EXPECT_EQ(problem_with(PlayerSettings{.weight = kNaN}, clip), "weight: a number of key 0 is not finite");
  EXPECT_EQ(problem_with(PlayerSettings{.mask = {{NodeId{}, 2}}}, clip),
            "mask weight 2.000000 is not within 0 .. 1");
  EXPECT_EQ(problem_with(PlayerSettings{.reference = 5}, clip),
            "reference 5.000000 s is not within the clip's 0 .. 2.000000 s");
  EXPECT_EQ(problem_with(PlayerSettings{.warp = Curve{Interpolation::Linear, {0, 1}, {1, 0}}}, clip),
            "warp: it runs back before its first key");
}

TEST(ProblemWithPlay, NamesWhatDoesNotGoTogether) {
  // A mask of nodes that are not there, a ratio to nothing, a matrix on a node whose link another play moves.
  Scene scene;
  const NodeId node = scene.create(scene.root(), "node");
  scene.set_link(node, slider());
  Player player{scene, clip({track(Channel::LinkValue, Interpolation::Step, {0}, {1})}, 0), {node}};
  EXPECT_EQ(
      problem_with(player, scene, sliding(), {node}, {}),
      "link value and matrix of node 'node' would both be animated, by this play and another; the link's "
      "value gives the matrix");
  const Player none;
  EXPECT_EQ(problem_with(none, scene, sliding(), {node}, {.mask = {{NodeId{}, 1}}}),
            "a node of the mask is null or was removed");
  const Clip flat = clip({track(Channel::Scale, Interpolation::Step, {0}, {1, 0, 1})}, 0);
  EXPECT_EQ(problem_with(none, scene, flat, {node}, {.blend = Blend::Additive}),
            "a scale is 0 at the reference time, so nothing is a ratio to it");
  test::expect_contract([&] { player.play(scene, sliding(), {node}); }, "would both be animated");
  test::expect_contract([&] { player.set_weight(player.plays()[0], 2.0); }, "weight 2.000000 is not within");
  test::expect_contract([&] { player.cross_fade(PlayId{1}, PlayId{1}, {}); }, "play 1 cannot fade to itself");
  test::expect_contract([&] { player.advance_to(-1); },
                        "is before the present 0.000000 s; set_time goes back");
}

class ProblemWithClip : public testing::Test {
 protected:
  [[nodiscard]] std::string problem(const Clip& given) const {
    return problem_with(scene_, given, {node_, linked_});
  }

  Scene scene_{};
  NodeId node_{scene_.create(scene_.create(scene_.root(), "base"), "node")};
  NodeId linked_{scene_.create(scene_.root(), "linked")};
};

TEST_F(ProblemWithClip, IsEmptyIfItCanBePlayed) {
  // All channels of a matrix on one node, a link value on another; null targets need nothing.
  scene_.set_link(linked_, slider());
  Clip good = sliding();
  good.tracks.push_back(track(Channel::Rotation, Interpolation::Step, {0}, {1, 0, 0, 0}));
  good.tracks.push_back(track(Channel::Scale, Interpolation::Step, {0}, {1, 1, 1}));
  good.tracks.push_back(track(Channel::LinkValue, Interpolation::Step, {0}, {1}));
  good.tracks.back().target = 1;
  EXPECT_EQ(problem(good), "");
  EXPECT_EQ(problem_with(scene_, good, {NodeId{}, NodeId{}}), "");
}

TEST_F(ProblemWithClip, NamesFaultsOfTracks) {
  // A track's own problem with its place; a last key after the end; a clip that ends before it begins.
  Clip bad = sliding();
  bad.tracks[0].times[1] = 0;
  EXPECT_EQ(problem(bad), "clip 'walk', track 0: key 1 at 0.000000 s is not after the key before it");
  bad = sliding();
  bad.duration = 1;
  EXPECT_EQ(problem(bad),
            "clip 'walk', track 0: last key at 2.000000 s is after the clip's end at 1.000000 s");
  EXPECT_EQ(problem(clip({}, -1)), "clip 'walk': duration is negative");
  EXPECT_EQ(problem(clip({}, kNaN)), "clip 'walk': duration is not finite");
}

TEST_F(ProblemWithClip, NamesFaultsOfEvents) {
  // Within the clip, in order; two at once are fine.
  Clip bad = sliding();
  bad.events = {{0, "a"}, {1, "b"}, {1, "c"}, {2, "d"}};
  EXPECT_EQ(problem(bad), "");
  bad.events[3].time = 2.5;
  EXPECT_EQ(problem(bad), "clip 'walk': event 3 at 2.500000 s is not within the clip's 0 .. 2.000000 s");
  bad.events[3].time = 0.5;
  EXPECT_EQ(problem(bad), "clip 'walk': event 3 at 0.500000 s is before the event before it");
  test::expect_contract([&] { static_cast<void>(SharedClip{bad}); }, "is before the event before it");
}

TEST_F(ProblemWithClip, NamesFaultsOfTargets) {
  // No node for the target, or one that is gone.
  Clip bad = sliding();
  bad.tracks[0].target = 2;
  EXPECT_EQ(problem(bad), "clip 'walk', track 0: target 2 has no entry among the 2 nodes given");
  scene_.remove(node_);
  EXPECT_EQ(problem(sliding()), "clip 'walk', track 0: the node of target 0 was removed");
}

TEST_F(ProblemWithClip, NamesShearedNodes) {
  // A sheared local matrix is no product of translation, rotation and scale; the path tells where.
  Affine M = Affine::Identity();
  M(0, 1) = 0.5;
  scene_.set_local(node_, M);
  const std::string text = problem(sliding());
  EXPECT_EQ(text.rfind("clip 'walk', track 0: local matrix of node 'base/node' is sheared", 0), 0U) << text;
}

TEST_F(ProblemWithClip, NamesLinksThatDoNotFit) {
  // A link value needs a link, of a kind with as many numbers.
  Clip linked = clip({track(Channel::LinkValue, Interpolation::Step, {0}, {1})}, 0);
  EXPECT_EQ(problem(linked),
            "clip 'walk', track 0: node 'base/node' has no link whose value could be animated");
  Link ball;
  ball.kind = LinkKind::Ball;
  ball.value = zero_value(ball.kind);
  scene_.set_link(node_, ball);
  EXPECT_EQ(
      problem(linked),
      "clip 'walk', track 0: the ball link of node 'base/node' has a value of 4 numbers, the track of 1");
}

TEST_F(ProblemWithClip, NamesTracksThatContradict) {
  // Two tracks for one channel of a node, also by way of two targets; a link's value beside a matrix.
  Clip twice = sliding();
  twice.tracks.push_back(twice.tracks[0]);
  EXPECT_EQ(problem(twice),
            "clip 'walk', track 1: another track animates the translation of node 'base/node' too");
  twice.tracks[1].target = 1;
  EXPECT_EQ(problem(twice), "");
  EXPECT_NE(problem_with(scene_, twice, {node_, node_}), "");
  scene_.set_link(node_, slider());
  Clip both = sliding();
  both.tracks.push_back(track(Channel::LinkValue, Interpolation::Step, {0}, {1}));
  EXPECT_EQ(problem(both),
            "clip 'walk', track 1: link value and matrix of node 'base/node' are both animated; the "
            "link's value gives the matrix");
}

}  // namespace
}  // namespace pantin
