#include <pantin/physics/integrators/stability_watch.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <support/mechanisms.hpp>
#include <support/toy_dynamics.hpp>

#include <pantin/physics/forces/damped_spring.hpp>

namespace pantin {
namespace {

constexpr double kStep = 1.0 / 240;

/// A wheel of moment 0.02 kg m^2 on a damped pivot, turning at 3 rad/s; no other load.
struct Wheel {
  explicit Wheel(double rate_of_decay, bool watched) {
    RigidBodySettings s;
    s.name = "wheel";
    s.mass.mass = 1;
    s.mass.I_BBcm_B = Vector3{0.01, 0.01, 0.02}.asDiagonal();
    const BodyId body = physics.add(std::move(s));
    joint = physics.add(PivotSettings{.name = "axle", .b = body, .damping = 0.02 * rate_of_decay});
    physics.set_joint_rate(joint, 3);
    physics.watch_stability(watched);
  }
  PhysicsManager physics{};
  JointId joint{};
};

double rate_of(Dynamics& dynamics, const test::State& at, double enough) {
  StabilityWatch watch;
  StabilityMemory memory;
  return watch.fastest_rate(dynamics, {}, at.q, at.v, enough, memory);
}

TEST(StabilityWatch, FindsHowFastAnOscillatorSwings) {
  // The eigenvalues of x'' = -omega^2 x - 2 d x' are -d +- i sqrt(omega^2 - d^2): of size omega, damped or
  // not. The derivative is linear, so the power method only has to settle (3 % in a turn).
  for (const double omega : {0.5, 3.0, 3e2, 1e5}) {
    for (const double decay : {0.0, 0.3 * omega}) {
      test::Oscillator oscillator{{.omega = omega, .decay = decay}};
      EXPECT_NEAR(rate_of(oscillator, {{0.2}, {-1.0}}, omega), omega, 0.15 * omega) << omega << " " << decay;
    }
  }
}

TEST(StabilityWatch, CutsStepsThatTheIntegratorDoesNotBear) {
  // The rate of a damped wheel decays as exp(-c t), here 8.3 c-times a step: rk4 bears 2.78 and multiplies
  // what is beyond, so that unwatched the rate grows; watched it falls in every step, and the joint is named.
  const double c = 2000;
  Wheel plain{c, false}, watched{c, true};
  for (int i = 0; i < 20; ++i) {
    const double before = std::abs(double{watched.physics.joint_rate(watched.joint)});
    const StepReport report = watched.physics.step(kStep);
    ASSERT_TRUE(report.ok());
    EXPECT_NEAR(report.fast.rate, c, 0.1 * c);
    EXPECT_EQ(report.fast.parts, 4);  // 1.25 * 2000 / 240 / 2.78 = 3.7
    EXPECT_FALSE(report.fast.implicitly);
    EXPECT_EQ(report.fast.joint, watched.joint);
    EXPECT_LT(std::abs(double{watched.physics.joint_rate(watched.joint)}), 0.5 * before);
    static_cast<void>(plain.physics.step(kStep));
  }
  EXPECT_GT(std::abs(double{plain.physics.joint_rate(plain.joint)}), 1e6);
}

TEST(StabilityWatch, TakesImplicitlyWhatWouldTakeTooManyParts) {
  // At 4,000 decay times a step the implicit midpoint rule, which is stable for any, multiplies the rate by
  // (1 - x/2) / (1 + x/2) with x = c h: -0.999 here.
  const double c = 1e6, x = c * kStep;
  Wheel wheel{c, true};
  for (int i = 0; i < 5; ++i) {
    const double before = wheel.physics.joint_rate(wheel.joint);
    const StepReport report = wheel.physics.step(kStep);
    ASSERT_TRUE(report.ok());
    EXPECT_TRUE(report.fast.implicitly);
    EXPECT_NEAR(wheel.physics.joint_rate(wheel.joint), before * (1 - x / 2) / (1 + x / 2), 1e-6);
  }
}

TEST(StabilityWatch, LeavesMotionAloneThatTheIntegratorBears) {
  // A watch that has nothing to say changes no bit.
  Wheel plain{20, false}, watched{20, true};
  for (int i = 0; i < 100; ++i) {
    static_cast<void>(plain.physics.step(kStep));
    const StepReport report = watched.physics.step(kStep);
    EXPECT_EQ(report.fast.rate, 0);
    EXPECT_EQ(report.evaluations, 4);
  }
  EXPECT_EQ(plain.physics.snapshot(), watched.physics.snapshot());
}

TEST(StabilityWatch, NoticesForcesThatComeLater) {
  // A law that is added between two looks is looked at before it acts: a spring of omega = 2,000 rad/s.
  PhysicsManager physics;
  RigidBodySettings s;
  s.X_WB.p = {1.001, 0, 0};
  s.mass.mass = 1;
  const BodyId ball = physics.add(std::move(s));
  physics.watch_stability(true);
  EXPECT_EQ(physics.step(kStep).fast.rate, 0);
  physics.forces().add(DampedSpring{.b = {.body = ball}, .stiffness = 4e6, .rest_length = 1});
  const double energy = physics.energy().total();
  for (int i = 0; i < 200; ++i) {
    const StepReport report = physics.step(kStep);
    ASSERT_TRUE(report.ok());
    EXPECT_NEAR(report.fast.rate, 2000, 200);
    EXPECT_EQ(report.fast.body, ball);
  }
  EXPECT_LE(physics.energy().total(), energy * 1.001);  // rk4 inside its region only loses
}

TEST(StabilityWatch, GoesOnFromASnapshotBitForBit) {
  // What the watch knows is part of State: the same looks fall on the same steps.
  Wheel wheel{2000, true};
  for (int i = 0; i < 3; ++i) static_cast<void>(wheel.physics.step(kStep));
  const State middle = wheel.physics.snapshot();
  for (int i = 0; i < 7; ++i) static_cast<void>(wheel.physics.step(kStep));
  const State end = wheel.physics.snapshot();
  wheel.physics.restore(middle);
  for (int i = 0; i < 7; ++i) static_cast<void>(wheel.physics.step(kStep));
  EXPECT_EQ(wheel.physics.snapshot(), end);
}

TEST(StabilityWatch, LeavesIntegratorsAloneThatChooseTheirSteps) {
  // Their tolerance sees to it, and implicit ones bear any step.
  for (const char* name : {"dormand-prince", "gauss16", "radau", "implicit-midpoint"}) {
    Wheel wheel{2000, true};
    wheel.physics.set_integrator(make_integrator(name));
    EXPECT_EQ(wheel.physics.step(kStep).fast.rate, 0) << name;
  }
}

}  // namespace
}  // namespace pantin
