#include <pantin/physics/constraints/pivot.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "support/contracts.hpp"
#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using test::facing;
using test::joint_here;
using test::lopsided_mass;
using test::run;

constexpr double kG = 9.81;

/// A body that hangs on a y pivot at the origin, its centre of gravity 0.4 m below when the angle is 0.
struct Pendulum {
  PhysicsManager physics{};
  BodyId body{};
  JointId pivot{};
  double inertia{0};  ///< about the pivot [kg m^2]

  explicit Pendulum(double damping = 0, double gravity = kG) {
    physics.forces().add(Gravity{.g_W = {0, 0, -gravity}});
    MassProperties mass;
    mass.mass = 2;
    mass.p_BBcm = {0, 0, -0.4};
    mass.I_BBcm_B = Vector3{0.05, 0.06, 0.02}.asDiagonal();
    inertia = 0.06 + 2 * 0.4 * 0.4;
    body = physics.add(RigidBodySettings{.name = "bob", .mass = mass});
    PivotSettings s =
        joint_here<PivotSettings>(physics, BodyId{}, body, {Vector3::Zero(), facing({0, 1, 0})});
    s.damping = damping;
    pivot = physics.add(s);
  }
};

TEST(Pivot, SwingsWithThePeriodOfTheEllipticIntegral) {
  // T = 4 sqrt(I / (m g l)) K(sin(theta0 / 2)) is the exact period of a physical pendulum; after one period
  // from rest it is back where it started. RK4 with 4,000 steps a period leaves about 1e-11.
  Pendulum p;
  const double start = 2.0;
  p.physics.set_joint_value(p.pivot, start);
  const double period = 4 * std::sqrt(p.inertia / (2 * kG * 0.4)) * std::comp_ellint_1(std::sin(start / 2));
  ASSERT_TRUE(run(p.physics, period / 4000, 4000));
  EXPECT_NEAR(p.physics.joint_value(p.pivot), start, 1e-9);
  EXPECT_NEAR(p.physics.joint_rate(p.pivot), 0, 1e-9);
  ASSERT_TRUE(run(p.physics, period / 4000, 2000));
  EXPECT_NEAR(p.physics.joint_value(p.pivot), -start, 1e-9) << "half a period later on the other side";
}

TEST(Pivot, TurnsInTheRightHandSense) {
  // A positive rate about y takes z towards x: the bob below the pivot moves towards -x.
  Pendulum p{0, 0};
  p.physics.set_joint_rate(p.pivot, 1.0);
  ASSERT_TRUE(run(p.physics, 0.01, 10));
  EXPECT_LT((p.physics.body(p.body).p_WBcm() - 0.4 * Vector3{-std::sin(0.1), 0, -std::cos(0.1)}).norm(),
            1e-12);
  EXPECT_NEAR(p.physics.joint_value(p.pivot), 0.1, 1e-14);
}

TEST(Pivot, CountsWholeTurns) {
  // At a constant rate the value is rate * time, beyond one turn, and stays so when the layout is made anew.
  Pendulum p{0, 0};
  p.physics.set_joint_rate(p.pivot, 10.0);
  ASSERT_TRUE(run(p.physics, 0.01, 300));
  EXPECT_NEAR(p.physics.joint_value(p.pivot), 30.0, 1e-11);
  p.physics.add(RigidBodySettings{.name = "another"});
  EXPECT_NEAR(p.physics.joint_value(p.pivot), 30.0, 1e-11);
  ASSERT_TRUE(run(p.physics, 0.01, 1));
  EXPECT_NEAR(p.physics.joint_value(p.pivot), 30.1, 1e-11);
}

TEST(Pivot, LosesItsRateToDamping) {
  // I w' = -d w has w = w0 exp(-d t / I); RK4 at d h / I = 3e-3 is right to 1e-12.
  Pendulum p{0.4, 0};
  p.physics.set_joint_rate(p.pivot, 3.0);
  ASSERT_TRUE(run(p.physics, 0.001, 1000));
  EXPECT_NEAR(p.physics.joint_rate(p.pivot), 3.0 * std::exp(-0.4 / p.inertia), 1e-11);
}

TEST(Pivot, CarriesWhatHangsOnItWhenSet) {
  // set_joint_value moves B rigidly and the bodies behind it; their own joint values stay.
  Pendulum p;
  const BodyId tip =
      p.physics.add(RigidBodySettings{.name = "tip", .X_WB = {{0, 0, -1}}, .mass = lopsided_mass()});
  const JointId second =
      p.physics.add(joint_here<PivotSettings>(p.physics, p.body, tip, {{0, 0, -0.8}, facing({1, 0, 0})}));
  p.physics.set_joint_value(second, 0.3);
  p.physics.set_joint_value(p.pivot, M_PI / 2);
  EXPECT_NEAR(p.physics.joint_value(second), 0.3, 1e-15);
  EXPECT_NEAR(p.physics.joint_value(p.pivot), M_PI / 2, 1e-15);
  EXPECT_LT((p.physics.body(p.body).p_WBcm() - Vector3{-0.4, 0, 0}).norm(), 1e-15);
  EXPECT_NEAR(p.physics.body(tip).X_WB().p.x(), -0.8 - 0.2 * std::cos(0.3), 1e-15);
  EXPECT_LT(p.physics.joint_drift().distance, 1e-15);
}

TEST(Pivot, IsTheSameSeenFromEitherSide) {
  // Naming the bodies in the other order changes the sign of value and rate and nothing else.
  const auto simulate = [](bool swapped) {
    Pendulum p;
    const BodyId tip =
        p.physics.add(RigidBodySettings{.name = "tip", .X_WB = {{0, 0, -1}}, .mass = lopsided_mass()});
    const BodyId a = swapped ? tip : p.body, b = swapped ? p.body : tip;
    const JointId joint =
        p.physics.add(joint_here<PivotSettings>(p.physics, a, b, {{0, 0, -0.8}, facing({1, 1, 0})}));
    p.physics.set_joint_value(p.pivot, 1.0);
    p.physics.set_joint_rate(joint, swapped ? -2.0 : 2.0);
    static_cast<void>(run(p.physics, 0.002, 500));
    const double sign = swapped ? -1 : 1;
    return std::array<double, 3>{sign * p.physics.joint_value(joint), sign * p.physics.joint_rate(joint),
                                 p.physics.body(tip).p_WBcm().x()};
  };
  const auto one = simulate(false), other = simulate(true);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(one[i], other[i], 1e-11);
}

TEST(Pivot, MayStandTwiceAtTheSamePlace) {
  // A second pivot on the same axis holds what is held already: the motion of one pivot alone, to rounding.
  Pendulum one, two;
  EXPECT_TRUE(two.physics.closes_loop(BodyId{}, two.body));
  two.physics.add(joint_here<PivotSettings>(two.physics, BodyId{}, two.body,
                                            {Vector3::Zero(), facing({0, 1, 0})}, "second"));
  ASSERT_TRUE(run(one.physics, 0.01, 100));
  ASSERT_TRUE(run(two.physics, 0.01, 100));
  EXPECT_LT((one.physics.body(one.body).p_WBcm() - two.physics.body(two.body).p_WBcm()).norm(), 1e-13);
}

TEST(Pivot, RefusesBadSettings) {
  // Each rule of the settings has its own message.
  test::ThrowOnContract guard;
  Pendulum p;
  const auto message = [&](PivotSettings s) {
    try {
      p.physics.add(s);
    } catch (const test::ContractError& e) {
      return std::string{e.what()};
    }
    return std::string{"taken"};
  };
  EXPECT_NE(message({.name = "j"}).find("b is null"), std::string::npos);
  EXPECT_NE(message({.name = "j", .a = p.body, .b = p.body}).find("same body"), std::string::npos);
  EXPECT_NE(message({.name = "j", .b = p.body, .X_AJ = {.p = {0, 0, NAN}}}).find("not finite"),
            std::string::npos);
  EXPECT_NE(message({.name = "j", .b = p.body, .damping = -1}).find("damping"), std::string::npos);
}

}  // namespace
}  // namespace pantin
