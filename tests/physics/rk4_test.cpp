#include <pantin/physics/integrators/rk4.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <support/order_of_convergence.hpp>

namespace pantin {
namespace {

TEST(Rk4, IsOfFourthOrderForEveryKindOfState) {
  // Against closed forms and tight solutions, attitudes included; at 100 steps the next power of the step
  // changes a slope by up to 0.05, and the finest error is still far over the roundings of the tight
  // solutions.
  test::expect_order("rk4", 4, 100, 0.1);
}

TEST(Rk4, AsksAtStartTwiceInTheMiddleAndAtTheEnd) {
  // After any break at t, before any break at later times; normalised once, last.
  using Kind = test::Recorder::Kind;
  test::Oscillator oscillator{{.omega = 2}};
  test::Recorder recorder{oscillator};
  test::State state{{1}, {0}};
  make_rk4()->step(recorder, 2, 0.5, state.q, state.v);
  EXPECT_EQ(recorder.calls, (std::vector<test::Recorder::Call>{{Kind::Derivative, 2, Side::After},
                                                               {Kind::Derivative, 2.25, Side::Before},
                                                               {Kind::Derivative, 2.25, Side::Before},
                                                               {Kind::Derivative, 2.5, Side::Before},
                                                               {Kind::Settle}}));
}

TEST(Rk4, DampsAnOscillatorByItsStabilityPolynomial) {
  // On x'' = -w^2 x one step multiplies v^2 + w^2 x^2 by |R(i w h)|^2 = 1 - (w h)^6/72 + (w h)^8/576, R the
  // Taylor polynomial of exp of degree 4.
  const double omega = 3, h = 0.1, z = omega * h;
  test::Oscillator oscillator{{.omega = omega}};
  test::State state{{0.7}, {-0.4}};
  const auto energy = [&] { return state.v[0] * state.v[0] + omega * omega * state.q[0] * state.q[0]; };
  const double start = energy();
  const std::unique_ptr<Integrator> rk4 = make_rk4();
  for (int step = 0; step < 1000; ++step) rk4->step(oscillator, step * h, h, state.q, state.v);
  const double factor = 1 - std::pow(z, 6) / 72 + std::pow(z, 8) / 576;
  EXPECT_NEAR(energy() / start / std::pow(factor, 1000), 1, 1e-12);
}

TEST(Rk4, IntegratesACubicInTimeExactly) {
  // v' = t^3 is Simpson's rule on a cubic, which is exact: v = t^4 / 4.
  class Cubic final : public Dynamics {
   public:
    std::size_t coordinates() const override { return 1; }
    std::size_t velocities() const override { return 1; }
    void rate(Instant, std::span<const double>, std::span<const double> v, std::span<double> q_dot) override {
      q_dot[0] = v[0];
    }
    void acceleration(Instant at, std::span<const double>, std::span<const double>,
                      std::span<double> v_dot) override {
      v_dot[0] = at.t * at.t * at.t;
    }
  } cubic;
  test::State state{{0}, {0}};
  make_rk4()->step(cubic, 0, 2, state.q, state.v);
  EXPECT_DOUBLE_EQ(state.v[0], 4);
}

}  // namespace
}  // namespace pantin
