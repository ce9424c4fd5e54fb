// The problems that come with the sources (assets/problems, closed forms): rk4 meets each within a bound, and
// every integrator gains its order on each.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "expected_errors.hpp"

namespace pantin::test {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, ExpectedErrors> kOwn{
    {"drag_and_torque", {2e-3, 2e-12, 3e-10, 2e-13}},    {"free_symmetric_top", {2e-3, 0, 1e-9, 0}},
    {"slider_on_turning_arm", {2e-3, 2e-9, 0, 2e-9}},    {"slider_spring_damper", {2e-3, 2e-9, 0, 2e-10}},
    {"top_steady_precession", {2e-3, 3e-6, 2e-5, 5e-8}}, {"welded_pendulum", {2e-3, 7e-10, 2e-9, 6e-11}},
};

class OwnProblem : public testing::TestWithParam<fs::path> {};

TEST_P(OwnProblem, ComesOutWithRk4) {
  // The samples are a closed form, rounded to double: what is measured is the integrator's error.
  const std::optional<ReferenceProblem> problem = loaded(GetParam());
  ASSERT_TRUE(problem.has_value());
  const auto expected = kOwn.find(problem->name);
  ASSERT_NE(expected, kOwn.end()) << "give '" << problem->name << "' a bound";
  const RunErrors errors = run(*problem, {.step = expected->second.step});
  EXPECT_EQ(errors.compared, problem->bodies.size() * problem->samples.size());
  expect_within(errors, expected->second);
}

/// An integrator and steps at which it is in its asymptotic range on all own problems.
struct OrderCase {
  const char* integrator;
  double step;
  double order;
};

class OwnProblemOrder : public testing::TestWithParam<std::tuple<fs::path, OrderCase>> {};

TEST_P(OwnProblemOrder, IsThatOfTheIntegrator) {
  // Halving the step divides the error against the closed form by 2^order: 16 for rk4, 4 for verlet, 2 for
  // the Eulers. The problems cover free rotation, drag, springs and dampers, a slider, a ball, a pivot with a
  // weld, and a joint on an animated body. Tolerance: the next term of the error, a few per cent at these
  // steps.
  const auto& [file, wanted] = GetParam();
  const std::optional<ReferenceProblem> problem = loaded(file);
  ASSERT_TRUE(problem.has_value());
  double error[2];
  for (const int halvings : {0, 1}) {
    const RunErrors errors =
        run(*problem, {.integrator = wanted.integrator, .step = wanted.step, .refinement = 1 << halvings});
    ASSERT_EQ(errors.failure, "");
    error[halvings] = errors.position + errors.attitude;
  }
  ASSERT_GT(error[1], 20 * kRounding);  // else the order cannot be seen
  EXPECT_NEAR(std::log2(error[0] / error[1]), wanted.order, 0.12) << error[0] << " -> " << error[1];
}

INSTANTIATE_TEST_SUITE_P(Assets, OwnProblem, testing::ValuesIn(problems_in(own_folder())),
                         [](const auto& test) { return test_name(test.param); });
INSTANTIATE_TEST_SUITE_P(Assets, OwnProblemOrder,
                         testing::Combine(testing::ValuesIn(problems_in(own_folder())),
                                          testing::Values(OrderCase{"rk4", 5e-3, 4},
                                                          OrderCase{"verlet", 1e-3, 2},
                                                          OrderCase{"euler", 2.5e-4, 1},
                                                          OrderCase{"semi-implicit-euler", 2.5e-4, 1})),
                         [](const auto& test) {
                           return test_name(std::get<0>(test.param)) + "_" +
                                  test_name(std::get<1>(test.param).integrator);
                         });

}  // namespace
}  // namespace pantin::test
