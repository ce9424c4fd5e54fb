#include <pantin/physics/integrators/radau.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <bench/own_chain.hpp>
#include <support/expect_contract.hpp>
#include <support/mixed_tree.hpp>
#include <support/order_of_convergence.hpp>

#include <pantin/physics/integrators/gauss.hpp>

namespace pantin {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// x'' = -k (x - cos t) - d (x' + sin t): pulled to cos t, which it follows up to cos t / k where k is large.
class Follower final : public Dynamics {
 public:
  Follower(double stiffness, double damping) : k_{stiffness}, d_{damping} {}
  std::size_t coordinates() const override { return 1; }
  std::size_t velocities() const override { return 1; }
  void rate(Instant, std::span<const double>, std::span<const double> v, std::span<double> q_dot) override {
    q_dot[0] = v[0];
  }
  void acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                    std::span<double> v_dot) override {
    v_dot[0] = -k_ * (q[0] - std::cos(at.t)) - d_ * (v[0] + std::sin(at.t));
  }
  /// The solution without transient: cos t + a cos t + b sin t with x'' + d x' + k x = k cos t - d sin t.
  [[nodiscard]] test::State exact(double t) const {
    const double K = k_ - 1, det = K * K + d_ * d_, a = K / det, b = d_ / det;
    return {{std::cos(t) + a * std::cos(t) + b * std::sin(t)},
            {-std::sin(t) - a * std::sin(t) + b * std::cos(t)}};
  }

 private:
  double k_, d_;
};

TEST(Radau, IsOfSeventhOrder) {
  // Without control every step asked for is one step; against the closed form of a driven, damped oscillator
  // halving the step divides the error by 2^7.
  test::Oscillator oscillator{{.omega = 3, .decay = 0.2, .force = 1, .force_frequency = 2}};
  const auto error = [&](int steps) {
    const std::unique_ptr<Integrator> integrator = make_radau({.tolerance = kInf});
    test::State state{{1}, {0}};
    for (int i = 0; i < steps; ++i)
      integrator->step(oscillator, 1.0 * i / steps, 1.0 / steps, state.q, state.v);
    return std::abs(state.q[0] - oscillator.exact({{1}, {0}}, 1).q[0]);
  };
  EXPECT_NEAR(std::log2(error(4) / error(8)), 7, 0.4);
}

TEST(Radau, FollowsStiffForcesInStepsOfTheMotionItself) {
  // Critically damped at 1e3 to 1e6 /s: the motion is that of cos t, and so are the steps, however stiff; the
  // transient that an offset of 1 excites is gone at once. Explicit methods need a step every few decay
  // times.
  for (const double rate : {1e3, 1e4, 1e5, 1e6}) {
    Follower follower{rate * rate, 2 * rate};
    const std::unique_ptr<Integrator> integrator = make_radau({.tolerance = 1e-9});
    test::State state = follower.exact(0);
    integrator->step(follower, 0, 2, state.q, state.v);
    EXPECT_LT(integrator->control()->accepted, 200) << rate;
    EXPECT_NEAR(state.q[0], follower.exact(2).q[0], 1e-7) << rate;
    test::State off{{2}, {0}};
    const std::unique_ptr<Integrator> other = make_radau({.tolerance = 1e-9});
    other->step(follower, 0, 2, off.q, off.v);
    EXPECT_NEAR(off.q[0], follower.exact(2).q[0], 1e-7) << rate;
    EXPECT_LT(other->control()->accepted, 1000) << rate;
  }
}

TEST(Radau, TakesStiffSpringsOnJointsInTenStepsASecond) {
  // Four of five rods on critically damped springs. Where Gauss stages can still follow the springs they are
  // the reference; where they are stiffer, it is the chain without those joints, which torques below 20 N m
  // bend by less than 10 / k m. Ten steps of order seven leave some 1e-7 m.
  const auto tip = [](double stiffness, std::unique_ptr<Integrator> integrator, int steps) {
    bench::Chain chain{5, true};
    chain.stiffness = stiffness;
    if (std::isfinite(stiffness)) chain.damping = 2 * std::sqrt(0.05 * stiffness);
    PhysicsManager physics = bench::build(chain);
    physics.set_integrator(std::move(integrator));
    EXPECT_TRUE(test::run(physics, 1.0 / steps, steps)) << stiffness;
    return physics.body(physics.bodies().back()).p_WBcm();
  };
  const auto tight = [] { return make_gauss({.stages = 8, .tolerance = 1e-12}); };
  for (const double k : {1e2, 1e4, 1e6, 1e8, 1e10}) {
    const Vector3 found = tip(k, make_radau({.tolerance = kInf}), 10);
    const Vector3 exact = tip(k > 1e5 ? kInf : k, tight(), 1);
    EXPECT_LT((found - exact).norm(), 2e-7 + (k > 1e5 ? 10 / k : 0)) << k;
  }
}

TEST(Radau, MovesTreesAsGaussDoes) {
  // Two methods that share no step: a tree of many joints, quaternions among its coordinates, ends up in the
  // same place.
  const auto tip = [](std::unique_ptr<Integrator> integrator) {
    PhysicsManager physics = test::mixed_tree(true);
    physics.set_integrator(std::move(integrator));
    EXPECT_TRUE(physics.step(0.5).ok());
    return Vector3{physics.body(physics.bodies()[6]).p_WBcm()};
  };
  EXPECT_LT((tip(make_radau({.tolerance = 1e-10})) - tip(make_gauss({.tolerance = 1e-12}))).norm(), 1e-8);
}

TEST(Radau, RefusesAToleranceThatIsNotPositive) {
  // Zero error needs infinitely many steps.
  test::expect_contract([] { static_cast<void>(make_radau({.tolerance = 0})); },
                        "give an error per second above zero");
}

}  // namespace
}  // namespace pantin
