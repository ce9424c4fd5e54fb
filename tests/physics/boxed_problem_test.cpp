#include <pantin/physics/stops/boxed_problem.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pantin {
namespace {

/// A problem with W = A A^T of `rank` columns, and bounds of all sorts.
BoxedProblem random_problem(std::size_t size, std::size_t rank, std::mt19937_64& random) {
  std::normal_distribution<double> number;
  std::vector<double> A(size * rank);
  for (double& a : A) a = number(random);
  BoxedProblem problem;
  problem.reset(size);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      for (std::size_t k = 0; k < rank; ++k) problem.W(i, j) += A[i * rank + k] * A[j * rank + k];
    }
    for (std::size_t k = 0; k < rank; ++k) problem.b[i] += A[i * rank + k] * number(random) * 3;
    const double bound = std::abs(number(random));
    if (i % 4 == 0) problem.lower[i] = 0;
    if (i % 4 == 1) problem.upper[i] = 0;
    if (i % 4 == 2) problem.lower[i] = -bound, problem.upper[i] = bound;
  }
  return problem;
}

TEST(BoxedProblem, MeetsItsConditions) {
  // What makes an answer right is checked as it stands, for 300 problems of up to 40 unknowns: within bounds,
  // w = 0 between them, w of the right sign at them, to rounding of the sums.
  std::mt19937_64 random{3};
  for (int k = 0; k < 300; ++k) {
    const std::size_t size = 1 + static_cast<std::size_t>(k) % 40;
    BoxedProblem problem = random_problem(size, size + 3, random);
    ASSERT_TRUE(problem.solve()) << "problem " << k;
    for (std::size_t i = 0; i < size; ++i) {
      double w = problem.b[i], scale = std::abs(w);
      for (std::size_t j = 0; j < size; ++j) {
        w += problem.W(i, j) * problem.x[j];
        scale += std::abs(problem.W(i, j) * problem.x[j]);
      }
      const double slack = 1e-11 * scale, slack_x = slack / problem.W(i, i);
      EXPECT_GE(problem.x[i], problem.lower[i] - slack_x);
      EXPECT_LE(problem.x[i], problem.upper[i] + slack_x);
      const BoxedProblem::At at = problem.at[i];
      EXPECT_TRUE(at != BoxedProblem::At::Between || std::abs(w) <= slack) << w;
      EXPECT_TRUE(at != BoxedProblem::At::Lower || w >= -slack) << w;
      EXPECT_TRUE(at != BoxedProblem::At::Upper || w <= slack) << w;
    }
  }
}

TEST(BoxedProblem, SolvesRedundantRows) {
  // Two rows that are the same share what one would bear: w is zero, whichever way it is shared.
  BoxedProblem problem;
  problem.reset(2);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) problem.W(i, j) = 4;
    problem.b[i] = -8;
  }
  ASSERT_TRUE(problem.solve());
  EXPECT_NEAR(problem.x[0] + problem.x[1], 2, 1e-10);
}

TEST(BoxedProblem, EndsWithNumbersThatAreNone) {
  // A matrix that is not finite has no answer; it says so, and what it leaves is finite and within bounds.
  BoxedProblem problem;
  problem.reset(3);
  for (std::size_t i = 0; i < 3; ++i) problem.W(i, i) = std::numeric_limits<double>::quiet_NaN();
  problem.lower = {1, -1, -1};
  problem.upper = {2, 1, 1};
  EXPECT_FALSE(problem.solve());
  for (const double x : problem.x) EXPECT_TRUE(std::isfinite(x));
}

}  // namespace
}  // namespace pantin
