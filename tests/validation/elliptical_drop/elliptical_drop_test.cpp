#include "validation/elliptical_drop/elliptical_drop.hpp"

#include <gtest/gtest.h>

namespace sluice::validation {
namespace {

// The bound that is stated for R/50 holds at R/25 already; without shifting at R/12.
TEST(EllipticalDrop, StretchesAsTheExactOne) {
  const Case drop = elliptical_drop();
  const Outcome coarse = drop.run(8, {}, 1), plain = drop.run(12, {"formulation.shifting=0"}, 1),
                fine = drop.run(25, {}, 1);
  for (const Outcome& outcome : {plain, fine}) {
    EXPECT_LE(outcome.figure("shorter semi-axis"), 0.5);
    EXPECT_LE(outcome.figure("longer semi-axis"), 0.5);
  }
  EXPECT_LT(fine.error, coarse.error);
}

}  // namespace
}  // namespace sluice::validation
