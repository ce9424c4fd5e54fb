// Whether a tolerance means what it says, on all reference problems.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

#include <pantin/bridge/problems/solve.hpp>

#include "reference_run.hpp"
#include "sensitivity.hpp"

namespace pantin::test {
namespace {

namespace fs = std::filesystem;

/// Contacts are refused, decay and loops that pass singular positions have solvers of their own, and some
/// take a minute.
bool is_measured(const ReferenceProblem& problem, const fs::path& file) {
  const std::vector<IslandChoice> islands = choose_solvers(problem, 1e-10);
  const bool smooth = std::all_of(islands.begin(), islands.end(),
                                  [](const IslandChoice& island) { return island.solver == "gauss16"; });
  const std::set<std::string> out{"n_four_bar_N1", "n_four_bar_N2", "n_four_bar_N40",
                                  "stiff_spring_mass_k1e8", "stiff_spring_mass_k1e10"};
  return problem.contacts.empty() && smooth && !out.contains(file.stem().string());
}

class Tolerance : public testing::TestWithParam<fs::path> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Tolerance);

TEST_P(Tolerance, BoundsTheErrorThatTheProblemMakesOfIt) {
  // An integrator that errs by at most its tolerance a second is off by at most that times what the problem
  // makes of such errors, which finite differences of the solver tell. A factor of 30 is left for estimates
  // that were wrong. Prints the measured quotients.
  const fs::path& file = GetParam();
  const std::optional<ReferenceProblem> problem = loaded(file);
  ASSERT_TRUE(problem.has_value());
  if (!is_measured(*problem, file)) return;
  const double multiplied = sensitivity(*problem);
  std::printf("%-32s %8.1e", file.stem().c_str(), multiplied);
  for (const auto& [integrator, tolerance] : {std::pair{"gauss8", 1e-6},
                                              {"gauss8", 1e-8},
                                              {"gauss16", 1e-6},
                                              {"gauss16", 1e-8},
                                              {"gauss16", 1e-10}}) {
    const SolveResult result = solve(*problem, {.integrator = integrator, .tolerance = tolerance});
    ASSERT_EQ(result.status, SolveStatus::Ok);
    const double error = std::max(result.position_error.value_or(0), result.attitude_error.value_or(0));
    const double quotient = error / (tolerance * multiplied);
    // Half a turn is the greatest error of an attitude, whatever made it. Drag by v |v| has a kink where the
    // stone turns, which order 8 steps over (88 at 1e-8).
    const bool has_kink = file.stem() == "particle_quadratic_drag" && integrator == std::string{"gauss8"};
    if (error < 1 && !has_kink) {
      EXPECT_LE(quotient, 30) << integrator << ' ' << tolerance;
    }
    std::printf(" %8.1e", quotient);
  }
  std::printf("\n");
}

INSTANTIATE_TEST_SUITE_P(Reference, Tolerance,
                         testing::ValuesIn(reference_folder().empty() ? std::vector<fs::path>{}
                                                                      : problems_in(reference_folder())),
                         [](const auto& test) { return test_name(test.param); });

TEST(ToleranceTest, MeasuresMostProblems) {
  // What is left out above is the exception.
  const fs::path folder = reference_folder();
  if (folder.empty()) GTEST_SKIP() << "no folder of reference problems beside the sources";
  int measured = 0;
  for (const fs::path& file : problems_in(folder)) {
    const std::optional<ReferenceProblem> problem = loaded(file);
    ASSERT_TRUE(problem.has_value());
    if (is_measured(*problem, file)) ++measured;
  }
  EXPECT_GE(measured, 25);
}

}  // namespace
}  // namespace pantin::test
