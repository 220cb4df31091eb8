#include "benchmark/recording.hpp"

#include <gtest/gtest.h>

namespace sluice::benchmark {
namespace {

TEST(FrameCost, IsOfThePairs) {
  const FrameCost cost{.rate = 100,
                       .frames = 10,
                       .steps = 0,
                       .without = {1.0, 2.0, 1.0, 1.0, 1.0},
                       .with = {1.1, 2.0, 1.2, 1.3, 1.0}};
  const Share share = share_of(cost);
  EXPECT_NEAR(share.median, 0.1, 1e-12);
  EXPECT_NEAR(share.lower, 0.0, 1e-12);
  EXPECT_NEAR(share.upper, 0.2, 1e-12);
  EXPECT_NEAR(seconds_per_frame(cost), 0.01, 1e-12);
}

}  // namespace
}  // namespace sluice::benchmark
