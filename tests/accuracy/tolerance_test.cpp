// Whether a tolerance means what it says, on all reference problems.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>

#include <pantin/bridge/problems/solve.hpp>

#include "reference_run.hpp"
#include "sensitivity.hpp"

namespace pantin::test {
namespace {

TEST(Tolerance, BoundsTheErrorThatTheProblemMakesOfIt) {
  // An integrator that errs by at most its tolerance a second is off by at most that times what the problem
  // makes of such errors, which finite differences of the solver tell. A factor of 30 is left for estimates
  // that were wrong. Prints the measured quotients.
  const auto folder = reference_folder();
  if (folder.empty()) GTEST_SKIP() << "no folder of reference problems beside the sources";
#ifdef __OPTIMIZE__
  constexpr int kEvery = 1;
#else
  constexpr int kEvery = 6;  // all take ten minutes without optimisation
#endif
  int measured = 0, seen = 0;
  for (const auto& file : problems_in(folder)) {
    if (seen++ % kEvery != 0) continue;
    const std::optional<ReferenceProblem> problem = loaded(file);
    ASSERT_TRUE(problem.has_value());
    const std::vector<IslandChoice> islands = choose_solvers(*problem, 1e-10);
    const bool smooth = std::all_of(islands.begin(), islands.end(),
                                    [](const IslandChoice& island) { return island.solver == "gauss16"; });
    // Contacts are refused, decay and loops that pass singular positions have solvers of their own, and some
    // take a minute.
    const std::set<std::string> out{"n_four_bar_N1", "n_four_bar_N2", "n_four_bar_N40",
                                    "stiff_spring_mass_k1e8", "stiff_spring_mass_k1e10"};
    if (!problem->contacts.empty() || !smooth || out.contains(file.stem().string())) continue;
    const double multiplied = sensitivity(*problem);
    std::printf("%-32s %8.1e", file.stem().c_str(), multiplied);
    for (const auto& [integrator, tolerance] : {std::pair{"gauss8", 1e-6},
                                                {"gauss8", 1e-8},
                                                {"gauss16", 1e-6},
                                                {"gauss16", 1e-8},
                                                {"gauss16", 1e-10}}) {
      const SolveResult result = solve(*problem, {.integrator = integrator, .tolerance = tolerance});
      ASSERT_EQ(result.status, SolveStatus::Ok) << file;
      const double error = std::max(result.position_error.value_or(0), result.attitude_error.value_or(0));
      const double quotient = error / (tolerance * multiplied);
      // Half a turn is the greatest error of an attitude, whatever made it. Drag by v |v| has a kink where
      // the stone turns, which order 8 steps over (88 at 1e-8).
      const bool has_kink = file.stem() == "particle_quadratic_drag" && integrator == std::string{"gauss8"};
      if (error < 1 && !has_kink) {
        EXPECT_LE(quotient, 30) << file << ' ' << integrator << ' ' << tolerance;
      }
      std::printf(" %8.1e", quotient);
    }
    std::printf("\n");
    ++measured;
  }
  EXPECT_GE(measured, 25 / kEvery);
}

}  // namespace
}  // namespace pantin::test
