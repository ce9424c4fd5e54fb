// Scene -> Physics: pose and velocity at the instant of hand-over, what of a subtree is bound, and which
// matrices are refused.
#include <gtest/gtest.h>

#include "support/meshes.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::box_mass;
using test::moved;
using test::says;
using test::scaled;
using test::Stage;
using test::turned;

TEST(HandOver, TakesTheExactVelocityOfTheClipAlongAtTheCentreOfGravity) {
  // At the instant of hand-over the body has the derivative of the clip, exact and not differenced: compared
  // with the clip's own sample. Followed or not bound before makes no difference.
  for (const bool followed : {false, true}) {
    Stage s;
    const NodeId id = box(s, s.scene.root(), "a", Affine::Identity(), 2, {0.4, -0.1, 0.2});
    ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
    if (followed) {
      ASSERT_TRUE(s.bridge.follow(id).empty());
    }
    static_cast<void>(s.bridge.advance_until(0.7));
    const Affine M = s.scene.world(id);
    ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
    const Player player{s.scene, test::swinging_clip(), {id}};
    const LocalMotion m = player.motion(id, 0.7);
    const Matrix3 W = m.first.leftCols<3>() * m.value.leftCols<3>().transpose();
    const Vector3 w{W(2, 1), W(0, 2), W(1, 0)};
    const RigidBody body = s.physics.body(s.bridge.body_of(id));
    EXPECT_LT((body.w_WB() - w).norm(), 1e-13);
    EXPECT_LT((body.v_WBcm() - (m.first.col(3) + w.cross(body.R_WB() * Vector3{0.4, -0.1, 0.2}))).norm(),
              1e-13);
    EXPECT_LT(test::relative_difference(test::by_body(s, id), M), 1e-15);
    EXPECT_EQ(s.scene.world(id).matrix(), M.matrix());
  }
}

TEST(HandOver, HasTheVelocityAfterAClipThatBeginsNow) {
  // Before its beginning a clip did not move the node; a hand-over at that very time takes what the clip sets
  // out with.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  EXPECT_LT((s.physics.body(s.bridge.body_of(id)).v_WB() - Vector3{0.5, 1, 0}).norm(), 1e-14);
}

TEST(HandOver, HasTheVelocityBeforeAJump) {
  // Linear keys jump in velocity at 1 s, from +2 to -3 m/s: handed over there, the node goes on with +2.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  Track track{.target = 0,
              .channel = Channel::Translation,
              .times = {0, 1, 2},
              .values = {0, 0, 0, 2, 0, 0, -1, 0, 0}};
  ASSERT_TRUE(s.bridge.play({.name = "zigzag", .duration = 2, .tracks = {track}}, {id}).empty());
  static_cast<void>(s.bridge.advance_until(1.0));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  EXPECT_LT((s.physics.body(s.bridge.body_of(id)).v_WB() - Vector3{2, 0, 0}).norm(), 1e-14);
}

TEST(HandOver, ThrowsWhatTheUserHasMoved) {
  // A node that was dragged 0.1 m in 0.05 s and is let go flies on at 2 m/s.
  Stage s{0.01};
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  ASSERT_TRUE(s.bridge.follow(id).empty());
  s.bridge.set_local(id, moved({0.1, 0, 0}));
  static_cast<void>(s.bridge.advance(0.05));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_LT((s.scene.world(id).translation() - Vector3{1.1, 0, 0}).norm(), 1e-12);
}

TEST(HandOver, InheritsTheVelocityOfASimulatedAncestor) {
  // A node that rode on a spinning body leaves it with the velocity of its place there: v + w x r.
  Stage s;
  const NodeId carrier = box(s, s.scene.root(), "carrier", Affine::Identity());
  const NodeId rider = box(s, carrier, "rider", moved({2, 0, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(carrier)));
  s.physics.set_velocity(s.bridge.body_of(carrier), {1, 0, 0}, {0, 0, 3});
  const Vector3 origin_v = s.physics.body(s.bridge.body_of(carrier)).v_WB();
  ASSERT_FALSE(has_error(s.bridge.hand_over(rider)));
  const RigidBody body = s.physics.body(s.bridge.body_of(rider));
  EXPECT_LT((body.v_WB() - (origin_v + Vector3{0, 6, 0})).norm(), 1e-14);
  EXPECT_LT((body.w_WB() - Vector3{0, 0, 3}).norm(), 1e-14);
}

TEST(HandOver, RefusesSingularMatricesByPath) {
  // A node that is scaled to nothing along an axis has no pose.
  Stage s;
  const NodeId flat = s.scene.create(s.scene.root(), "flat", scaled({1, 0, 1}));
  const NodeId id = box(s, flat, "a", Affine::Identity());
  EXPECT_TRUE(says(s.bridge.hand_over(id), "flat/a", "its world matrix is singular"));
  EXPECT_TRUE(says(s.bridge.follow(id), "flat/a", "its world matrix is singular"));
}

TEST(HandOver, RefusesANodeThatIsBeingStretched) {
  // A rigid body cannot go on with a scale that changes; once the clip holds still it can be handed over.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "balloon", Affine::Identity());
  Track track{.target = 0, .channel = Channel::Scale, .times = {0, 1}, .values = {1, 1, 1, 2, 2, 2}};
  const Clip clip{.name = "inflate", .duration = 1, .tracks = {track}};
  ASSERT_TRUE(s.bridge.play(clip, {id}, {.loop = Loop::Once}).empty());
  static_cast<void>(s.bridge.advance_until(0.5));
  EXPECT_TRUE(says(s.bridge.hand_over(id), "balloon", "its scale or shear changes at this instant"));
  static_cast<void>(s.bridge.advance_until(1.5));
  EXPECT_FALSE(has_error(s.bridge.hand_over(id)));
  EXPECT_LT((s.bridge.residual(id).linear() - 2 * Matrix3::Identity()).norm(), 1e-14);
}

TEST(HandOver, RebakesTheMassOfAnAnimatedBodyThatIsStretched) {
  // While it is animated its residual follows the clip, and its inertia is that of the scaled box, mass kept.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "balloon", Affine::Identity(), 2);
  Track track{.target = 0, .channel = Channel::Scale, .times = {0, 1}, .values = {1, 1, 1, 2, 1, 3}};
  ASSERT_TRUE(s.bridge.play({.name = "inflate", .duration = 1, .tracks = {track}}, {id}, {.loop = Loop::Once})
                  .empty());
  ASSERT_TRUE(s.bridge.follow(id).empty());
  static_cast<void>(s.bridge.advance_until(1.0));
  EXPECT_LT((s.bridge.residual(id).linear() - Matrix3{Vector3(2, 1, 3).asDiagonal()}).norm(), 1e-13);
  const MassProperties want = box_mass(2, {0.6, 0.2, 1.2});
  EXPECT_LT((s.physics.body(s.bridge.body_of(id)).I_BBcm_B() - want.I_BBcm_B).norm(), 1e-12);
}

TEST(HandOver, OfASubtreeBindsWhatHasMassOrMoves) {
  // Mass, or a link that moves: a body. Massless with a Fixed link or none: follows rigidly, matrix
  // untouched.
  Stage s;
  const NodeId top = box(s, s.scene.root(), "top", Affine::Identity());
  const NodeId frame = s.scene.create(top, "frame", moved({0, 0, 1}));
  s.scene.set_link(frame, Link{.kind = LinkKind::Fixed, .M_PJ = moved({0, 0, 1})});
  const NodeId plain = s.scene.create(top, "plain");
  const NodeId arm = box(s, plain, "arm", Affine::Identity());
  s.scene.set_link(arm, test::pivot_link("p", Affine::Identity(), {0, 0, 1}));
  const NodeId loose = box(s, frame, "loose", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.hand_over(top, Scope::Subtree)));
  EXPECT_EQ(s.bridge.bound().size(), 3U);
  EXPECT_EQ(s.bridge.bound().front(), top);
  EXPECT_FALSE(s.bridge.drive_of(frame).has_value() || s.bridge.drive_of(plain).has_value());
  EXPECT_FALSE(s.bridge.joint_of(loose));
  ASSERT_TRUE(s.bridge.joint_of(arm));
  EXPECT_EQ(s.physics.joint(s.bridge.joint_of(arm)).a, s.bridge.body_of(top));
}

TEST(HandOver, OfTheSceneRootTakesEachTopNode) {
  // Everything below the root, each top node by itself; one that only places others is left out.
  Stage s;
  const NodeId group = s.scene.create(s.scene.root(), "group", turned(1, {1, 0, 0}));
  const NodeId a = box(s, group, "a", Affine::Identity());
  const NodeId b = box(s, s.scene.root(), "b", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.hand_over(s.scene.root(), Scope::Subtree)));
  EXPECT_EQ(s.bridge.bound(), (std::vector<NodeId>{a, b}));
}

TEST(HandOver, OfAGroupWithoutMassesMakesOneBodyOfItsGeometry) {
  // A model of meshes alone is one rigid body.
  Stage s;
  const NodeId group = s.scene.create(s.scene.root(), "group");
  for (const double x : {-1.0, 1.0}) {
    const NodeId part = s.scene.create(group, "part", moved({x, 0, 0}));
    s.bridge.set_node_body(
        part,
        {.meshes = {{"m", std::make_shared<TriangleMesh>(test::box_mesh({1, 1, 1})), Affine::Identity()}}});
  }
  ASSERT_FALSE(has_error(s.bridge.hand_over(group, Scope::Subtree)));
  EXPECT_EQ(s.bridge.bound(), std::vector<NodeId>{group});
  EXPECT_NEAR(s.physics.body(s.bridge.body_of(group)).mass(), 2000, 1e-9);
}

TEST(HandOver, RefusesSettingsOutOfRange) {
  // Densities are checked before anything else, as a diagnostic.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "a", Affine::Identity());
  for (const double density : {0.0, -1.0, std::nan(""), double{INFINITY}}) {
    EXPECT_TRUE(says(s.bridge.hand_over(id, Scope::Node, {.density = density}), "a", "density is"));
  }
}

}  // namespace
}  // namespace pantin
