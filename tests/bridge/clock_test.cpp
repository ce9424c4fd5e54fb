#include <pantin/bridge/clock.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "support/contracts.hpp"

namespace pantin {
namespace {

/// Takes all due updates and says when they ended.
std::vector<double> take(Clock& clock) {
  std::vector<double> ends;
  while (const std::optional<double> end = clock.next()) {
    clock.reached(*end);
    ends.push_back(*end);
  }
  return ends;
}

TEST(Clock, CarriesTheRestOver) {
  // 0.25 s steps: 0.6 s make two updates and leave 0.1 s, which the next 0.15 s fill up to a third.
  Clock clock{{.step = 0.25}};
  clock.add(0.6);
  EXPECT_EQ(take(clock), (std::vector<double>{0.25, 0.5}));
  EXPECT_NEAR(clock.rest(), 0.1, 1e-15);
  clock.add(0.15);
  EXPECT_EQ(take(clock), (std::vector<double>{0.75}));
  EXPECT_NEAR(clock.rest(), 0, 1e-15);
}

TEST(Clock, GrantsAStepThatRoundingHasKeptBack) {
  // Frames of 1/60 s are four steps of 1/240 s each time, though neither is a binary fraction; the time is a
  // count times the step and does not drift in an hour.
  Clock clock{{.step = 1.0 / 240}};
  for (int frame = 0; frame < 216'000; ++frame) {
    clock.add(1.0 / 60);
    ASSERT_EQ(take(clock).size(), 4U) << frame;
  }
  EXPECT_EQ(clock.time(), 864'000 * (1.0 / 240));
}

TEST(Clock, DropsWhatTheCapDoesNotAllowAndSaysSo) {
  // 10 updates of 0.1 s are due, 4 allowed: 0.6 s are dropped and the rest below a step stays.
  Clock clock{{.step = 0.1, .max_updates = 4}};
  clock.add(1.05);
  EXPECT_EQ(take(clock).size(), 4U);
  EXPECT_NEAR(clock.dropped(), 0.6, 1e-12);
  EXPECT_NEAR(clock.rest(), 0.05, 1e-12);
  EXPECT_NEAR(clock.time(), 0.4, 1e-15);
}

TEST(Clock, TellsHowFarOneUpdateMayGo) {
  // Three steps of 0.5 s are due with a landing at 0.7 s: two stops, then nothing; the grid and the rest are
  // those of single steps.
  Clock clock{{.step = 0.5}};
  clock.land_on(0.7);
  clock.add(1.6);
  ASSERT_EQ(clock.next_stop(), 0.7);
  clock.reached(0.7);
  ASSERT_EQ(clock.next_stop(), 1.5);
  clock.reached(1.5);
  EXPECT_FALSE(clock.next_stop());
  EXPECT_NEAR(clock.rest(), 0.1, 1e-15);
  clock.add(0.4);
  EXPECT_EQ(clock.next_stop(), 2.0);
}

TEST(Clock, LandsExactlyAndKeepsItsGrid) {
  // A landing between counts cuts the step in two; the counts stay multiples of the step.
  Clock clock{{.step = 0.5}};
  clock.land_on(0.7);
  clock.add(1.5);
  EXPECT_EQ(take(clock), (std::vector<double>{0.5, 0.7, 1.0, 1.5}));
}

TEST(Clock, LandsOnACountWithoutATinyStep) {
  // A landing within 1e-9 of a step of a count is that count: the update ends on the landing and counting
  // goes on.
  Clock clock{{.step = 0.1}};
  const double landing = std::nextafter(3 * 0.1, 1.0);
  clock.land_on(landing);
  clock.add(0.5);
  const std::vector<double> ends = take(clock);
  ASSERT_EQ(ends.size(), 5U);
  EXPECT_EQ(ends[2], landing);
  EXPECT_EQ(ends[3], 4 * 0.1);
}

TEST(Clock, LandsOnlyWithinWhatIsDue) {
  // A landing inside a step that is not due yet waits for it.
  Clock clock{{.step = 1}};
  clock.land_on(0.25);
  clock.add(0.5);
  EXPECT_FALSE(clock.next().has_value());
  clock.add(0.5);
  EXPECT_EQ(take(clock), (std::vector<double>{0.25, 1.0}));
}

TEST(Clock, AdvancesUntilATimeAndGoesOnFromThere) {
  // add_until shortens the last update; what elapses later counts from that time.
  Clock clock{{.step = 0.25}};
  clock.add(0.1);
  clock.add_until(0.6);
  EXPECT_EQ(take(clock), (std::vector<double>{0.25, 0.5, 0.6}));
  EXPECT_EQ(clock.rest(), 0);
  clock.add(0.14);
  EXPECT_FALSE(clock.next().has_value());
  EXPECT_NEAR(clock.rest(), 0.14, 1e-15);
  clock.add(0.01);
  EXPECT_EQ(take(clock), (std::vector<double>{0.75}));
}

TEST(Clock, AdvancesUntilTimesOffTheGridAgainAndAgain) {
  // Landing every 0.03 s on a grid of 0.1 s reaches each landing and each count exactly once.
  Clock clock{{.step = 0.1}};
  std::size_t updates = 0;
  for (int k = 1; k <= 100; ++k) {
    clock.add_until(0.03 * k);
    updates += take(clock).size();
    ASSERT_EQ(clock.time(), 0.03 * k);
  }
  EXPECT_EQ(updates, 100U + 30U - 10U);  // of 30 counts, 10 are multiples of 0.3 s, which are landings
}

TEST(Clock, CountsAfreshFromAnotherStep) {
  // A new step counts from the present time and keeps the rest.
  Clock clock{{.step = 0.4}};
  clock.add(0.9);
  take(clock);
  clock.set_step(0.25);
  EXPECT_NEAR(clock.rest(), 0.1, 1e-15);
  clock.add(0.15);
  EXPECT_EQ(take(clock), (std::vector<double>{0.8 + 0.25}));
}

TEST(Clock, RestartsFromATimeSetElsewhere) {
  // After a rewind the grid begins at that time, and landings that are past are forgotten.
  Clock clock{{.step = 0.5}, 2.0};
  clock.land_on(2.2);
  clock.restart(5.0);
  clock.add(0.5);
  EXPECT_EQ(take(clock), (std::vector<double>{5.5}));
}

TEST(Clock, RefusesSettingsAndTimesThatMeanNothing) {
  // One message per rule; the handler of the test turns broken contracts into exceptions.
  const test::ThrowOnContract guard;
  EXPECT_TRUE(problem_with(ClockSettings{.step = 0})->text.find("step is 0") != std::string::npos);
  EXPECT_TRUE(problem_with(ClockSettings{.max_updates = 0})->text.find("max_updates is 0") !=
              std::string::npos);
  EXPECT_FALSE(problem_with(ClockSettings{}).has_value());
  EXPECT_THROW(Clock{{.step = -1}}, test::ContractError);
  EXPECT_THROW((Clock{{}, NAN}), test::ContractError);
  Clock clock;
  EXPECT_THROW(clock.set_step(NAN), test::ContractError);
  EXPECT_THROW(clock.add(-1), test::ContractError);
  EXPECT_THROW(clock.add_until(-1), test::ContractError);
  EXPECT_THROW(clock.restart(INFINITY), test::ContractError);
}

}  // namespace
}  // namespace pantin
