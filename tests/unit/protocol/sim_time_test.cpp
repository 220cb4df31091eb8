#include "protocol/sim_time.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice::protocol {
namespace {

TEST(StepClock, StartsAtZero) {
  EXPECT_EQ(StepClock(10'000'000, 7, 700).time(0), 0);
}

TEST(StepClock, FollowsTheFormulaOfTheMessages) {
  const StepClock clock(10'000'019, 7, 700);
  for (std::uint64_t k = 0; k <= clock.steps(); ++k) {
    const auto whole = static_cast<Nanoseconds>(k / 7);
    const auto part = static_cast<Nanoseconds>(k % 7);
    EXPECT_EQ(clock.time(k), whole * 10'000'019 + part * 10'000'019 / 7);
  }
}

// Any clock: instants increase strictly, outputs are exact, and durations differ by at most 1 ns.
RC_GTEST_PROP(StepClock, Identities, ()) {
  const auto interval = *rc::gen::inRange<Nanoseconds>(1, 100'000'000'000);
  const auto per_interval = static_cast<std::uint64_t>(*rc::gen::inRange<Nanoseconds>(1, interval + 1));
  const StepClock clock(interval, per_interval, 10 * per_interval);
  const auto step = *rc::gen::inRange<std::uint64_t>(1, clock.steps() + 1);
  const Nanoseconds shortest = interval / static_cast<Nanoseconds>(per_interval);
  RC_ASSERT(clock.time(step) > clock.time(step - 1));
  RC_ASSERT(clock.duration(step) == clock.time(step) - clock.time(step - 1));
  RC_ASSERT(clock.duration(step) >= shortest);
  RC_ASSERT(clock.duration(step) <= shortest + 1);
  const auto output = step / per_interval;
  RC_ASSERT(clock.is_output(output * per_interval));
  RC_ASSERT(clock.time(output * per_interval) == static_cast<Nanoseconds>(output) * interval);
}

// Any run: no step above the asked one, none needlessly short, the end reached and not passed by a step.
RC_GTEST_PROP(StepClock, ForRun, ()) {
  const double duration = *rc::gen::inRange(1, 100'000) * 1e-3;
  const double rate = *rc::gen::inRange(1, 1'000'000) * 1e-3;
  const double largest = *rc::gen::inRange(3'000, 1'000'000) * 1e-9;
  RC_PRE(1 / rate > 1e-5);
  const auto clock = StepClock::for_run(duration, rate, largest);
  for (const std::uint64_t step : {std::uint64_t{1}, clock.steps_per_interval(), clock.steps() / 2 + 1})
    RC_ASSERT(seconds(clock.duration(step)) <= largest);
  const double steps_needed = seconds(clock.interval()) / largest;
  RC_ASSERT(static_cast<double>(clock.steps_per_interval()) < steps_needed * 1.001 + 1);
  const double slack = 1e-9 * (duration * rate + 2);  // the interval is rounded to nanoseconds
  RC_ASSERT(seconds(clock.time(clock.steps())) >= duration - slack);
  RC_ASSERT(seconds(clock.time(clock.steps() - 1)) < duration);
}

TEST(StepClock, RunOfWholeIntervalsEndsWithAnOutput) {
  const auto clock = StepClock::for_run(1.0, 3.0, 1e-3);  // 1/3 s is no whole number of nanoseconds
  EXPECT_EQ(clock.interval(), 333'333'333);
  EXPECT_EQ(clock.steps(), 3 * clock.steps_per_interval());
  EXPECT_TRUE(clock.is_output(clock.steps()));
}

TEST(StepClock, RunThatEndsBetweenOutputsIsNotCutShort) {
  const auto clock = StepClock::for_run(0.25, 10, 1e-3);
  EXPECT_EQ(clock.steps(), 250U);
  EXPECT_EQ(clock.time(clock.steps()), 250'000'000);
}

TEST(StepClock, RefusesStepsBelowAMicrosecond) {
  EXPECT_NO_THROW(StepClock::for_run(1, 100, 1.001e-6));
  EXPECT_THROW(StepClock::for_run(1, 100, 0.999e-6), std::invalid_argument);
  EXPECT_THROW(StepClock::for_run(1, 2e6, 1), std::invalid_argument);
}

TEST(StepClock, RefusesWhatIsNoTime) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, 0.0, -1.0, 1e300}) {
    EXPECT_THROW(StepClock::for_run(bad, 100, 1e-4), std::invalid_argument) << bad;
    EXPECT_THROW(StepClock::for_run(1, bad, 1e-4), std::invalid_argument) << bad;
    EXPECT_THROW(StepClock::for_run(1, 100, bad), std::invalid_argument) << bad;
  }
}

TEST(StepClock, RefusesWhatAPeerMayNotSend) {
  const auto most = std::numeric_limits<std::uint64_t>::max();
  EXPECT_THROW(StepClock(0, 1, 1), std::invalid_argument);
  EXPECT_THROW(StepClock(-5, 1, 1), std::invalid_argument);
  EXPECT_THROW(StepClock(1000, 0, 1), std::invalid_argument);
  EXPECT_THROW(StepClock(1000, 1001, 1), std::invalid_argument);
  EXPECT_THROW(StepClock(1000, most, 1), std::invalid_argument);
  EXPECT_THROW(StepClock(1'000'000'000, 1, most), std::invalid_argument);
}

}  // namespace
}  // namespace sluice::protocol
