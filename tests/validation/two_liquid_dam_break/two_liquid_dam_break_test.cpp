#include "validation/two_liquid_dam_break/two_liquid_dam_break.hpp"

#include <gtest/gtest.h>

namespace sluice::validation {
namespace {

TEST(TwoLiquidDamBreak, ColumnsFallAlikeAndTheHeavyOneEndsBelow) {
  const TwoLiquidDamBreakRun run = run_two_liquid_dam_break(10, {}, 1);
  EXPECT_EQ(run.outcome.figure("particles lost"), 0);
  EXPECT_LE(run.outcome.figure("fronts apart"), 8);
  EXPECT_LE(run.outcome.figure("energy"), 0.1);
  EXPECT_LE(run.outcome.error, 0.2);
  EXPECT_GT(run.outcome.figure("light above heavy at the end"), 10);
  EXPECT_GT(run.light.x.back(), 3);
}

}  // namespace
}  // namespace sluice::validation
