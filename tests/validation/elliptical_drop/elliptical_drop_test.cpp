#include "validation/elliptical_drop/elliptical_drop.hpp"

#include <gtest/gtest.h>

namespace sluice::validation {
namespace {

// The bound that is stated for R/50 holds at R/12 already.
TEST(EllipticalDrop, StretchesAsTheExactOne) {
  const Case drop = elliptical_drop();
  const Outcome coarse = drop.run(8, {}, 1), middle = drop.run(12, {}, 1), fine = drop.run(25, {}, 1);
  EXPECT_LE(middle.figure("shorter semi-axis"), 0.5);
  EXPECT_LE(middle.figure("longer semi-axis"), 0.5);
  EXPECT_LT(fine.error, coarse.error);
}

}  // namespace
}  // namespace sluice::validation
