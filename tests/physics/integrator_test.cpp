#include <pantin/physics/integrators/integrator.hpp>

#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <support/allocation_guard.hpp>
#include <support/contracts.hpp>
#include <support/order_of_convergence.hpp>

namespace pantin {
namespace {

TEST(IntegratorCatalogue, MakesEachIntegratorByItsName) {
  // The names of the header, each leading to an object that says the same of itself.
  const std::vector<std::string> names = integrator_names();
  EXPECT_EQ(names,
            (std::vector<std::string>{"euler", "semi-implicit-euler", "verlet", "rk4", "implicit-midpoint",
                                      "dormand-prince", "gauss8", "gauss16", "radau"}));
  for (const std::string& name : names) {
    const std::unique_ptr<Integrator> integrator = make_integrator(name);
    ASSERT_TRUE(integrator) << name;
    EXPECT_EQ(integrator->name(), name);
  }
}

TEST(IntegratorCatalogue, HasNothingForOtherNames) {
  // Names are exact: no prefix, no other case.
  EXPECT_FALSE(make_integrator("leapfrog"));
  EXPECT_FALSE(make_integrator("RK4"));
  EXPECT_FALSE(make_integrator(""));
}

TEST(Integrator, AsksAsOftenAsItSays) {
  // evaluations() against a count of the calls, with and without forces that look at velocities.
  for (const double decay : {0.0, 0.1}) {
    test::Oscillator oscillator{{.omega = 2, .decay = decay}};
    test::Recorder recorder{oscillator};
    for (const std::string& name : integrator_names()) {
      const std::unique_ptr<Integrator> integrator = make_integrator(name);
      test::State state{{1}, {0}};
      recorder.calls.clear();
      integrator->step(recorder, 0, 0.1, state.q, state.v);
      const auto evaluates = [](const test::Recorder::Call& call) {
        return call.kind == test::Recorder::Kind::Acceleration ||
               call.kind == test::Recorder::Kind::Derivative;
      };
      const auto calls = std::count_if(recorder.calls.begin(), recorder.calls.end(), evaluates);
      const bool decides_itself = name == "implicit-midpoint" || integrator->control() != nullptr;
      if (decides_itself) {
        EXPECT_GE(calls, integrator->evaluations(oscillator)) << name;
      } else {
        EXPECT_EQ(calls, integrator->evaluations(oscillator)) << name;
      }
    }
  }
}

TEST(Integrator, AllocatesNothingInSteadySteps) {
  // The first step makes room; further steps, and steps of a smaller system, find it there.
  test::ToyBody body{{.load = test::off_centre_spring(1, 1), .load_looks_at_velocity = true}};
  test::Oscillator oscillator{{.omega = 2, .decay = 0.1}};
  for (const std::string& name : integrator_names()) {
    if (name == "radau") continue;  // its matrices are factored by a library that takes room of its own
    const std::unique_ptr<Integrator> integrator = make_integrator(name);
    test::State state = test::ToyBody::state(test::kToyPose, {1, 2, 3}, {1, 2, 3});
    test::State small{{1}, {0}};
    integrator->step(body, 0, 0.01, state.q, state.v);
    integrator->step(oscillator, 0, 0.01, small.q, small.v);
    integrator->step(body, 0, 0.01, state.q, state.v);
    const test::AllocationGuard guard;
    for (int step = 1; step < 20; ++step) {
      integrator->step(body, step * 0.01, 0.01, state.q, state.v);
      integrator->step(oscillator, step * 0.01, 0.01, small.q, small.v);
    }
    EXPECT_EQ(guard.count(), 0U) << name;
  }
}

TEST(Integrator, ForgetsThePreviousStep) {
  // Work space holds nothing over: after steps of another system and in a new object the bits are the same.
  test::ToyBody body{{.load = test::off_centre_spring(1, 1), .load_looks_at_velocity = true}};
  test::Oscillator oscillator{{.omega = 2}};
  for (const std::string& name : integrator_names()) {
    const std::unique_ptr<Integrator> used = make_integrator(name), fresh = make_integrator(name);
    test::State small{{1}, {0}};
    test::State a = test::ToyBody::state(test::kToyPose, {1, 2, 3}, {1, 2, 3}), b = a;
    used->step(oscillator, 0, 0.1, small.q, small.v);
    if (used->control() != nullptr) used->control()->memory = {};  // what the manager keeps in State
    used->step(body, 0.3, 0.1, a.q, a.v);
    fresh->step(body, 0.3, 0.1, b.q, b.v);
    EXPECT_EQ(a.q, b.q) << name;
    EXPECT_EQ(a.v, b.v) << name;
  }
}

TEST(Integrator, KeepsQuaternionsOfUnitLength) {
  // normalise at the end of every step, also of steps so long that nothing else is right.
  for (const std::string& name : integrator_names()) {
    test::ToyBody body{{.moments = {1, 1.5, 0.7}}};
    test::State state = test::ToyBody::state(test::kToyPose, {0, 0, 0}, {3, -2, 1});
    const std::unique_ptr<Integrator> integrator = make_integrator(name);
    for (int step = 0; step < 100; ++step) integrator->step(body, step, 1, state.q, state.v);
    EXPECT_NEAR(test::ToyBody::attitude(state.q).norm(), 1, 1e-15) << name;
  }
}

TEST(Integrator, AdvancesNothingAtAll) {
  // An empty system, as of a scene whose bodies are all animated.
  class Empty final : public Dynamics {
   public:
    std::size_t coordinates() const override { return 0; }
    std::size_t velocities() const override { return 0; }
    void rate(Instant, std::span<const double>, std::span<const double>, std::span<double>) override {}
    void acceleration(Instant, std::span<const double>, std::span<const double>, std::span<double>) override {
    }
  } empty;
  for (const std::string& name : integrator_names()) make_integrator(name)->step(empty, 0, 0.1, {}, {});
}

/// The text of the contract that a step of an oscillator breaks.
std::string broken_contract(double t, double h, test::State state) {
  const test::ThrowOnContract guard;
  test::Oscillator oscillator{{.omega = 1}};
  std::string texts;
  for (const std::string& name : integrator_names()) {
    try {
      make_integrator(name)->step(oscillator, t, h, state.q, state.v);
      return name + " accepts it";
    } catch (const test::ContractError& error) {
      texts = error.what();
    }
  }
  return texts;
}

TEST(IntegratorContract, RefusesAStepThatIsNotPositive) {
  // Time goes forward; NaN is no step. By every integrator.
  EXPECT_EQ(broken_contract(0, 0, {{1}, {0}}).find("step is 0 s"), 0U);
  EXPECT_EQ(broken_contract(0, -1, {{1}, {0}}).find("step is -1 s"), 0U);
  EXPECT_EQ(broken_contract(0, std::numeric_limits<double>::quiet_NaN(), {{1}, {0}}).find("step is nan s"),
            0U);
}

TEST(IntegratorContract, RefusesATimeThatIsNotFinite) {
  // There is no t + h.
  EXPECT_EQ(broken_contract(std::numeric_limits<double>::infinity(), 1, {{1}, {0}}).find("time is inf s"),
            0U);
}

TEST(IntegratorContract, RefusesAStateOfAnotherSize) {
  // All coordinates and all velocities.
  EXPECT_EQ(broken_contract(0, 1, {{1, 2}, {0}}).find("2 coordinates given for 1"), 0U);
  EXPECT_EQ(broken_contract(0, 1, {{1}, {}}).find("0 velocities given for 1"), 0U);
}

TEST(TightSolution, AgreesWithClosedForms) {
  // The oracle of the order tests against the problems that have another one. What is left are roundings,
  // enlarged by the weights of the extrapolation; order tests use errors down to 1e-11.
  int compared = 0;
  for (const test::SmoothProblem& problem : test::smooth_problems()) {
    if (problem.kind.find("translation") == std::string::npos &&
        problem.kind.find("symmetric body") == std::string::npos)
      continue;
    if (problem.kind.find("asymmetric") != std::string::npos) continue;
    const test::State tight = test::tight_solution(*problem.dynamics, problem.start, problem.duration);
    EXPECT_LT(test::distance(tight, problem.end), 3e-13) << problem.kind;
    ++compared;
  }
  EXPECT_EQ(compared, 4);
}

}  // namespace
}  // namespace pantin
