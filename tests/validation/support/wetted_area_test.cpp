#include "validation/support/wetted_area.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace sluice::validation {
namespace {

// A lattice of 40 x 20 cells of 0.01 m, elsewhere than at the origin.
TEST(WettedArea, OfALatticeIsThatOfItsCells) {
  std::vector<double> position, volume;
  for (int k = 0; k < 800; ++k) {
    position.insert(position.end(), {-3 + 0.01 * (k % 40), 5 + 0.01 * (k / 40), 0.0});
    volume.push_back(1e-4);
  }
  EXPECT_NEAR(wetted_area(position, volume, 0.01), 0.08, 0.01 * 0.08);
}

TEST(WettedArea, LeavesOutASingleParticle) {
  const std::vector<double> position{0, 0, 0}, volume{1e-4};
  EXPECT_EQ(wetted_area(position, volume, 0.01), 0);
}

}  // namespace
}  // namespace sluice::validation
