#include <pantin/physics/constraints/motor.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <support/expect_contract.hpp>
#include <support/mechanisms.hpp>

#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/integrators/gauss.hpp>

namespace pantin {
namespace {

using test::run;

constexpr double kInertia = 0.5, kMass = 2, kG = 9.81;

/// A body of 2 kg on one joint to the world, turning about z (inertia 0.5) or sliding along it; gravity acts
/// against z.
template <class Settings>
struct Rig {
  PhysicsManager physics{};
  JointId joint{};
  Rig() {
    physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
    MassProperties mass;
    mass.mass = kMass;
    mass.I_BBcm_B = Vector3{0.3, 0.4, kInertia}.asDiagonal();
    joint = physics.add(Settings{.name = "axle", .b = physics.add(RigidBodySettings{.mass = mass})});
    physics.set_integrator(make_gauss({.stages = 8, .tolerance = 1e-12}));
  }
  [[nodiscard]] double value() const { return physics.joint_value(joint); }
  [[nodiscard]] double rate() const { return physics.joint_rate(joint); }
};

TEST(Motor, TurnsByItsEffortUpToItsLimitEitherWay) {
  // I q'' = effort, clamped: constant acceleration. The clamp is symmetric, and the effort can be read.
  for (const double sign : {1.0, -1.0}) {
    Rig<PivotSettings> rig;
    rig.physics.set_motor(rig.joint, {.effort = sign * 3});
    EXPECT_EQ(double{rig.physics.joint_effort(rig.joint)}, sign * 3);
    ASSERT_TRUE(rig.physics.step(1).ok());
    EXPECT_NEAR(rig.value(), sign * 0.5 * 3 / kInertia, 1e-12);
    rig.physics.set_motor(rig.joint, {.effort = sign * 1e6, .limit = 2});
    EXPECT_EQ(double{rig.physics.joint_effort(rig.joint)}, sign * 2);
    ASSERT_TRUE(rig.physics.step(1).ok());
    EXPECT_NEAR(rig.rate(), sign * (3 + 2) / kInertia, 1e-12);
  }
}

TEST(Motor, ReachesARate) {
  // I v' = damping (rate - v): v = rate (1 - exp(-damping t / I)).
  Rig<PivotSettings> rig;
  rig.physics.set_motor(rig.joint, {.rate = 4, .damping = 0.7});
  for (int i = 1; i <= 10; ++i) {
    ASSERT_TRUE(rig.physics.step(0.1).ok());
    EXPECT_NEAR(rig.rate(), 4 * (1 - std::exp(-0.7 * 0.1 * i / kInertia)), 1e-11);
  }
}

TEST(Motor, LiftsALoadToItsTargetAsFastAsItsLimitLets) {
  // While the limit binds, the load rises at (limit / m - g). The gains let go of it where
  // stiffness (value - z) - damping v = limit. Then the motion is a damped oscillation about the target, less
  // what the weight takes, and in the end stands there. With a limit below the weight it falls.
  Rig<SliderSettings> rig;
  const MotorSettings motor{.value = 3, .stiffness = 200, .damping = 40, .limit = 30};
  rig.physics.set_motor(rig.joint, motor);
  const double a = 30 / kMass - kG;
  // 200 (3 - a t^2 / 2) - 40 a t = 30
  const double release = (-40 * a + std::sqrt(1600 * a * a + 4 * 100 * a * 570)) / (2 * 100 * a);
  ASSERT_TRUE(rig.physics.step(release).ok());
  EXPECT_NEAR(rig.value(), 0.5 * a * release * release, 1e-11);
  ASSERT_TRUE(rig.physics.step(0.3).ok());
  // m x'' = -40 x' - 200 x about the point where all forces are in balance: critically damped at 10 /s.
  const double balance = 3 - kMass * kG / 200, x0 = 0.5 * a * release * release - balance, v0 = a * release;
  EXPECT_NEAR(rig.value(), balance + std::exp(-3.0) * (x0 + (v0 + 10 * x0) * 0.3), 1e-9);
  ASSERT_TRUE(rig.physics.step(5).ok());
  EXPECT_NEAR(rig.value(), balance, 1e-10);
  MotorSettings weak = motor;
  weak.limit = 10;
  Rig<SliderSettings> falling;
  falling.physics.set_motor(falling.joint, weak);
  ASSERT_TRUE(falling.physics.step(1).ok());
  EXPECT_NEAR(falling.value(), 0.5 * (10 / kMass - kG), 1e-11);
}

/// sin t, with the effort that this takes of an inertia; up to a time at which it lets go.
class Sine final : public MotorPath {
 public:
  explicit Sine(double end) : end_{end} {}
  MotorTarget target(double t, Side side) const override {
    if (t > end_ || (t == end_ && side == Side::After)) return {};
    return {-kInertia * std::sin(t), std::sin(t), std::cos(t)};
  }
  double next_break(double t) const override {
    return t < end_ ? end_ : std::numeric_limits<double>::infinity();
  }

 private:
  double end_;
};

TEST(Motor, TracksAPathAndStepsLandWhereItBreaks) {
  // With the effort of the path itself fed forward there is nothing left for the gains to do: q = sin t to
  // the integrator's error. Where the path ends (inside a step, which is cut there) only the limit of the
  // motor is left, zero, and the wheel goes on at the rate it has.
  Rig<PivotSettings> rig;
  rig.physics.set_joint_rate(rig.joint, 1);
  rig.physics.set_motor(rig.joint, {.path = std::make_shared<Sine>(1.05)});
  for (int i = 1; i <= 10; ++i) {
    ASSERT_TRUE(rig.physics.step(0.1).ok());
    EXPECT_NEAR(rig.value(), std::sin(0.1 * i), 1e-11);
  }
  const StepReport report = rig.physics.step(0.1);
  EXPECT_EQ(report.updates, 2);
  EXPECT_NEAR(rig.value(), std::sin(1.05) + 0.05 * std::cos(1.05), 1e-11);
}

TEST(Motor, ActsOnTheAxisItIsSetOnUntilItIsCleared) {
  // A cylindrical joint turns and slides independently: a motor on one number leaves the other alone. Without
  // motor there is no effort.
  PhysicsManager physics;
  MassProperties mass;
  mass.mass = kMass;
  mass.I_BBcm_B = Vector3{0.3, 0.4, kInertia}.asDiagonal();
  const JointId joint = physics.add(CylindricalSettings{.b = physics.add(RigidBodySettings{.mass = mass})});
  physics.set_motor(joint, {.effort = 4}, 1);
  EXPECT_FALSE(physics.motor(joint, 0).has_value());
  EXPECT_EQ(physics.motor(joint, 1)->effort, 4);
  ASSERT_TRUE(physics.step(1).ok());
  EXPECT_EQ(physics.joint_value(joint)[0], 0);
  EXPECT_NEAR(physics.joint_value(joint)[1], 0.5 * 4 / kMass, 1e-13);
  physics.clear_motor(joint, 1);
  EXPECT_FALSE(physics.motor(joint, 1).has_value());
  EXPECT_EQ(physics.joint_effort(joint)[1], 0);
  ASSERT_TRUE(physics.step(1).ok());
  EXPECT_NEAR(physics.joint_rate(joint)[1], 4 / kMass, 1e-13);
}

TEST(Motor, RefusesWhatItCannotDo) {
  // Each message names joint, setting and range.
  Rig<PivotSettings> rig;
  const auto refused = [&](const MotorSettings& motor, const std::string& text) {
    test::expect_contract([&] { rig.physics.set_motor(rig.joint, motor); }, text);
  };
  const double nan = std::nan("");
  refused({.limit = -1}, "motor on pivot 'axle': limit is -1 N m or N");
  refused({.limit = nan}, "limit is nan");
  refused({.effort = nan}, "effort");
  refused({.value = nan}, "value");
  refused({.rate = nan}, "rate");
  refused({.stiffness = -1}, "stiffness");
  refused({.damping = -1}, "damping");
  test::expect_contract([&] { rig.physics.set_motor(rig.joint, {}, 1); },
                        "pivot 'axle' has no axis 1 for a motor, only 1, counted from 0");
  const JointId ball = rig.physics.add(
      BallSettings{.name = "hip", .b = rig.physics.add(RigidBodySettings{.mass = test::lopsided_mass()})});
  test::expect_contract([&] { rig.physics.set_motor(ball, {}); }, "ball 'hip' has no axis 0");
}

}  // namespace
}  // namespace pantin
