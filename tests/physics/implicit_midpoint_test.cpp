#include <pantin/physics/integrators/implicit_midpoint.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <support/mechanisms.hpp>
#include <support/order_of_convergence.hpp>

#include <pantin/physics/forces/damped_spring.hpp>

namespace pantin {
namespace {

TEST(ImplicitMidpoint, IsOfSecondOrderForEveryKindOfState) {
  // Against closed forms and tight solutions; at 400 steps the next power of the step changes a slope by
  // little.
  test::expect_order("implicit-midpoint", 2, 400, 0.02);
}

TEST(ImplicitMidpoint, TurnsAnOscillatorByTheCayleyAngle) {
  // Closed form: on x'' = -w^2 x one step turns (w x, v) by exactly 2 atan(w h / 2), at any w h: the energy
  // stays.
  for (const double omega : {1.0, 30.0, 1e4}) {
    test::Oscillator oscillator{{.omega = omega}};
    test::State state{{0.7}, {-0.4}};
    const double h = 0.1, angle = 100 * 2 * std::atan(omega * h / 2);
    const double x = 0.7 * std::cos(angle) - 0.4 / omega * std::sin(angle);
    const double v = -0.4 * std::cos(angle) - 0.7 * omega * std::sin(angle);
    const std::unique_ptr<Integrator> midpoint = make_implicit_midpoint();
    for (int i = 0; i < 100; ++i) midpoint->step(oscillator, i * h, h, state.q, state.v);
    EXPECT_NEAR(state.q[0], x, 1e-9) << omega;
    EXPECT_NEAR(state.v[0] / omega, v / omega, 1e-9) << omega;
  }
}

TEST(ImplicitMidpoint, KeepsMomentumAndQuaternionOfAFreeBody) {
  // L is constant and |q|^2 quadratic: both are kept to rounding without any normalising; the step is long (w
  // h = 0.4).
  test::ToyBody body{{.moments = {1, 1.5, 0.7}}};
  const test::State start = test::ToyBody::state(test::kToyPose, {0, 0, 0}, {3, -2, 1});
  const test::State end = test::run(*make_implicit_midpoint(), body, start, 100, 1000);
  EXPECT_EQ(end.v, start.v);
  EXPECT_NEAR(test::ToyBody::attitude(end.q).norm(), 1, 1e-14);
}

/// A chain of bodies with springs of very different stiffness between neighbours, along x.
PhysicsManager stiff_chain(double damping) {
  PhysicsManager physics;
  std::vector<BodyId> ids;
  for (int i = 0; i < 6; ++i) {
    RigidBodySettings s{.name = "b" + std::to_string(i), .X_WB = {{1.0 * i + 0.01 * (i % 2), 0, 0}}};
    s.mass = {1, Vector3::Zero(), 0.1 * Matrix3::Identity()};
    ids.push_back(physics.add(std::move(s)));
  }
  for (std::size_t i = 0; i + 1 < ids.size(); ++i) {
    physics.forces().add(DampedSpring{.a = {ids[i]},
                                      .b = {ids[i + 1]},
                                      .stiffness = std::pow(10.0, 2.0 * static_cast<double>(i)),
                                      .damping = damping * std::pow(10.0, static_cast<double>(i)),
                                      .rest_length = 1});
  }
  physics.set_integrator(make_implicit_midpoint());
  return physics;
}

TEST(ImplicitMidpoint, StaysStableHoweverStiffSpringsAre) {
  // Stiffness up to 1e8 at a step of 1/60 s (w h = 236): an explicit method would overflow at once. Undamped
  // along a line the forces are linear, so the energy is kept; damped it falls.
  PhysicsManager ringing = stiff_chain(0);
  const double start = ringing.energy().total();
  ASSERT_TRUE(test::run(ringing, 1.0 / 60, 300));
  EXPECT_NEAR(ringing.energy().total(), start, 1e-6 * start);
  PhysicsManager damped = stiff_chain(0.1);
  double before = damped.energy().total();
  for (int i = 0; i < 300; ++i) {
    ASSERT_TRUE(test::run(damped, 1.0 / 60, 1));
    const double now = damped.energy().total();
    EXPECT_LT(now, before * (1 + 1e-9) + 1e-12);
    before = now;
  }
  EXPECT_LT(before, 0.9 * start);
}

TEST(ImplicitMidpoint, HoldsStronglyDampedLightJoints) {
  // A finger of 1 g on a pivot with the damping of an arm's joint: h d / I = 400, where rk4 overflows. A step
  // leaves (1 - 200) / (1 + 200) of the rate's distance from where gravity and damping balance: 10 s leave
  // 1e-10.
  const auto build = [] {
    PhysicsManager physics;
    physics.forces().add(Gravity{.g_W = {0, 0, -9.81}});
    RigidBodySettings s{.name = "finger", .X_WB = {{0.01, 0, 0}}};
    s.mass = {1e-3, Vector3::Zero(), 1e-8 * Matrix3::Identity()};
    const BodyId finger = physics.add(std::move(s));
    PivotSettings pivot = test::joint_here<PivotSettings>(physics, BodyId{}, finger,
                                                          Pose{Vector3::Zero(), test::facing({0, 1, 0})});
    pivot.damping = 0.01;
    physics.add(std::move(pivot));
    return physics;
  };
  PhysicsManager explicit_one = build(), implicit_one = build();
  EXPECT_FALSE(test::run(explicit_one, 1.0 / 240, 240));
  implicit_one.set_integrator(make_implicit_midpoint());
  // A coordinate of nothing but round-off is no measure of how far a step may go.
  implicit_one.set_joint_value(implicit_one.joints()[0], 1e-16);
  ASSERT_TRUE(test::run(implicit_one, 1.0 / 240, 2400));
  // In the end the torque m g l cos(a) balances the damping d a': a' = m g l cos(a) / d, slowly.
  const JointId joint = implicit_one.joints()[0];
  const double expected = 1e-3 * 9.81 * 0.01 * std::cos(implicit_one.joint_value(joint)) / 0.01;
  EXPECT_NEAR(implicit_one.joint_rate(joint), expected, 1e-3 * expected);
}

}  // namespace
}  // namespace pantin
