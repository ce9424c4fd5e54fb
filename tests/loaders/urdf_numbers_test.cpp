#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pantin/bridge/loaders/urdf_numbers.hpp>

namespace pantin::urdf_loader {
namespace {

TEST(UrdfNumbers, AreReadToTheLastBit) {
  // C++ literals of the same digits are the correctly rounded doubles.
  EXPECT_EQ(parse_number("0.1"), 0.1);
  EXPECT_EQ(parse_number("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_number("+2"), 2.0);
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_EQ(parse_number("5."), 5.0);
  EXPECT_EQ(parse_number("3.141592653589793238"), 3.141592653589793238);
  EXPECT_EQ(parse_number("4.9e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_number("1e-400"), 0.0);
  EXPECT_TRUE(std::signbit(*parse_number("-0")));
}

TEST(UrdfNumbers, AreNothingElse) {
  // Each of these is read as a number, or half of one, by one usual function or another.
  for (const char* text :
       {"",    "nan", "inf", "-inf", "1e400", "-1e400",   "1,5",   "1.5kg", "0x10", "1 2", "--1",
        "+-1", "++1", "1e",  "e5",   "one",   "\xd9\xa1", "1_000", "1'000", " 1",   "1 "}) {
    EXPECT_FALSE(parse_number(text).has_value()) << text;
  }
}

TEST(UrdfNumbers, ReadBackWhatTheyWrite) {
  // The shortest text that is unique is read back as the same double: a round trip over odd and ordinary
  // values.
  for (const double value : {0.0, -0.0, 1.0 / 3, 1e300, 5e-324, 0.1 + 0.2, -123456.789, 6.02214076e23}) {
    const std::optional<double> back = parse_number(number_text(value));
    ASSERT_TRUE(back.has_value()) << number_text(value);
    EXPECT_EQ(std::signbit(*back), std::signbit(value));
    EXPECT_EQ(*back, value);
  }
}

}  // namespace
}  // namespace pantin::urdf_loader
