#include "validation/interfacial_wave/interfacial_wave.hpp"

#include <gtest/gtest.h>

namespace sluice::validation {
namespace {

constexpr const char* kLeft = "amplitude left after 2 periods";

// Six rows of the heavy liquid.
TEST(InterfacialWave, HasThePeriodOfTheory) {
  const Outcome two = interfacial_wave_2().run(20, {}, 1);
  EXPECT_LE(two.figure("period"), 1.5);  // measured 0.01
  EXPECT_GE(two.figure(kLeft), 80);      // 88
}

// Three rows.
TEST(InterfacialWave, HasThePeriodOfTheoryAtThousandToOne) {
  const Outcome thousand = interfacial_wave_1000().run(10, {}, 1);
  EXPECT_LE(thousand.figure("period"), 3);  // measured 1.9
  EXPECT_GE(thousand.figure(kLeft), 85);    // 90
}

}  // namespace
}  // namespace sluice::validation
