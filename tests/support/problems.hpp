#pragma once
// What a problem_with must answer.
#include <optional>
#include <string_view>

#include <gtest/gtest.h>

#include <pantin/physics/problem.hpp>

namespace pantin::test {

/// One text of a problem_with, with its code; a remedy must be there.
inline void expect_problem(const std::optional<SettingsProblem>& problem, ProblemCode code,
                           std::string_view text) {
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->code, code);
  EXPECT_NE(problem->text.find(text), std::string::npos) << problem->text;
  EXPECT_FALSE(problem->remedy.empty());
}

}  // namespace pantin::test
