#include "validation/standing_wave/standing_wave.hpp"

#include <gtest/gtest.h>

namespace sluice::validation {
namespace {

// Measured 13, 4.4 and 1.9 % of the amplitude lost.
TEST(StandingWave, ConvergesToTheory) {
  const Case wave = standing_wave();
  const Outcome coarse = wave.run(8, {}, 1), middle = wave.run(12, {}, 1), fine = wave.run(16, {}, 1);
  EXPECT_LT(middle.error, coarse.error);
  EXPECT_LT(fine.error, middle.error);
  EXPECT_GE(observed_order(8, coarse.error, 16, fine.error), 1.0);
  EXPECT_LE(fine.figure("period"), 0.8);  // measured 0.13 % at H/16, 0.6 % at H/12
}

// Not before H/50 is the scheme's own dissipation small beside the viscosity, but it is felt.
TEST(StandingWave, DecaysFasterWithViscosity) {
  const Outcome viscous = viscous_standing_wave().run(12, {}, 1), inviscid = standing_wave().run(12, {}, 1);
  const char* left = "amplitude left after 5 periods";
  EXPECT_LT(viscous.figure(left), inviscid.figure(left) - 2);
  EXPECT_LE(viscous.figure("period"), 1.2);
}

}  // namespace
}  // namespace sluice::validation
