#include <pantin/physics/integrators/verlet.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <support/order_of_convergence.hpp>

namespace pantin {
namespace {

using Kind = test::Recorder::Kind;

TEST(Verlet, IsOfSecondOrderForEveryKindOfState) {
  // Against closed forms and tight solutions, with attitudes and with forces that look at velocities; at 400
  // steps the next power of the step changes a slope by less than 0.01.
  test::expect_order("verlet", 2, 400, 0.02);
}

TEST(Verlet, KicksDriftsThroughTheMiddleAndKicks) {
  // After any break at t, before any break at later times; the half kick goes with t, the drift with t + h/2.
  test::Oscillator oscillator{{.omega = 2}};
  test::Recorder recorder{oscillator};
  test::State state{{1}, {0}};
  make_verlet()->step(recorder, 2, 0.5, state.q, state.v);
  EXPECT_EQ(recorder.calls, (std::vector<test::Recorder::Call>{{Kind::Acceleration, 2, Side::After},
                                                               {Kind::Rate, 2, Side::After},
                                                               {Kind::Rate, 2.25, Side::Before},
                                                               {Kind::Settle},
                                                               {Kind::Acceleration, 2.5, Side::Before},
                                                               {Kind::Settle}}));
}

TEST(Verlet, CorrectsOnceWhereForcesLookAtVelocities) {
  // One more evaluation at the end, with the velocity found there: a = -4 x - 2 v from x = 1, v = 0, h = 1/2
  // by hand.
  test::Oscillator oscillator{{.omega = 2, .decay = 1}};
  test::Recorder recorder{oscillator};
  test::State state{{1}, {0}};
  make_verlet()->step(recorder, 0, 0.5, state.q, state.v);
  ASSERT_EQ(recorder.calls.size(), 7U);
  EXPECT_EQ(recorder.calls[5], (test::Recorder::Call{Kind::Acceleration, 0.5, Side::Before}));
  // a0 = -4, v_half = -1, x1 = 1/2, v_pred = -2: a1 = -2 + 4 = 2, v1 = -1/2: a1' = -2 + 1 = -1, v1' = -1.25.
  EXPECT_DOUBLE_EQ(state.q[0], 0.5);
  EXPECT_DOUBLE_EQ(state.v[0], -1.25);
}

TEST(Verlet, IsExactUnderConstantAcceleration) {
  // x = v t + a t^2 / 2 is what the scheme is made of: one long step is exact.
  class Fall final : public Dynamics {
   public:
    std::size_t coordinates() const override { return 1; }
    std::size_t velocities() const override { return 1; }
    void rate(Instant, std::span<const double>, std::span<const double> v, std::span<double> q_dot) override {
      q_dot[0] = v[0];
    }
    void acceleration(Instant, std::span<const double>, std::span<const double>,
                      std::span<double> v_dot) override {
      v_dot[0] = -10;
    }
  } fall;
  test::State state{{5}, {3}};
  make_verlet()->step(fall, 0, 2, state.q, state.v);
  EXPECT_DOUBLE_EQ(state.q[0], 5 + 3 * 2 - 20);
  EXPECT_DOUBLE_EQ(state.v[0], 3 - 20);
}

TEST(Verlet, KeepsAModifiedEnergyForever) {
  // On an oscillator v^2 + w^2 x^2 (1 - (w h)^2 / 4) is invariant exactly (Hairer, Lubich, Wanner, Geometric
  // Numerical Integration, I.1.4): only rounding is left over 100,000 steps.
  const double omega = 3, h = 0.05, w2 = omega * omega;
  test::Oscillator oscillator{{.omega = omega}};
  test::State state{{0.7}, {-0.4}};
  const auto invariant = [&] {
    return state.v[0] * state.v[0] + w2 * state.q[0] * state.q[0] * (1 - w2 * h * h / 4);
  };
  const double start = invariant();
  const std::unique_ptr<Integrator> verlet = make_verlet();
  for (int step = 0; step < 100000; ++step) verlet->step(oscillator, step * h, h, state.q, state.v);
  EXPECT_NEAR(invariant() / start, 1, 1e-11);
}

/// A planet of unit mass around a sun at the origin, G M = 1, started at the far end of an ellipse of
/// eccentricity 0.3.
test::ToyBody planet() {
  return test::ToyBody{{.load = [](const test::ToyBody::Motion& m) {
    return Wrench{-m.p / std::pow(m.p.norm(), 3), Vector3::Zero()};
  }}};
}
const test::State kFarEnd =
    test::ToyBody::state({.p = {1.3, 0, 0}}, {0, std::sqrt(0.7 / 1.3), 0}, Vector3::Zero());

TEST(Verlet, RunsBackwardsTheWayItCame) {
  // The scheme is symmetric in time: with all velocities turned it retraces its steps but for rounding.
  test::ToyBody sky = planet();
  const std::unique_ptr<Integrator> verlet = make_verlet();
  test::State state = test::run(*verlet, sky, kFarEnd, 10, 500);
  EXPECT_GT(test::distance(state, kFarEnd), 0.1);
  for (double& momentum : state.v) momentum = -momentum;
  state = test::run(*verlet, sky, state, 10, 500);
  for (double& momentum : state.v) momentum = -momentum;
  EXPECT_LT(test::distance(state, kFarEnd), 1e-12);
}

TEST(Verlet, KeepsTheEnergyOfAnOrbitBounded) {
  // Symplectic: the error of the energy is as large after 500 orbits as in the first ones, and angular
  // momentum about the sun stays exactly (kicks are radial, drifts along the velocity).
  test::ToyBody sky = planet();
  const auto energy = [&](const test::State& s) {
    return sky.kinetic_energy(s) - 1 / std::hypot(s.q[0], s.q[1], s.q[2]);
  };
  const auto momentum = [](const test::State& s) { return s.q[0] * s.v[1] - s.q[1] * s.v[0]; };
  const double start = energy(kFarEnd), orbit = 2 * std::acos(-1.0), h = orbit / 100;
  const std::unique_ptr<Integrator> verlet = make_verlet();
  test::State state = kFarEnd;
  double early = 0, late = 0;
  for (int step = 0; step < 500 * 100; ++step) {
    verlet->step(sky, step * h, h, state.q, state.v);
    double& worst = step < 20 * 100 ? early : late;
    worst = std::max(worst, std::abs(energy(state) - start));
  }
  EXPECT_GT(early, 1e-6);  // the step is long enough for an error to be seen
  EXPECT_LT(late, 1.01 * early);
  EXPECT_NEAR(momentum(state), momentum(kFarEnd), 1e-12);
}

TEST(Verlet, KeepsAngularMomentumOfAFreeBodyExactly) {
  // L is a velocity and no torque acts: it keeps its bits, whatever the body's shape and however it tumbles.
  test::ToyBody body{{.moments = {1, 1.5, 0.7}}};
  const test::State start = test::ToyBody::state(test::kToyPose, {0, 0, 0}, {3, -2, 1});
  const test::State end = test::run(*make_verlet(), body, start, 10, 1000);
  EXPECT_EQ(end.v, start.v);
  EXPECT_NEAR(body.kinetic_energy(end), body.kinetic_energy(start), 1e-3);
}

}  // namespace
}  // namespace pantin
