#include <pantin/physics/constraints/driven.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::FunctionDriver;
using test::joint_here;
using test::lopsided_mass;
using test::momenta_of;
using test::run;

std::unique_ptr<Driver> shaking(double amplitude, double omega) {
  return std::make_unique<FunctionDriver>([=](double t, Side) {
    RigidMotion m;
    m.X_AB.p = {1 + amplitude * std::sin(omega * t), 0, 0};
    m.v_AB = {amplitude * omega * std::cos(omega * t), 0, 0};
    m.a_AB = {-amplitude * omega * omega * std::sin(omega * t), 0, 0};
    return m;
  });
}

TEST(Driven, LoadsTheBodyThatCarriesIt) {
  // A free body with a mass that is shaken along x against it: the common centre of gravity moves uniformly,
  // so x_a = x_a(0) + (v_cm t) - m_b / (m_a + m_b) (s(t) - s(0)). Closed form, no rotation by symmetry.
  PhysicsManager physics;
  MassProperties mass;
  mass.mass = 3;
  const BodyId a = physics.add(RigidBodySettings{.name = "a", .mass = mass});
  mass.mass = 1;
  const BodyId b = physics.add(RigidBodySettings{.name = "b", .X_WB = {{1, 0, 0}}, .mass = mass});
  physics.add(DrivenSettings{.name = "shaker", .a = a, .b = b, .driver = shaking(0.2, 5)});
  ASSERT_TRUE(run(physics, 1e-3, 1));
  const double v_cm = momenta_of(physics).linear.x() / 4;
  const double x0 = physics.body(a).p_WBcm().x(), t0 = physics.time();
  ASSERT_TRUE(run(physics, 1e-3, 999));
  const double moved = 0.2 * (std::sin(5.0) - std::sin(5 * t0));
  EXPECT_NEAR(physics.body(a).p_WBcm().x(), x0 + v_cm * (1 - t0) - moved / 4, 1e-11);
  EXPECT_NEAR(physics.body(b).p_WBcm().x() - physics.body(a).p_WBcm().x(), 1 + 0.2 * std::sin(5.0), 1e-14);
  EXPECT_NEAR(momenta_of(physics).linear.x() / 4, v_cm, 1e-13);
}

TEST(Driven, KeepsAngularMomentumOfAFreePair) {
  // A driven rotation is internal: linear and angular momentum of the pair stay, from either side of the
  // joint.
  for (const bool swapped : {false, true}) {
    PhysicsManager physics;
    const BodyId a =
        physics.add(RigidBodySettings{.name = "a", .w_WB = {0.3, 0.1, 0.2}, .mass = lopsided_mass(2)});
    const BodyId b =
        physics.add(RigidBodySettings{.name = "b", .X_WB = {{0.5, 0, 0}}, .mass = lopsided_mass(1)});
    auto driver = std::make_unique<FunctionDriver>([](double t, Side) {
      RigidMotion m;
      m.X_AB = {{0.5, 0.2 * t, 0}, Quaternion{Eigen::AngleAxisd{t * t, Vector3::UnitY()}}};
      m.v_AB = {0, 0.2, 0};
      m.w_AB = {0, 2 * t, 0};
      m.alpha_AB = {0, 2, 0};
      return m;
    });
    DrivenSettings s{.name = "arm", .a = swapped ? b : a, .b = swapped ? a : b, .driver = std::move(driver)};
    if (swapped) physics.set_pose(a, {{0.5, 0, 0}, Quaternion::Identity()});
    if (swapped) physics.set_pose(b, Pose{});
    physics.add(std::move(s));
    ASSERT_TRUE(run(physics, 1e-3, 1));
    const test::Momenta start = momenta_of(physics);
    ASSERT_TRUE(run(physics, 1e-3, 1000));
    EXPECT_LT((momenta_of(physics).linear - start.linear).norm(), 1e-11);
    EXPECT_LT((momenta_of(physics).angular - start.angular).norm(), 1e-8);
  }
}

TEST(Driven, GivesTheSameMotionFromBothSides) {
  // B moves in A as given, whichever of the two is nearer to the ground: then the solver needs the inverse
  // motion, with its rates. Momentum tests above show the rates to be right.
  for (const bool swapped : {false, true}) {
    PhysicsManager physics;
    const BodyId a = physics.add(RigidBodySettings{.name = "a", .mass = lopsided_mass(2)});
    const BodyId b =
        physics.add(RigidBodySettings{.name = "b", .X_WB = {{0.5, 0, 0}}, .mass = lopsided_mass(1)});
    // Rooting: a pivot to the world at the driven side makes the joint reversed for the solver.
    physics.add(joint_here<BallSettings>(physics, BodyId{}, swapped ? b : a,
                                         {{0.2, 0.3, 0.1}, Quaternion::Identity()}));
    physics.add(DrivenSettings{
        .name = "arm", .a = a, .b = b, .driver = std::make_unique<FunctionDriver>([](double t, Side) {
                                         RigidMotion m;
                                         m.X_AB = {{0.5 + 0.1 * t * t, 0, 0},
                                                   Quaternion{
                                                       Eigen::AngleAxisd{std::sin(2 * t), Vector3::UnitZ()}}};
                                         m.v_AB = {0.2 * t, 0, 0};
                                         m.a_AB = {0.2, 0, 0};
                                         m.w_AB = {0, 0, 2 * std::cos(2 * t)};
                                         m.alpha_AB = {0, 0, -4 * std::sin(2 * t)};
                                         return m;
                                       })});
    physics.forces().add(Gravity{});
    ASSERT_TRUE(run(physics, 1e-3, 501));
    const Pose X_AB = inverse(physics.body(a).X_WB()) * physics.body(b).X_WB();
    EXPECT_NEAR(X_AB.p.x(), 0.5 + 0.1 * 0.501 * 0.501, 1e-12);
    EXPECT_LT(X_AB.q.angularDistance(Quaternion{Eigen::AngleAxisd{std::sin(1.002), Vector3::UnitZ()}}),
              1e-12);
  }
}

TEST(Driven, JumpsInVelocityAreImpulses) {
  // A driven part that starts to move at once (a linear key) takes momentum from its carrier: with m_a = 3,
  // m_b = 1 and relative speed u the carrier recoils by u / 4. Steps land on the break, so this is exact.
  PhysicsManager physics;
  MassProperties mass;
  mass.mass = 3;
  const BodyId a = physics.add(RigidBodySettings{.name = "a", .mass = mass});
  mass.mass = 1;
  const BodyId b = physics.add(RigidBodySettings{.name = "b", .X_WB = {{1, 0, 0}}, .mass = mass});
  const double start = 0.0123;
  physics.add(DrivenSettings{
      .name = "ram",
      .a = a,
      .b = b,
      .driver = std::make_unique<FunctionDriver>(
          [start](double t, Side side) {
            RigidMotion m;
            const bool on = t > start || (t == start && side == Side::After);
            m.X_AB.p = {1 + (on ? 2 * (t - start) : 0), 0, 0};
            m.v_AB = {on ? 2.0 : 0.0, 0, 0};
            return m;
          },
          [start](double t) { return t < start ? start : std::numeric_limits<double>::infinity(); })});
  const StepReport first = physics.step(0.01);
  EXPECT_EQ(first.updates, 1);
  EXPECT_EQ(physics.body(a).v_WBcm().x(), 0);
  const StepReport second = physics.step(0.01);
  EXPECT_EQ(second.updates, 2) << "the step is cut at the break";
  EXPECT_NEAR(physics.body(a).v_WBcm().x(), -0.5, 1e-14);
  EXPECT_NEAR(physics.body(b).v_WBcm().x(), 1.5, 1e-14);
  EXPECT_NEAR(physics.body(a).p_WBcm().x(), -0.5 * (0.02 - start), 1e-15);
  EXPECT_NEAR(momenta_of(physics).linear.norm(), 0, 1e-14);
}

TEST(Driven, HasNoDriftOnEitherSideOfAJump) {
  // At the seam of a looping motion the body stands where the motion begins or where it ended: neither is
  // drift.
  PhysicsManager physics;
  const BodyId a = physics.add(RigidBodySettings{.name = "a", .mass = lopsided_mass()});
  const BodyId b = physics.add(RigidBodySettings{.name = "b", .mass = lopsided_mass()});
  physics.add(
      DrivenSettings{.a = a, .b = b, .driver = std::make_unique<FunctionDriver>([](double t, Side side) {
                                       RigidMotion m;
                                       m.X_AB.p = {t == 0 && side == Side::Before ? 1.0 : t, 0, 0};
                                       m.v_AB = {1, 0, 0};
                                       return m;
                                     })});
  EXPECT_EQ(physics.joint_drift().distance, 0);
  ASSERT_TRUE(run(physics, 0.01, 3));
  EXPECT_LT(physics.joint_drift().distance, 1e-15);
}

TEST(Driven, AnimatedGroundFeelsLikeGravity) {
  // A pendulum on a base with constant acceleration a moves, seen from the base, like one under gravity g -
  // a.
  const auto swing = [](double base_acceleration, const Vector3& g) {
    PhysicsManager physics;
    physics.forces().add(Gravity{.g_W = g});
    RigidBodySettings base{.name = "base", .kind = BodyKind::Animated};
    base.driver = std::make_unique<FunctionDriver>([=](double t, Side) {
      RigidMotion m;
      m.X_AB.p = {base_acceleration * t * t / 2, 0, 0};
      m.v_AB = {base_acceleration * t, 0, 0};
      m.a_AB = {base_acceleration, 0, 0};
      return m;
    });
    const BodyId ground = physics.add(std::move(base));
    const BodyId bob = physics.add(RigidBodySettings{.name = "bob", .mass = lopsided_mass()});
    const JointId pivot = physics.add(
        joint_here<PivotSettings>(physics, ground, bob, {Vector3::Zero(), test::facing({0, 1, 0})}));
    EXPECT_TRUE(run(physics, 1e-3, 1500));
    return static_cast<double>(physics.joint_value(pivot));
  };
  EXPECT_NEAR(swing(4, {0, 0, -9.81}), swing(0, {-4, 0, -9.81}), 1e-10);
}

}  // namespace
}  // namespace pantin
