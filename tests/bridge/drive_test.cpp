// The table of drives, cell by cell: who writes a node, what goes from the scene to physics, and what comes
// back.
#include <pantin/bridge/drive.hpp>

#include <gtest/gtest.h>

#include "support/contracts.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::moved;
using test::Stage;
using test::turned;

TEST(Drive, HasTheNamesOfTextAndJson) {
  // These words are the interface of the command line and of written files.
  EXPECT_EQ(to_string(Drive::Static), "static");
  EXPECT_EQ(to_string(Drive::Scene), "animated");
  EXPECT_EQ(to_string(Drive::Physics), "simulated");
}

TEST(Drive, StaticTakesThePoseAtBindingAndNothingLater) {
  // The body stands where the node stood, whatever moves above it; only a teleport moves both.
  Stage s;
  const NodeId parent = s.scene.create(s.scene.root(), "parent", moved({1, 0, 0}));
  const NodeId id = box(s, parent, "wall", turned(0.3, {0, 0, 1}));
  ASSERT_TRUE(s.bridge.fix(id).empty());
  EXPECT_EQ(s.bridge.drive_of(id), Drive::Static);
  s.scene.set_local(parent, moved({5, 0, 0}));
  static_cast<void>(s.bridge.advance(0.1));
  EXPECT_EQ(s.physics.body(s.bridge.body_of(id)).X_WB().p, (Vector3{1, 0, 0}));
  EXPECT_EQ(s.physics.body(s.bridge.body_of(id)).kind(), BodyKind::Static);
  ASSERT_FALSE(has_error(s.bridge.teleport(id, moved({7, 0, 0}) * turned(0.3, {0, 0, 1}))));
  EXPECT_LT((s.physics.body(s.bridge.body_of(id)).X_WB().p - Vector3{7, 0, 0}).norm(), 1e-15);
  EXPECT_LT((s.scene.world(id).translation() - Vector3{7, 0, 0}).norm(), 1e-15);
}

TEST(Drive, StaticIsNeverWrittenByPlayersOrSolver) {
  // A clip that animates a fixed node does not move it, and gravity neither.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "wall", moved({1, 2, 3}));
  s.physics.forces().add(Gravity{});
  ASSERT_TRUE(s.bridge.fix(id).empty());
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  const std::vector<Affine> before = test::locals(s.scene);
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_TRUE(test::same_bits(before, test::locals(s.scene)));
}

TEST(Drive, SceneGivesPhysicsTheExactMotionOfTheClip) {
  // Pose and velocity of the body are those of the clip at physics time: cubic keys with exact derivatives,
  // compared with the player's own, which are tested against differences elsewhere.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "arm", Affine::Identity(), 2, {0.1, 0.2, 0.3});
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  ASSERT_TRUE(s.bridge.follow(id).empty());
  const Player player{s.scene, test::swinging_clip(), {id}};
  for (int k = 0; k < 50; ++k) {
    static_cast<void>(s.bridge.advance(0.03));
    const double t = s.bridge.time();
    const LocalMotion M = player.motion(id, t, KeySide::Before);
    const RigidBody body = s.physics.body(s.bridge.body_of(id));
    EXPECT_LT((body.X_WB().p - Vector3{M.value.col(3)}).norm(), 1e-14);
    EXPECT_LT((body.R_WB() - M.value.leftCols<3>()).norm(), 1e-14);
    EXPECT_LT((body.v_WB() - Vector3{M.first.col(3)}).norm(), 1e-12);
    const Matrix3 R1 = M.first.leftCols<3>();
    const Matrix3 W = R1 * M.value.leftCols<3>().transpose();
    EXPECT_LT((body.w_WB() - Vector3{W(2, 1), W(0, 2), W(1, 0)}).norm(), 1e-12);
    const Vector3 v_cm = body.v_WB() + body.w_WB().cross(body.R_WB() * body.p_BBcm());
    EXPECT_LT((body.v_WBcm() - v_cm).norm(), 1e-13);
  }
}

TEST(Drive, SceneFollowsTheUserWithTheVelocityOfTheDifference) {
  // A followed node that the user moves by 0.1 m between two frames of 0.05 s travels at 2 m/s during that
  // frame, and stands in the next one. Turning by 0.2 rad about z gives 4 rad/s.
  Stage s{0.01};
  const NodeId parent = s.scene.create(s.scene.root(), "hand");
  const NodeId id = box(s, parent, "tool", Affine::Identity());
  ASSERT_TRUE(s.bridge.follow(id).empty());
  static_cast<void>(s.bridge.advance(0.05));
  s.bridge.set_local(parent, moved({0.1, 0, 0}) * turned(0.2, {0, 0, 1}));
  EXPECT_EQ(s.physics.body(s.bridge.body_of(id)).X_WB().p, Vector3::Zero());
  static_cast<void>(s.bridge.advance(0.05));
  const RigidBody body = s.physics.body(s.bridge.body_of(id));
  EXPECT_LT((body.X_WB().p - Vector3{0.1, 0, 0}).norm(), 1e-15);
  EXPECT_LT((body.v_WB() - Vector3{2, 0, 0}).norm(), 1e-13);
  EXPECT_LT((body.w_WB() - Vector3{0, 0, 4}).norm(), 1e-13);
  static_cast<void>(s.bridge.advance(0.05));
  EXPECT_EQ(s.physics.body(s.bridge.body_of(id)).v_WB(), Vector3::Zero());
}

TEST(Drive, SceneNoticesMovesMadeOnTheSceneItself) {
  // The user may write a followed node, or what is above it, through the scene: it is the same motion.
  Stage s{0.01};
  const NodeId id = box(s, s.scene.root(), "tool", Affine::Identity());
  ASSERT_TRUE(s.bridge.follow(id).empty());
  s.scene.set_local(id, moved({0, 0.2, 0}));
  static_cast<void>(s.bridge.advance(0.1));
  EXPECT_LT((s.physics.body(s.bridge.body_of(id)).v_WB() - Vector3{0, 2, 0}).norm(), 1e-13);
  EXPECT_EQ(s.scene.local(id).translation(), (Vector3{0, 0.2, 0}));
}

TEST(Drive, SceneIsNeverWrittenFromPhysics) {
  // A followed node that the user placed keeps its local matrix bit for bit, whatever its body was given.
  Stage s;
  const Affine M = moved({1.1, 2.2, 3.3}) * turned(0.7, {1, 2, 3});
  const NodeId id = box(s, s.scene.root(), "tool", M);
  s.physics.forces().add(Gravity{});
  ASSERT_TRUE(s.bridge.follow(id).empty());
  s.physics.apply_force(s.bridge.body_of(id), {100, 0, 0});
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_EQ(s.scene.local(id).matrix(), M.matrix());
}

TEST(Drive, PhysicsWritesTheNodeFromTheBody) {
  // Free fall: z = -g t^2 / 2 at the node, also below a parent that is scaled and turned.
  Stage s{0.01};
  const NodeId parent = s.scene.create(s.scene.root(), "p",
                                       moved({3, 1, 2}) * turned(1, {1, 1, 0}) * test::scaled({2, 0.5, 3}));
  const NodeId id = box(s, parent, "ball", moved({0.1, 0.2, 0.3}));
  const Affine before = s.scene.world(id);
  s.physics.forces().add(Gravity{.g_W = {0, 0, -10}});
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  EXPECT_EQ(s.bridge.drive_of(id), Drive::Physics);
  static_cast<void>(s.bridge.advance(0.5));
  const Affine want = moved({0, 0, -1.25}) * before;
  EXPECT_LT(test::relative_difference(s.scene.world(id), want), 1e-14);
  EXPECT_EQ(s.scene.local(parent).matrix(),
            (moved({3, 1, 2}) * turned(1, {1, 1, 0}) * test::scaled({2, 0.5, 3})).matrix());
}

TEST(Drive, PhysicsIsNeverReadFromTheNode) {
  // Writing the matrix of a simulated node is a broken contract that names the verb to use; what players say
  // is skipped.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "ball", moved({1, 2, 3}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {id}).empty());
  const std::vector<Affine> before = test::locals(s.scene);
  static_cast<void>(s.bridge.advance(0.25));
  EXPECT_TRUE(test::same_bits(before, test::locals(s.scene)));
  const test::ThrowOnContract guard;
  try {
    s.bridge.set_local(id, moved({0, 0, 0}));
    FAIL();
  } catch (const test::ContractError& error) {
    EXPECT_NE(std::string{error.what()}.find("node 'ball' is simulated"), std::string::npos);
    EXPECT_NE(std::string{error.what()}.find("teleport"), std::string::npos);
  }
}

TEST(Drive, PhysicsIsWrittenParentsFirstWithFreshMatrices) {
  // A fast parent and its child, both free: after each frame the child's world matrix is its own body's, not
  // one that was divided by where the parent was a frame ago.
  Stage s{0.01};
  const NodeId parent = box(s, s.scene.root(), "parent", Affine::Identity());
  const NodeId between = s.scene.create(parent, "between", turned(0.5, {1, 0, 0}));
  const NodeId child = box(s, between, "child", moved({1, 0, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(parent, Scope::Subtree)));
  s.physics.set_velocity(s.bridge.body_of(parent), {100, 50, 0}, {30, 20, 10});
  const Affine start = s.scene.world(child);
  for (int k = 0; k < 20; ++k) {
    static_cast<void>(s.bridge.advance(0.05));
    EXPECT_LT(test::relative_difference(s.scene.world(parent), test::by_body(s, parent)), 1e-14);
    EXPECT_LT((s.scene.world(child).affine() - start.affine()).norm(), 1e-12);  // nothing touches it
  }
}

}  // namespace
}  // namespace pantin
