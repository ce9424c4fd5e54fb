#include <pantin/physics/integrators/gauss.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <support/expect_contract.hpp>
#include <support/mechanisms.hpp>
#include <support/order_of_convergence.hpp>

#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/pivot.hpp>

namespace pantin {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// Distance after `steps` equal steps over 1 s.
double distance(Dynamics& dynamics, const test::State& start, const test::State& exact, int stages,
                int steps) {
  const std::unique_ptr<Integrator> integrator = make_gauss({.stages = stages, .tolerance = kInf});
  test::State state = start;
  for (int i = 0; i < steps; ++i) integrator->step(dynamics, 1.0 * i / steps, 1.0 / steps, state.q, state.v);
  EXPECT_EQ(integrator->control()->refused, 0);
  double squares = 0;
  for (std::size_t i = 0; i < state.q.size(); ++i) squares += std::pow(state.q[i] - exact.q[i], 2);
  return std::sqrt(squares);
}

TEST(Gauss, IsOfTwiceItsStagesInOrder) {
  // Without control every step asked for is one step. Against the closed form of a driven, damped oscillator
  // and of a free symmetric top, whose attitude is a quaternion: halving the step divides the error by 2^(2
  // s).
  test::Oscillator oscillator{{.omega = 3, .decay = 0.2, .force = 1, .force_frequency = 2}};
  const test::State x{{1}, {0}};
  test::ToyBody top{{.moments = {1, 1, 0.4}}};
  const test::State spin = test::ToyBody::state(test::kToyPose, {0, 0, 0}, {2, -1, 1.5});
  for (const int stages : {1, 2, 3, 4}) {
    const int steps = stages < 3 ? 16 : 3;
    const double order = std::log2(distance(oscillator, x, oscillator.exact(x, 1), stages, steps) /
                                   distance(oscillator, x, oscillator.exact(x, 1), stages, 2 * steps));
    EXPECT_NEAR(order, 2 * stages, 0.15) << stages;
    const double turning = std::log2(distance(top, spin, top.exact_symmetric(spin, 1), stages, steps) /
                                     distance(top, spin, top.exact_symmetric(spin, 1), stages, 2 * steps));
    EXPECT_NEAR(turning, 2 * stages, 0.3) << stages;
  }
}

TEST(Gauss, OfSixteenthOrderIsExactToRoundingInAFewSteps) {
  // At order 16 a step of 0.25 s of motions of 3 rad/s leaves an error like 0.75^17 (8!)^4 / (16!)^3: nothing
  // but the rounding of 50 evaluations.
  test::ToyBody top{{.moments = {1, 1, 0.4}}};
  const test::State spin = test::ToyBody::state(test::kToyPose, {0, 0, 0}, {2, -1, 1.5});
  EXPECT_LT(distance(top, spin, top.exact_symmetric(spin, 1), 8, 4), 1e-14);
}

TEST(Gauss, KeepsItsToleranceOverTenDecades) {
  // On a Kepler ellipse of eccentricity 0.7, whose speed changes 5.7-fold: after one orbit the body is back,
  // within a modest multiple of tolerance x time (the orbit's own growth of errors, about 100), down to
  // rounding.
  test::ToyBody sky{{.load = [](const test::ToyBody::Motion& m) {
    return Wrench{-m.p / std::pow(m.p.norm(), 3), Vector3::Zero()};
  }}};
  const test::State start =
      test::ToyBody::state({.p = {1.7, 0, 0}}, {0, std::sqrt(0.3 / 1.7), 0}, Vector3::Zero());
  const double orbit = 2 * std::acos(-1.0);
  for (const int stages : {4, 8}) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-13}) {
      const std::unique_ptr<Integrator> integrator = make_gauss({.stages = stages, .tolerance = tolerance});
      test::State state = start;
      integrator->step(sky, 0, orbit, state.q, state.v);
      EXPECT_LT(std::hypot(state.q[0] - start.q[0], state.q[1] - start.q[1]), 100 * tolerance * orbit + 1e-12)
          << stages << ' ' << tolerance;
      EXPECT_GT(integrator->control()->accepted, 3);
    }
  }
}

TEST(Gauss, CutsStepsThatDoNotConvergeAndSaysSo) {
  // The iteration contracts while omega h is about 1 or 2: of a step with omega h = 40 at least 10 are made,
  // and with an order of 16 the result is that of the closed form.
  test::Oscillator fast{{.omega = 40}};
  const test::State start{{1}, {0}};
  const std::unique_ptr<Integrator> integrator = make_gauss({.stages = 8, .tolerance = kInf});
  test::State state = start;
  integrator->step(fast, 0, 1, state.q, state.v);
  EXPECT_GT(integrator->control()->refused, 0);
  EXPECT_GT(integrator->control()->accepted, 10);
  EXPECT_NEAR(state.q[0], fast.exact(start, 1).q[0], 1e-9);
}

TEST(Gauss, HoldsJointsOfAllKindsOfCoordinates) {
  // A pivot and a ball hanging on each other, through the manager: energy is kept to the tolerance and the
  // joints to rounding, because poses are made from joint coordinates.
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  RigidBodySettings arm{.name = "arm", .X_WB = {{0.5, 0, 0}}}, bob{.name = "bob", .X_WB = {{1.5, 0, 0}}};
  arm.mass = bob.mass = {1, Vector3::Zero(), 0.1 * Matrix3::Identity()};
  const BodyId a = physics.add(std::move(arm)), b = physics.add(std::move(bob));
  physics.add(
      test::joint_here<PivotSettings>(physics, BodyId{}, a, Pose{Vector3::Zero(), test::facing({0, 1, 0})}));
  physics.add(test::joint_here<BallSettings>(physics, a, b, Pose{{1, 0, 0}, Quaternion::Identity()}));
  physics.set_velocity(b, {0, 0, 0}, {0.3, 2, 5});
  physics.set_integrator(make_gauss({.stages = 8, .tolerance = 1e-12}));
  ASSERT_TRUE(physics.step(1e-9).ok());
  const double energy = physics.energy().total();
  const StepReport report = physics.step(3);
  ASSERT_TRUE(report.ok());
  EXPECT_GT(report.inner_steps, 5);
  EXPECT_NEAR(report.energy.total(), energy, 1e-10);
  EXPECT_LT(physics.joint_drift().distance, 1e-14);
}

TEST(Gauss, ContinuesBitForBitFromASnapshot) {
  // The polynomial of the last step, what rounding kept back and the next step are part of the state.
  PhysicsManager physics;
  physics.add(test::thrown_body());
  physics.forces().add(Gravity{});
  physics.set_integrator(make_gauss16());
  ASSERT_TRUE(test::run(physics, 0.1, 5));
  const State here = physics.snapshot();
  ASSERT_TRUE(test::run(physics, 0.1, 5));
  const State there = physics.snapshot();
  physics.restore(here);
  ASSERT_TRUE(test::run(physics, 0.1, 5));
  EXPECT_EQ(hash(physics.snapshot()), hash(there));
}

TEST(Gauss, ForgetsItsPolynomialWhereTheStateWasEdited) {
  // After a teleport nothing of the motion before may enter: the result is that of a fresh integrator, to the
  // bit.
  test::Oscillator oscillator{{.omega = 3}};
  const std::unique_ptr<Integrator> used = make_gauss16(), fresh = make_gauss16();
  test::State a{{1}, {0}}, b{{-2}, {0.5}};
  used->step(oscillator, 0, 0.5, a.q, a.v);
  a = b;
  used->control()->memory.next = 0.25;
  fresh->step(oscillator, 0.5, 0.5, b.q, b.v);
  used->step(oscillator, 0.5, 0.5, a.q, a.v);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.v, b.v);
}

TEST(Gauss, RefusesSettingsThatMeanNothing) {
  // Stages beyond the tables, tolerances that no step meets.
  test::expect_contract([] { static_cast<void>(make_gauss({.stages = 9})); }, "stages is 9; give 1 to 8");
  test::expect_contract([] { static_cast<void>(make_gauss({.tolerance = 0})); },
                        "give an error per second above zero");
}

}  // namespace
}  // namespace pantin
