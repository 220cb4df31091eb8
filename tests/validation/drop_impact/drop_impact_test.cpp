#include "validation/drop_impact/drop_impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace sluice::validation {
namespace {

constexpr const char* kViscosities[] = {"0.5", "0.500001", "0.500002", "0.500003", "0.500004"};

double median(const std::vector<Outcome>& runs, const std::string& figure) {
  std::vector<double> values;
  for (const Outcome& run : runs) values.push_back(run.figure(figure));
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// To the time of the paper's figure 8, where it shows the particles of the crater undisturbed. Rounding grows
// at the crater's rim, where single particles come off: of 25 runs whose viscosities differ in the sixth
// digit, eight gain 0.0003 to 0.24 % of their energy by it and the others less than 10^-6 %. So it is the
// median that is judged.
TEST(DropImpact, StaysSymmetricAndKeepsVolumeAndEnergy) {
  std::vector<Outcome> runs;
  for (const std::string viscosity : kViscosities)
    runs.push_back(drop_impact().run(10, {"duration=0.0396", "liquid.viscosity=" + viscosity}, 1));
  EXPECT_LE(median(runs, "asymmetry"), 4);  // a pair of particles is 2.5 %
  EXPECT_LE(median(runs, "volume"), 0.3);
  EXPECT_LE(median(runs, "energy"), 0.01);
}

}  // namespace
}  // namespace sluice::validation
