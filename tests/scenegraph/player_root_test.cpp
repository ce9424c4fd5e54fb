// Root motion: what is taken out of the hips moves the character.
#include <gtest/gtest.h>

#include <support/blends.hpp>
#include <support/expect_contract.hpp>

namespace pantin {
namespace {

using test::clip;
using test::track;

/// Character / (armature) / hips; hips walk, turn and bob within two seconds.
struct Walker {
  Scene scene{};
  NodeId character = scene.create(scene.root(), "character", Affine{Eigen::Translation3d{1, 2, 3}});
  NodeId armature = scene.create(character, "armature", Affine{Eigen::AngleAxisd{0.7, Vector3::UnitX()}});
  NodeId hips = scene.create(armature, "hips");
  Player player{};

  static Clip walk(double pace = 1) {
    return clip({track(Channel::Translation, Interpolation::CubicSpline, {0, 2},
                       {0, 0, 0, 0.1, 1, 0.2, pace, 0.3, 0.1, 0, 0.2, -pace, 2 * pace, 1, 0.5, 0, 0, 0}),
                 track(Channel::Rotation, Interpolation::CubicSpline, {0, 2},
                       {0, 0, 0, 0, 1, 0.1, 0, 0, 0, 0, 0, 0.2, 0, 0, 0, 0, 0.9, 0.1, 0, 0.4, 0, 0, 0, 0.1})},
                2);
  }
  [[nodiscard]] PlayerSettings with_root(PlayerSettings settings = {}) const {
    settings.root = RootMotion{
        .source = hips, .carrier = character, .along = {true, false, true}, .turn_about = Vector3::UnitZ()};
    return settings;
  }
  [[nodiscard]] Affine hips_now() {
    player.apply(scene);
    return scene.world(hips);
  }
};

double difference(const Affine& a, const Affine& b) { return (a.affine() - b.affine()).norm(); }

TEST(RootMotion, ChangesNothingOfTheWorldWithinALap) {
  // The product over character, armature and hips is what it is without root motion: D is only moved up.
  Walker moved, plain;
  moved.player.play(moved.scene, Walker::walk(), {moved.hips}, moved.with_root());
  plain.player.play(plain.scene, Walker::walk(), {plain.hips});
  for (int k = 0; k < 19; ++k) {
    EXPECT_LT(difference(moved.hips_now(), plain.hips_now()), 1e-13) << k;
    moved.player.advance(0.1);
    plain.player.advance(0.1);
  }
  EXPECT_GT(difference(moved.scene.local(moved.character), plain.scene.local(plain.character)), 1);
}

TEST(RootMotion, IsRemovedFromThePose) {
  // Only what is not extracted is left in the hips: no way along x and z of the parent beyond the start's,
  // and no twist about z beyond the start's.
  Walker it;
  it.player.play(it.scene, Walker::walk(), {it.hips}, it.with_root());
  const Eigen::Matrix<double, 3, 4> start = it.player.motion(it.hips, 0).value;
  const Eigen::Matrix<double, 3, 4> later = it.player.motion(it.hips, 1.3).value;
  // The turn is taken out about the parent's origin, so the bob, along y, is turned back with it.
  const auto twist = [](const Eigen::Matrix<double, 3, 4>& M) {
    const Quaternion q{Matrix3{M.leftCols<3>()}};
    return std::atan2(q.z(), q.w());
  };
  EXPECT_NEAR(twist(later), twist(start), 1e-14);
  Walker way;
  way.player.play(
      way.scene, Walker::walk(), {way.hips},
      {.root = RootMotion{.source = way.hips, .carrier = way.armature, .along = {true, false, true}}});
  const Eigen::Matrix<double, 3, 4> a = way.player.motion(way.hips, 0).value;
  const Eigen::Matrix<double, 3, 4> b = way.player.motion(way.hips, 1.3).value;
  EXPECT_NEAR(a(0, 3), b(0, 3), 1e-15);
  EXPECT_NEAR(a(2, 3), b(2, 3), 1e-15);
  EXPECT_GT(std::abs(a(1, 3) - b(1, 3)), 1e-3);
}

TEST(RootMotion, GoesOnThroughLoops) {
  // Displacements compose: X(0, 9.7) = X(0, 4) X(4, 9.7); each lap adds the same; backwards undoes it.
  Walker it;
  const PlayId id = it.player.play(it.scene, Walker::walk(), {it.hips}, it.with_root());
  const auto X = [&](double from, double to) { return it.player.root_displacement(id, from, to); };
  EXPECT_LT(difference(X(0, 9.7), X(0, 4) * X(4, 9.7)), 1e-13);
  EXPECT_LT(difference(X(0, 6), X(0, 2) * X(0, 2) * X(0, 2)), 1e-13);
  EXPECT_LT(difference(X(0.5, 2.5), X(100.5, 102.5)), 1e-11);
  EXPECT_LT(difference(X(3.3, -4.1) * X(-4.1, 3.3), Affine::Identity()), 1e-13);
  EXPECT_GT(X(0, 2).translation().norm(), 1);
}

TEST(RootMotion, MovesTheCarrierOnceHoweverItIsAdvanced) {
  // One advance of 7.3 s or seventy-three small ones: the same place. Applying twice moves nothing.
  Walker once, often;
  once.player.play(once.scene, Walker::walk(), {once.hips}, once.with_root({.speed = 1.2}));
  often.player.play(often.scene, Walker::walk(), {often.hips}, often.with_root({.speed = 1.2}));
  once.player.advance(7.3);
  for (int k = 0; k < 73; ++k) {
    often.player.advance(0.1);
    often.player.apply(often.scene);
    often.player.apply(often.scene);
  }
  EXPECT_LT(difference(once.hips_now(), often.hips_now()), 1e-12);
  EXPECT_LT(difference(once.scene.local(once.character), often.scene.local(often.character)), 1e-12);
}

TEST(RootMotion, HasExactDerivatives) {
  // Carrier and hips, in a later lap, backwards and under a warp too.
  for (const double speed : {1.0, -0.7}) {
    Walker it;
    it.player.play(
        it.scene, Walker::walk(), {it.hips},
        it.with_root(
            {.speed = speed, .warp = Curve{Interpolation::CubicSpline, {0, 20}, {1, 0, 0.5, 1.5, 20, 1}}}));
    it.player.advance(0.3);
    for (const double t : {0.5, 3.1, 7.7}) {
      test::expect_derivatives(it.player, it.character, t);
      test::expect_derivatives(it.player, it.hips, t);
    }
  }
}

TEST(RootMotion, OfSeveralPlaysIsTheirMean) {
  // Two walks at steady paces 1 and 3 m/s, a quarter and three quarters: 2.5 m/s. A fade between them travels
  // the integral of the pace, with an error of third order in the steps: halving them leaves an eighth a
  // step, a quarter of the whole.
  const auto steady = [](double pace) {
    return clip({track(Channel::Translation, Interpolation::Linear, {0, 1}, {0, 0, 0, pace, 0, 0})}, 1);
  };
  const auto travelled = [&](const Curve& a, const Curve& b, int steps) {
    Walker it;
    it.player.play(it.scene, steady(1), {it.hips}, [&] {
      PlayerSettings s = it.with_root({.weight = a});
      s.root->turn_about.reset();
      return s;
    }());
    it.player.play(it.scene, steady(3), {it.hips}, [&] {
      PlayerSettings s = it.with_root({.weight = b});
      s.root->turn_about.reset();
      return s;
    }());
    const double start = it.player.motion(it.character, 0).value(0, 3);
    test::expect_derivatives(it.player, it.character, 0.4);
    for (int k = 0; k < steps; ++k) it.player.advance_to(2.0 * (k + 1) / steps);
    return it.player.motion(it.character, 2).value(0, 3) - start;
  };
  EXPECT_NEAR(travelled(0.25, 0.75, 7), 5, 1e-13);
  // The weight of the faster is 3 u^2 - 2 u^3 of t / 4 up to t = 2: integral of 1 + 2 w = 2 + 8 (u^3 - u^4 /
  // 2).
  const auto error = [&](int steps) {
    const double whole = 2 + 8 * (0.125 - 0.03125);
    return travelled(fade({.begin = 0, .duration = 4, .from = 1, .to = 0}), fade({.begin = 0, .duration = 4}),
                     steps) -
           whole;
  };
  EXPECT_NEAR(error(20) / error(40), 4, 0.1);
  EXPECT_LT(std::abs(error(160)), 1e-4);
}

TEST(RootMotion, StaysWhereItIsThroughSeeksAndStops) {
  // A seek moves no carrier; placing it puts it elsewhere, from where it goes on; after the play it stays.
  Walker it;
  const PlayId id = it.player.play(it.scene, Walker::walk(), {it.hips}, it.with_root());
  it.player.advance(3);
  it.player.apply(it.scene);
  const Affine before = it.scene.local(it.character);
  it.player.set_time(0.2);
  it.player.apply(it.scene);
  EXPECT_LT(difference(it.scene.local(it.character), before), 1e-13);
  const Affine elsewhere{Eigen::Translation3d{-5, 0, 0}};
  it.player.place(it.character, elsewhere);
  EXPECT_LT((it.player.motion(it.character, 0.2).value - elsewhere.affine()).norm(), 1e-14);
  it.player.stop(id);
  EXPECT_FALSE(it.player.animates(it.character));
}

TEST(ProblemWithRootMotion, NamesEachFault) {
  // What source, carrier and clip must be to each other.
  Walker it;
  const auto problem = [&](const RootMotion& root, const Clip& given = Walker::walk()) {
    return problem_with(it.player, it.scene, given, {it.hips, it.armature}, {.root = root});
  };
  const RootMotion good{.source = it.hips, .carrier = it.character};
  EXPECT_EQ(problem(good), "");
  RootMotion bad = good;
  bad.carrier = NodeId{};
  EXPECT_EQ(problem(bad), "root motion: source and carrier must be nodes of the scene");
  bad = {.source = it.character, .carrier = it.hips};
  EXPECT_EQ(problem(bad), "root motion: node 'character/armature/hips' is not above node 'character'");
  bad = {.source = it.armature, .carrier = it.character};
  EXPECT_EQ(problem(bad),
            "root motion: the clip does not animate the translation of node 'character/armature'");
  bad = good;
  bad.turn_about = Vector3{0, 0, 2};
  EXPECT_EQ(problem(bad), "the axis of root motion has length 2.000000, not 1");
  bad.turn_about = Vector3::UnitZ();
  Clip way = Walker::walk();
  way.tracks.pop_back();
  EXPECT_EQ(problem(bad, way),
            "root motion: the clip does not animate the rotation of node 'character/armature/hips'");
  way.tracks.push_back(way.tracks[0]);
  way.tracks[1].target = 1;
  EXPECT_EQ(
      problem(good, way),
      "root motion: the clip animates node 'character/armature', which lies between source and carrier");
  EXPECT_EQ(problem({.source = it.hips, .carrier = it.armature}, way),
            "root motion: the clip animates the carrier, node 'character/armature', too");
  EXPECT_EQ(problem_with(PlayerSettings{.blend = Blend::Additive, .root = good}, way),
            "an Additive play has no root motion; play it as Override");
  Affine flat = Affine::Identity();
  flat(2, 2) = 0;
  it.scene.set_local(it.armature, flat);
  EXPECT_EQ(problem(good), "root motion: the local matrix of node 'character/armature' is singular");
  it.scene.set_local(it.armature, Affine::Identity());
  it.player.play(it.scene, Walker::walk(), {it.hips}, {.root = good});
  EXPECT_EQ(problem_with(it.player, it.scene, Walker::walk(), {it.character}, {}),
            "node 'character' is moved by the root motion of another play");
  Walker other;
  other.player.play(other.scene, Walker::walk(), {other.character});
  EXPECT_EQ(problem_with(other.player, other.scene, Walker::walk(), {other.hips},
                         {.root = RootMotion{.source = other.hips, .carrier = other.character}}),
            "root motion: another play animates the carrier, node 'character'");
  test::expect_contract([&] { it.player.place(it.hips, Affine::Identity()); }, "carries no root motion");
}

}  // namespace
}  // namespace pantin
