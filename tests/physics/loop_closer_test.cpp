#include <pantin/physics/constraints/loop_closer.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "support/allocation_guard.hpp"
#include "support/contracts.hpp"
#include "support/four_bar.hpp"

namespace pantin {
namespace {

using test::FourBar;
using test::joint_here;
using test::lopsided_mass;
using test::run;

TEST(LoopCloser, ClosesALoopThatStartsSlightlyOpen) {
  // A rod set off by a millimetre: closed at once, and by no more than some millimetres of motion.
  FourBar bar;
  const RigidBody coupler = bar.physics.body(bar.rods[1]);
  const Vector3 before = coupler.p_WBcm();
  PivotSettings last;
  const JointDefinition& far = bar.physics.joint(bar.joints[2]);
  last.name = "far";
  last.a = far.a, last.b = far.b, last.X_AJ = far.X_AJ, last.X_BJ = far.X_BJ;
  last.X_AJ.p += Vector3{1e-3, -5e-4, 0};
  bar.physics.remove(bar.joints[2]);
  bar.physics.add(last);
  EXPECT_TRUE(bar.physics.singular_joints().empty());
  ASSERT_TRUE(bar.physics.step(1e-6).ok());
  EXPECT_LT(bar.physics.joint_drift().distance, 1e-13);
  EXPECT_LT((bar.physics.body(bar.rods[1]).p_WBcm() - before).norm(), 5e-3);
}

TEST(LoopCloser, NamesALoopThatCannotBeClosed) {
  // A coupler that would have to be a metre longer: the joint is named beforehand, the step changes nothing
  // and says the same, and once the joint is gone all is well.
  FourBar bar;
  JointDefinition far;
  far.kind = JointKind::Ball;
  far.name = "too far";
  far.a = bar.rods[1], far.b = bar.rods[2];
  far.X_AJ.p = {2.5, 0, 0};
  far.X_BJ.p = {0.35, 0, 0};
  bar.physics.remove(bar.joints[2]);
  const JointId open = bar.physics.add_joint(std::move(far));
  const auto found = bar.physics.singular_joints();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].first, open);
  EXPECT_EQ(found[0].second.code, ProblemCode::OpenLoop);
  const Vector3 before = bar.physics.body(bar.rods[1]).p_WBcm();
  const StepReport report = bar.physics.step(1e-3);
  EXPECT_EQ(report.status, StepStatus::LoopOpen);
  EXPECT_NE(report.message.find("the loop that ball 'too far' closes cannot be closed"), std::string::npos);
  EXPECT_NE(report.message.find("leave one joint out"), std::string::npos);
  EXPECT_EQ(bar.physics.body(bar.rods[1]).p_WBcm(), before);
  EXPECT_EQ(bar.physics.time(), 0);
  bar.physics.remove(open);
  EXPECT_TRUE(bar.physics.step(1e-3).ok());
}

TEST(LoopCloser, SaysWhenWhatDrivesALoopTearsItApart) {
  // A rod between the world and an animated body that goes farther away than the rod and its second part
  // reach: some step fails, names a joint, and keeps the state before it.
  PhysicsManager physics;
  const auto motion = [](double t, Side) {
    return RigidMotion{.X_AB = {{1 + t, 0, 0}, Quaternion::Identity()}, .v_AB = {1, 0, 0}};
  };
  const BodyId puller = physics.add(RigidBodySettings{
      .kind = BodyKind::Animated, .driver = std::make_unique<test::FunctionDriver>(motion)});
  const BodyId one = physics.add(RigidBodySettings{.X_WB = {{0.25, 0.25, 0}}, .mass = lopsided_mass()});
  const BodyId two = physics.add(RigidBodySettings{.X_WB = {{0.75, 0.25, 0}}, .mass = lopsided_mass()});
  physics.add(joint_here<BallSettings>(physics, {}, one, {Vector3::Zero(), Quaternion::Identity()}, "near"));
  physics.add(joint_here<BallSettings>(physics, one, two, {{0.5, 0.5, 0}, Quaternion::Identity()}, "middle"));
  physics.add(joint_here<BallSettings>(physics, puller, two, {{1, 0, 0}, Quaternion::Identity()}, "end"));
  StepReport report;
  for (int i = 0; i < 200 && report.ok(); ++i) report = physics.step(5e-3);
  EXPECT_FALSE(report.ok());
  EXPECT_NEAR(physics.time(), std::sqrt(2.0) - 1, 0.03) << "both parts in line";
  EXPECT_FALSE(report.message.empty());
  EXPECT_LT(physics.joint_drift().distance, 1e-6);
}

TEST(LoopCloser, SettlesWithoutAllocating) {
  // Work space is made when joints are laid out; a steady step needs none.
  FourBar bar;
  ASSERT_TRUE(run(bar.physics, 1e-3, 3));
  const std::size_t before = test::allocations_so_far();
  ASSERT_TRUE(run(bar.physics, 1e-3, 10));
  EXPECT_EQ(test::allocations_so_far(), before);
}

TEST(LoopCloser, GoesOnBitForBitAfterRestore) {
  // State holds all that a loop needs.
  FourBar bar;
  ASSERT_TRUE(run(bar.physics, 1e-3, 20));
  const State then = bar.physics.snapshot();
  ASSERT_TRUE(run(bar.physics, 1e-3, 20));
  const State first = bar.physics.snapshot();
  bar.physics.restore(then);
  ASSERT_TRUE(run(bar.physics, 1e-3, 20));
  EXPECT_TRUE(bar.physics.snapshot() == first);
}

TEST(LoopCloser, CountsTheTurnsOfACutJoint) {
  // Around the loop the angles of a planar four-bar, each counted with its turns, add up to zero, whichever
  // joint is cut: base + tip + far - post.
  for (const auto& order : {std::array{0, 1, 2, 3}, std::array{0, 2, 1, 3}}) {
    FourBar bar{order};
    ASSERT_TRUE(run(bar.physics, 2e-3, 600));
    EXPECT_GT(double{bar.physics.joint_value(bar.joints[0])}, 2 * M_PI);
    const auto value = [&bar](std::size_t j) { return double{bar.physics.joint_value(bar.joints[j])}; };
    EXPECT_NEAR(value(0) + value(1) + value(2) - value(3), 0, 1e-10);
  }
}

TEST(LoopCloser, TakesTheMechanismAlongWhenAValueIsSet) {
  // With the crank at an angle the rest stands where geometry says, also more than a turn ahead; set through
  // the joint that is cut ('far'), the crank comes back to where it was.
  FourBar bar{{0, 1, 2, 3}, 0, false};
  bar.physics.set_joint_value(bar.joints[0], 2 * M_PI + 1.1);
  auto shape = FourBar::shape(FourBar::kStart + 1.1);
  EXPECT_NEAR(bar.physics.joint_value(bar.joints[0]), 2 * M_PI + 1.1, 1e-12);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(bar.physics.body(bar.rods[i]).p_WBcm().x(), shape.centre[i].x, 1e-12) << i;
    EXPECT_NEAR(bar.physics.body(bar.rods[i]).p_WBcm().y(), shape.centre[i].y, 1e-12) << i;
  }
  const double far = bar.physics.joint_value(bar.joints[2]);
  bar.physics.set_joint_value(bar.joints[0], 2 * M_PI + 1.3);
  bar.physics.set_joint_value(bar.joints[2], far);
  EXPECT_NEAR(bar.physics.joint_value(bar.joints[0]), 2 * M_PI + 1.1, 1e-10);
  EXPECT_LT(bar.physics.joint_drift().distance, 1e-13);
}

TEST(LoopCloser, RefusesAValueThatTheLoopDoesNotAllow) {
  // The rocker swings by less than half a turn; what was before stays.
  test::ThrowOnContract guard;
  FourBar bar{{0, 1, 2, 3}, 0, false};
  const Vector3 before = bar.physics.body(bar.rods[2]).p_WBcm();
  try {
    bar.physics.set_joint_value(bar.joints[3], 3.0);
    FAIL() << "taken";
  } catch (const test::ContractError& e) {
    EXPECT_NE(std::string{e.what()}.find("joint 'post' cannot take this value with its loop closed"),
              std::string::npos);
  }
  EXPECT_EQ(bar.physics.body(bar.rods[2]).p_WBcm(), before);
}

TEST(LoopCloser, MovesTheMechanismAtTheRateOfOneJoint) {
  // Rates are geometry alone in a mechanism of one freedom, whichever joint is set.
  FourBar bar{{0, 1, 2, 3}, 0, false};
  const auto shape = FourBar::shape(FourBar::kStart);
  bar.physics.set_joint_rate(bar.joints[0], 3.0);
  EXPECT_NEAR(bar.physics.body(bar.rods[2]).w_WB().z(), 3 * shape.rate[2], 1e-12);
  bar.physics.set_joint_rate(bar.joints[2], 2 * (shape.rate[2] - shape.rate[1]));
  EXPECT_NEAR(bar.physics.body(bar.rods[0]).w_WB().z(), 2, 1e-11);
}

TEST(LoopCloser, LetsAnImpulseFallOnWhatTheLoopAllows) {
  // J on the coupler's centre gives theta' = (J . v) / M, with v the centre's velocity by theta (virtual
  // work).
  FourBar bar{{0, 1, 2, 3}, 0, false};
  const auto shape = FourBar::shape(FourBar::kStart);
  bar.physics.forces().remove(bar.gravity);
  bar.physics.apply_impulse(bar.rods[1], {0.4, -0.3, 0});
  ASSERT_TRUE(bar.physics.step(1e-9).ok());
  const double expected =
      (0.4 * shape.velocity[1].x - 0.3 * shape.velocity[1].y) / FourBar::inertia(FourBar::kStart);
  EXPECT_NEAR(bar.physics.joint_rate(bar.joints[0]), expected, 1e-7);
}

TEST(LoopCloser, FollowsABodyThatIsPlaced) {
  // The rocker is put where another crank angle would have it: the loop closes there.
  FourBar bar{{0, 1, 2, 3}, 0, false};
  const auto shape = FourBar::shape(FourBar::kStart + 0.2);
  bar.physics.set_pose(bar.rods[0], {{shape.centre[0].x, shape.centre[0].y, 0},
                                     Quaternion{Eigen::AngleAxisd{shape.angle[0], Vector3::UnitZ()}}});
  EXPECT_LT(bar.physics.joint_drift().distance, 1e-12);
  ASSERT_TRUE(bar.physics.step(1e-6).ok());
  EXPECT_LT(bar.physics.joint_drift().distance, 1e-13);
}

}  // namespace
}  // namespace pantin
