#include "validation/channel_start_up/channel_start_up.hpp"

#include <gtest/gtest.h>

namespace sluice::validation {
namespace {

// At a quarter of the resolution that the bounds are stated for. Measured: 3.9 % and 0.05 %; the rest is room
// for another rounding of the same.
TEST(ChannelStartUp, PoiseuilleReachesTheParabola) {
  EXPECT_LE(poiseuille_start_up().run(12, {}, 1).figure("profile at t nu/H^2 = 0.5"), 5);
}

TEST(ChannelStartUp, CouetteReachesTheStraightLine) {
  const Outcome outcome = couette_start_up().run(12, {}, 1);
  EXPECT_LE(outcome.figure("profile at t nu/H^2 = 0.5"), 0.1);
  EXPECT_LE(outcome.figure("profile from t nu/H^2 = 0.1 on"), 2);
}

}  // namespace
}  // namespace sluice::validation
