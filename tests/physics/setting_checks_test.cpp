#include <pantin/physics/setting_checks.hpp>

#include <limits>

#include <gtest/gtest.h>

namespace pantin {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr SettingName kName{"spring", "stiffness", "N/m"};

TEST(SettingChecks, WriteNumbersSoThatTheyReadBack) {
  // 0.1 has no shorter decimal; 1/3 needs all its digits.
  EXPECT_EQ(text_of(0.1), "0.1");
  EXPECT_EQ(std::stod(text_of(1.0 / 3)), 1.0 / 3);
  EXPECT_EQ(text_of(-2e300), "-2e+300");
  EXPECT_EQ(text_of(Vector3{1, -2, 0.5}), "(1, -2, 0.5)");
  EXPECT_EQ(text_of(Matrix3{Matrix3::Identity()}), "[(1, 0, 0), (0, 1, 0), (0, 0, 1)]");
}

TEST(SettingChecks, PassWhatHolds) {
  // Bounds are inclusive where the rule says "zero or more".
  EXPECT_FALSE(must_be_finite(kName, -1e308));
  EXPECT_FALSE(must_be_finite(kName, Vector3{1, 2, 3}));
  EXPECT_FALSE(must_not_be_negative(kName, 0));
  EXPECT_FALSE(must_be_positive(kName, 5e-324));
  EXPECT_FALSE(must_be_unit(kName, Quaternion{0.6, 0, 0.8, 0}));
  EXPECT_FALSE(must_be_unit(kName, Vector3{0.6, 0, 0.8}));
}

TEST(SettingChecks, NameSubjectValueUnitAndRule) {
  // The text says all that is needed to find the place, the remedy what to give.
  const std::optional<SettingsProblem> problem = must_not_be_negative(kName, -3);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->code, ProblemCode::OutOfRange);
  EXPECT_EQ(problem->text, "spring: stiffness is -3 N/m; it must be zero or more");
  EXPECT_EQ(problem->remedy, "give a stiffness that is zero or more");
  EXPECT_EQ(must_be_positive({"ball", "count", ""}, 0)->text, "ball: count is 0; it must be more than zero");
}

TEST(SettingChecks, FindNaNBeforeTheyCompare) {
  // NaN < 0 is false; the code must say NotFinite all the same.
  EXPECT_EQ(must_not_be_negative(kName, kNaN)->code, ProblemCode::NotFinite);
  EXPECT_EQ(must_be_positive(kName, kNaN)->code, ProblemCode::NotFinite);
  EXPECT_EQ(must_be_finite(kName, Vector3{0, kNaN, 0})->code, ProblemCode::NotFinite);
  EXPECT_EQ(must_be_unit(kName, Quaternion{kNaN, 0, 0, 0})->code, ProblemCode::NotFinite);
  EXPECT_EQ(must_be_unit(kName, Quaternion{2, 0, 0, 0})->code, ProblemCode::NotUnit);
  EXPECT_EQ(must_be_unit(kName, Vector3{kNaN, 0, 0})->code, ProblemCode::NotFinite);
  EXPECT_EQ(must_be_unit(kName, Vector3{1, 1, 0})->code, ProblemCode::NotUnit);
}

TEST(SettingChecks, GiveTheFirstProblemOfAList) {
  // Order of the list is the order of importance.
  const std::optional<SettingsProblem> problem =
      first_problem({must_be_positive(kName, 1), must_be_positive(kName, -1), must_be_positive(kName, -2)});
  ASSERT_TRUE(problem);
  EXPECT_NE(problem->text.find("-1"), std::string::npos);
  EXPECT_FALSE(first_problem({must_be_positive(kName, 1)}));
}

}  // namespace
}  // namespace pantin
