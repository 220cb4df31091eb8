#include "fluid/parallel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace sluice::fluid {
namespace {

class Threads : public testing::TestWithParam<int> {
 protected:
  Parallel parallel_{GetParam()};
};

// Counts on both sides of the size of a task, 256.
TEST_P(Threads, VisitEveryIndexOnce) {
  for (const std::size_t count : {0, 1, 255, 256, 257, 1000, 100'000}) {
    std::vector<int> visits(count, 0);
    parallel_.for_each(count, [&](std::size_t i) { ++visits[i]; });
    for (const int n : visits) ASSERT_EQ(n, 1) << "of " << count;
  }
}

TEST_P(Threads, FindTheLargestWhereverItIs) {
  const std::size_t count = 5000;
  for (std::size_t where = 0; where < count; where += 499) {
    const auto value = [&](std::size_t i) { return i == where ? 7.0 : 1.0 / (1.0 + static_cast<double>(i)); };
    EXPECT_EQ(parallel_.max(count, value), 7.0) << "at " << where;
  }
  EXPECT_EQ(parallel_.max(count, [](std::size_t) { return -1.0; }), 0.0);
  EXPECT_EQ(parallel_.max(0, [](std::size_t) { return 1.0; }), 0.0);
}

// A particle that is lost must not hide behind the others.
TEST_P(Threads, NotANumberIsTheLargestOfAll) {
  const std::size_t count = 5000;
  for (std::size_t where = 0; where < count; where += 499) {
    const auto value = [&](std::size_t i) {
      return i == where ? std::numeric_limits<double>::quiet_NaN() : 1.0;
    };
    ASSERT_TRUE(std::isnan(parallel_.max(count, value))) << "at " << where;
  }
}

INSTANTIATE_TEST_SUITE_P(Parallel, Threads, testing::Values(1, 2, 3));

}  // namespace
}  // namespace sluice::fluid
