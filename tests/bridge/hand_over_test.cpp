// Scene -> Physics: what is bound, with which mass and velocity, joined to what, and what is refused.
#include <gtest/gtest.h>

#include <pantin/physics/constraints/ball.hpp>

#include "support/meshes.hpp"
#include "support/stage.hpp"

namespace pantin {
namespace {

using test::box;
using test::box_mass;
using test::moved;
using test::scaled;
using test::Stage;
using test::turned;

bool says(const std::vector<Diagnostic>& notes, const std::string& place, const std::string& problem) {
  for (const Diagnostic& note : notes) {
    if (note.place == place && note.problem.find(problem) != std::string::npos) return true;
  }
  return false;
}

// Pose and velocity

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

// Masses

TEST(HandOver, ListsTheMassOfUnboundNodesAndGivesItBackWithThem) {
  // The child's mass rides on the parent's body until the child gets a body, and again when it is released.
  Stage s;
  const NodeId parent = box(s, s.scene.root(), "parent", Affine::Identity(), 3);
  const NodeId child = box(s, parent, "child", moved({1, 0, 0}), 2);
  const std::vector<Diagnostic> notes = s.bridge.hand_over(parent);
  EXPECT_TRUE(says(notes, "parent", "carries 2 kg of nodes below that have no body of their own: 'child'"));
  const auto mass = [&](NodeId id) { return s.physics.body(s.bridge.body_of(id)).mass(); };
  EXPECT_DOUBLE_EQ(mass(parent), 5);
  static_cast<void>(s.bridge.hand_over(child));
  EXPECT_DOUBLE_EQ(mass(parent), 3);
  EXPECT_DOUBLE_EQ(mass(child), 2);
  s.bridge.release(child);
  EXPECT_DOUBLE_EQ(mass(parent), 5);
}

TEST(HandOver, DerivesAMassFromGeometryAndSaysSo) {
  // A cube of 1 m at 500 kg/m^3.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "crate");
  s.bridge.set_node_body(id, {.shapes = {Shape{BoxShape{{1, 1, 1}}, Pose{}}}});
  const std::vector<Diagnostic> notes = s.bridge.hand_over(id, Scope::Node, {.density = 500});
  EXPECT_TRUE(says(notes, "crate", "500 kg were derived from 1 shape(s)")) << test::text_of(notes);
  EXPECT_DOUBLE_EQ(s.physics.body(s.bridge.body_of(id)).mass(), 500);
}

TEST(HandOver, RefusesANodeWithoutMassAndGeometry) {
  // Nothing is invented: the error names the node and the two remedies, and nothing is bound.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "empty");
  const std::vector<Diagnostic> notes = s.bridge.hand_over(id);
  ASSERT_TRUE(has_error(notes));
  EXPECT_TRUE(says(notes, "empty", "it has no mass, and neither shapes nor meshes"));
  EXPECT_NE(notes[0].remedy.find("declare a mass"), std::string::npos);
  EXPECT_TRUE(s.physics.bodies().empty());
  EXPECT_TRUE(says(s.bridge.hand_over(s.scene.root()), "/", "there is nothing to simulate"));
}

TEST(HandOver, RefusesAMassWithoutInertiaOnAFreeBody) {
  // A point mass cannot turn; on a joint that holds its turning it may be sound.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "point");
  s.bridge.set_node_body(id, {.mass = MassProperties{2, Vector3::Zero(), Matrix3::Zero()}});
  EXPECT_TRUE(says(s.bridge.hand_over(id), "point", "declares a mass but no inertia"));
  EXPECT_TRUE(s.physics.bodies().empty());
  s.scene.set_link(id, test::slider_link("rail", Affine::Identity(), {1, 0, 0}));
  EXPECT_FALSE(has_error(s.bridge.hand_over(id)));
}

TEST(HandOver, KeepsAnImpossibleInertiaWithAWarning) {
  // Principal moments 1, 1, 3 belong to no body, but equations of motion take them: kept as declared, and
  // said.
  Stage s;
  const NodeId id = s.scene.create(s.scene.root(), "odd");
  s.bridge.set_node_body(id, {.mass = MassProperties{2, Vector3::Zero(), Vector3(1, 1, 3).asDiagonal()}});
  const std::vector<Diagnostic> notes = s.bridge.hand_over(id);
  ASSERT_FALSE(has_error(notes));
  EXPECT_TRUE(says(notes, "odd", "exceeds the sum of the others"));
  EXPECT_EQ(s.physics.body(s.bridge.body_of(id)).I_BBcm_B(), Matrix3{Vector3(1, 1, 3).asDiagonal()});
}

TEST(HandOver, JudgesFixedBodiesAsOneComposite) {
  // A member with a negative moment alone is refused; fixed to a body that outweighs it, the sum is sound and
  // is given to the top one: total mass and inertia are those of the sum.
  Stage s;
  const NodeId top = box(s, s.scene.root(), "top", Affine::Identity(), 10);
  const NodeId bad = s.scene.create(top, "bad", moved({0.1, 0, 0}));
  const MassProperties mass{1, Vector3::Zero(), Vector3(0.01, 0.01, -0.01).asDiagonal()};
  s.bridge.set_node_body(bad, {.mass = mass});
  EXPECT_TRUE(says(s.bridge.hand_over(bad), "top/bad", "none may be negative"));
  EXPECT_TRUE(s.physics.bodies().empty());
  Link fixed{.kind = LinkKind::Fixed, .name = "weld", .M_PJ = moved({0.1, 0, 0})};
  s.scene.set_link(bad, fixed);
  const std::vector<Diagnostic> notes = s.bridge.hand_over(top, Scope::Subtree);
  ASSERT_FALSE(has_error(notes)) << test::text_of(notes);
  EXPECT_NE(test::text_of(notes).find("the mass of all that is fixed together was given to 'top'"),
            std::string::npos);
  const MassProperties parts[] = {box_mass(10, {0.3, 0.2, 0.4}), in_frame({.p = {0.1, 0, 0}}, mass)};
  const MassProperties& got = s.physics.body(s.bridge.body_of(top)).mass_properties();
  EXPECT_DOUBLE_EQ(got.mass, 11);
  EXPECT_LT((got.I_BBcm_B - combined(parts).I_BBcm_B).norm(), 1e-14);
  EXPECT_EQ(s.physics.body(s.bridge.body_of(bad)).mass(), 0);
}

TEST(HandOver, RefusesAJointThatMovesNothingAndUndoesEverything) {
  // A massless link on a pivot with nothing behind it has no equation of motion: refused by the path of its
  // node, and everything is as before, the followed one followed.
  Stage s;
  const NodeId base = box(s, s.scene.root(), "base", Affine::Identity());
  const NodeId tip = s.scene.create(base, "tip");
  s.scene.set_link(tip, test::pivot_link("wrist", Affine::Identity(), {0, 0, 1}));
  ASSERT_TRUE(s.bridge.follow(base).empty());
  const std::vector<Affine> before = test::locals(s.scene);
  const std::vector<Diagnostic> notes = s.bridge.hand_over(base, Scope::Subtree);
  ASSERT_TRUE(has_error(notes));
  EXPECT_TRUE(says(notes, "base/tip", "joint 'wrist' moves nothing that resists")) << test::text_of(notes);
  EXPECT_EQ(s.bridge.drive_of(base), Drive::Scene);
  EXPECT_FALSE(s.bridge.drive_of(tip).has_value());
  EXPECT_TRUE(s.physics.joints().empty());
  EXPECT_EQ(s.physics.bodies().size(), 1U);
  EXPECT_TRUE(test::same_bits(before, test::locals(s.scene)));
  EXPECT_TRUE(s.bridge.advance(0.1).last.ok());
}

TEST(HandOver, TakesMasslessLinksThatCarryMass) {
  // A massless link between two masses is sound: its joint moves what is behind it.
  Stage s;
  s.physics.forces().add(Gravity{});
  const NodeId base = box(s, s.scene.root(), "base", Affine::Identity());
  const NodeId elbow = s.scene.create(base, "elbow");
  s.scene.set_link(elbow, test::pivot_link("x", Affine::Identity(), {1, 0, 0}));
  const NodeId tip = box(s, elbow, "tip", Affine::Identity());
  s.scene.set_link(tip, test::pivot_link("y", moved({0, 0, -1}), {0, 1, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(base, Scope::Subtree)));
  EXPECT_EQ(s.physics.joints().size(), 2U);
  EXPECT_TRUE(s.bridge.advance(0.1).last.ok());
}

// Matrices

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

// Scope

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

// Links

TEST(HandOver, SaysWhatOfLinksIsNotEnforced) {
  // Limits and mimic are geometry only so far: one warning each, with how many.
  Stage s;
  const NodeId top = box(s, s.scene.root(), "top", Affine::Identity());
  for (int k = 0; k < 3; ++k) {
    const NodeId id = box(s, top, "arm", Affine::Identity());
    Link link = test::pivot_link("p" + std::to_string(k), Affine::Identity(), {0, 0, 1});
    link.upper = 1;
    if (k == 2) link.mimic = LinkMimic{.source = "p0"};
    s.scene.set_link(id, link);
  }
  const std::vector<Diagnostic> notes = s.bridge.hand_over(top, Scope::Subtree);
  EXPECT_TRUE(says(notes, "top", "3 joint(s) here have limits, which are not enforced while simulated"));
  EXPECT_TRUE(says(notes, "top", "1 joint(s) here mimic another, which is not enforced while simulated"));
}

TEST(HandOver, KeepsTheValueOfALinkWithItsTurns) {
  // Zero and sign are the link's, also under a mirrored parent and beyond whole turns.
  for (const double side : {1.0, -1.0}) {
    for (const double value : {0.0, 0.3, -2.0, 7.5, -20.0}) {
      Stage s;
      const NodeId parent =
          s.scene.create(s.scene.root(), "p", turned(0.4, {1, 0, 0}) * scaled({side, 1, 1}));
      const NodeId id = box(s, parent, "arm", Affine::Identity());
      s.scene.set_link(id, test::pivot_link("j", moved({0, 1, 0}), {1, 2, 0}, value));
      ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
      EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(id)), value, 1e-14);
      s.bridge.set_link_value(id, value + 0.5);
      EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(id)), value + 0.5, 1e-14);
      const Link& link = *s.scene.link(id);
      EXPECT_NEAR(link.value[0], value + 0.5, 1e-14);
      EXPECT_LT(test::relative_difference(s.scene.local(id), local_matrix(link, link.value)), 1e-14);
    }
  }
}

TEST(HandOver, KeepsASliderInTheUnitsOfItsLink) {
  // Under a parent scaled by 3 along the axis, 0.2 units of the link are 0.6 m of the joint, both ways.
  Stage s;
  const NodeId parent = s.scene.create(s.scene.root(), "p", scaled({1, 1, 3}));
  const NodeId id = box(s, parent, "lift", Affine::Identity());
  s.scene.set_link(id, test::slider_link("j", Affine::Identity(), {0, 0, 1}, 0.2));
  ASSERT_FALSE(has_error(s.bridge.hand_over(id)));
  EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(id)), 0.6, 1e-15);
  s.bridge.set_link_value(id, 0.5);
  EXPECT_NEAR(s.physics.joint_value(s.bridge.joint_of(id)), 1.5, 1e-15);
  EXPECT_NEAR(s.scene.world(id).translation().z(), 1.5, 1e-15);
  EXPECT_NEAR(s.scene.link(id)->value[0], 0.5, 1e-15);
}

TEST(HandOver, TiesALinkAcrossUnboundNodesToTheNearestBody) {
  // Between the two bodies stands a node without body: the joint is between the bodies.
  Stage s;
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId between = s.scene.create(a, "between", moved({1, 0, 0}));
  const NodeId b = box(s, between, "b", Affine::Identity());
  s.scene.set_link(b, test::pivot_link("j", moved({0, 0, 1}), {0, 1, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(a, Scope::Subtree)));
  const JointDefinition& joint = s.physics.joint(s.bridge.joint_of(b));
  EXPECT_EQ(joint.a, s.bridge.body_of(a));
  EXPECT_LT((joint.X_AJ.p - Vector3{1, 0, 1}).norm(), 1e-15);
}

TEST(HandOver, TiesALinkUnderAStandingParentToTheWorld) {
  // Nothing above is bound or played: the joint's other end is the world.
  Stage s;
  const NodeId base = s.scene.create(s.scene.root(), "base", moved({0, 0, 2}));
  const NodeId arm = box(s, base, "arm", Affine::Identity());
  s.scene.set_link(arm, test::pivot_link("j", Affine::Identity(), {0, 1, 0}));
  ASSERT_FALSE(has_error(s.bridge.hand_over(arm)));
  const JointDefinition& joint = s.physics.joint(s.bridge.joint_of(arm));
  EXPECT_FALSE(joint.a);
  EXPECT_LT((joint.X_AJ.p - Vector3{0, 0, 2}).norm(), 1e-15);
}

TEST(HandOver, BindsAnAnimatedParentToCarryTheJoint) {
  // The parent is played by a clip but has no body: the bridge binds it, massless and animated, as long as it
  // is needed.
  Stage s;
  const NodeId base = s.scene.create(s.scene.root(), "base");
  const NodeId arm = box(s, base, "arm", Affine::Identity());
  s.scene.set_link(arm, test::pivot_link("j", Affine::Identity(), {0, 1, 0}));
  ASSERT_TRUE(s.bridge.play(test::swinging_clip(), {base}).empty());
  ASSERT_FALSE(has_error(s.bridge.hand_over(arm)));
  EXPECT_EQ(s.bridge.drive_of(base), Drive::Scene);
  EXPECT_EQ(s.physics.joint(s.bridge.joint_of(arm)).a, s.bridge.body_of(base));
  static_cast<void>(s.bridge.advance(0.5));
  EXPECT_LT((s.scene.world(arm).translation() - s.scene.world(base).translation()).norm(), 1e-10);
  s.bridge.release(arm);
  EXPECT_FALSE(s.bridge.drive_of(base).has_value());
}

TEST(HandOver, RefusesALoopThatAnotherJointCloses) {
  // A joint of the user's own already ties the arm to the world: the link's joint would close a loop.
  Stage s;
  const NodeId arm = box(s, s.scene.root(), "arm", Affine::Identity());
  ASSERT_TRUE(s.bridge.follow(arm).empty());
  s.physics.add(BallSettings{.name = "own", .b = s.bridge.body_of(arm)});
  s.scene.set_link(arm, test::pivot_link("j", Affine::Identity(), {0, 1, 0}));
  const std::vector<Diagnostic> notes = s.bridge.hand_over(arm);
  EXPECT_TRUE(says(notes, "arm", "its joint 'j' closes a loop of joints")) << test::text_of(notes);
  EXPECT_EQ(s.bridge.drive_of(arm), Drive::Scene);
  EXPECT_EQ(s.physics.joints().size(), 1U);
}

TEST(HandOver, RefusesAStaticNodeBelow) {
  // Its body would stand while its node went along.
  Stage s;
  const NodeId a = box(s, s.scene.root(), "a", Affine::Identity());
  const NodeId b = box(s, a, "b", Affine::Identity());
  ASSERT_FALSE(has_error(s.bridge.fix(b)));
  EXPECT_TRUE(says(s.bridge.hand_over(a), "a/b", "it is static and would be carried along"));
  s.bridge.release(b);
  ASSERT_FALSE(has_error(s.bridge.hand_over(a)));
  EXPECT_TRUE(says(s.bridge.fix(b), "a/b", "it would be carried along by a simulated node above it"));
}

TEST(HandOver, TellsOfAMatrixThatTheLinkCannotMake) {
  // The node was moved off its link; it is joined where it is, with a warning.
  Stage s;
  const NodeId id = box(s, s.scene.root(), "arm", Affine::Identity());
  s.scene.set_link(id, test::pivot_link("j", Affine::Identity(), {0, 0, 1}));
  s.scene.set_local(id, moved({0, 0, 0.5}));
  EXPECT_TRUE(says(s.bridge.hand_over(id), "arm", "not one that its pivot link can make"));
  EXPECT_LT(s.physics.joint_drift().distance, 1e-15);
}

}  // namespace
}  // namespace pantin
