#include <pantin/physics/integrators/semi_implicit_euler.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <support/order_of_convergence.hpp>

namespace pantin {
namespace {

TEST(SemiImplicitEuler, IsOfFirstOrderForEveryKindOfState) {
  // Against closed forms and tight solutions; at 4000 steps the next power of the step changes a slope by
  // less than 0.01.
  test::expect_order("semi-implicit-euler", 1, 4000, 0.02);
}

TEST(SemiImplicitEuler, KicksAtTheStartAndMovesWithTheNewVelocity) {
  // Acceleration at t, after any break there; the rate with velocities that belong to t + h, before any break
  // there.
  using Kind = test::Recorder::Kind;
  test::Oscillator oscillator{{.omega = 2}};
  test::Recorder recorder{oscillator};
  test::State state{{1}, {3}};
  make_semi_implicit_euler()->step(recorder, 2, 0.5, state.q, state.v);
  EXPECT_EQ(recorder.calls,
            (std::vector<test::Recorder::Call>{
                {Kind::Acceleration, 2, Side::After}, {Kind::Rate, 2.5, Side::Before}, {Kind::Settle}}));
  EXPECT_DOUBLE_EQ(state.v[0], 3 - 0.5 * 4 * 1);
  EXPECT_DOUBLE_EQ(state.q[0], 1 + 0.5 * 1);
}

TEST(SemiImplicitEuler, KeepsAModifiedEnergyForever) {
  // The map conserves v^2 + w^2 x^2 - h w^2 x v exactly (its determinant is 1 and this form is invariant;
  // Hairer, Lubich, Wanner, Geometric Numerical Integration, I.1.4): only rounding is left over 100,000
  // steps.
  const double omega = 3, h = 0.05, w2 = omega * omega;
  test::Oscillator oscillator{{.omega = omega}};
  test::State state{{0.7}, {-0.4}};
  const auto invariant = [&] {
    const double x = state.q[0], v = state.v[0];
    return v * v + w2 * x * x - h * w2 * x * v;
  };
  const double start = invariant();
  const std::unique_ptr<Integrator> euler = make_semi_implicit_euler();
  for (int step = 0; step < 100000; ++step) euler->step(oscillator, step * h, h, state.q, state.v);
  EXPECT_NEAR(invariant() / start, 1, 1e-11);
}

}  // namespace
}  // namespace pantin
