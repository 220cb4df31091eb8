#include <gtest/gtest.h>

#include <string>

#include "tests/stability/dam_break.hpp"

namespace sluice::fluid {
namespace {

// Mechanical energy over its running minimum, as a share of its start, at every step. Columns this coarse
// show up to 1.2 % when single particles rebound (a/dx = 8); at a/dx = 40 the bound is 0.1 %, and
// tests/validation/dam_break holds it.
constexpr double kEnergyRise = 0.015;

class Impact : public testing::TestWithParam<DamBreak> {};

// The wave meets the far wall, climbs it and falls back into the water, with spray all along.
TEST_P(Impact, StaysBounded) {
  const Extremes extremes = run(GetParam());
  RecordProperty("compression", std::to_string(extremes.compression));
  RecordProperty("energy_rise", std::to_string(extremes.energy_rise));
  RecordProperty("escape", std::to_string(extremes.escape));
  EXPECT_TRUE(extremes.finite);
  EXPECT_GT(extremes.farthest_x, 0.9);  // the impact has happened
  EXPECT_LT(extremes.compression, 0.3);
  EXPECT_LT(extremes.energy_rise, kEnergyRise);
  EXPECT_LT(extremes.escape, 0.5);
}

std::vector<DamBreak> planar_dams() {
  std::vector<DamBreak> dams;
  for (const int cells : {8, 12, 16, 20, 24})
    for (const double alpha : {0.02, 0.05}) dams.push_back({2, cells, alpha});
  return dams;
}

INSTANTIATE_TEST_SUITE_P(Planar, Impact, testing::ValuesIn(planar_dams()), testing::PrintToStringParamName());
INSTANTIATE_TEST_SUITE_P(Spatial, Impact, testing::Values(DamBreak{3, 6, 0.02}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace sluice::fluid
