#include <pantin/physics/integrators/euler.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <support/order_of_convergence.hpp>

namespace pantin {
namespace {

TEST(Euler, IsOfFirstOrderForEveryKindOfState) {
  // Against closed forms and tight solutions; at 4000 steps the next power of the step changes a slope by
  // less than 0.01.
  test::expect_order("euler", 1, 4000, 0.02);
}

TEST(Euler, AsksOnceAtTheStart) {
  // Everything at t, after any break that lies there; normalised once, last.
  using Kind = test::Recorder::Kind;
  test::Oscillator oscillator{{.omega = 2}};
  test::Recorder recorder{oscillator};
  test::State state{{1}, {0}};
  make_euler()->step(recorder, 2, 0.5, state.q, state.v);
  EXPECT_EQ(recorder.calls,
            (std::vector<test::Recorder::Call>{{Kind::Derivative, 2, Side::After}, {Kind::Settle}}));
}

TEST(Euler, FeedsAnOscillatorByAKnownFactor) {
  // (x, v) -> (x + h v, v - h w^2 x) multiplies v^2 + w^2 x^2 by exactly 1 + (w h)^2 each step.
  const double omega = 3, h = 0.01;
  test::Oscillator oscillator{{.omega = omega}};
  test::State state{{0.7}, {-0.4}};
  const auto energy = [&] { return state.v[0] * state.v[0] + omega * omega * state.q[0] * state.q[0]; };
  const double start = energy();
  const std::unique_ptr<Integrator> euler = make_euler();
  for (int step = 0; step < 1000; ++step) euler->step(oscillator, step * h, h, state.q, state.v);
  EXPECT_NEAR(energy() / start / std::pow(1 + omega * omega * h * h, 1000), 1, 1e-12);
}

}  // namespace
}  // namespace pantin
