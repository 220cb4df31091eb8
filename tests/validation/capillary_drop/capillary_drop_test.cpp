#include "validation/capillary_drop/capillary_drop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

TEST(CapillaryDrop, HasLaplacesPressureAtRest) {
  const Outcome drop = still_drop().run(10, {}, 1);
  EXPECT_LE(drop.figure("pressure inside"), 10);
  EXPECT_LE(drop.figure("kinetic energy"), 0.1);
}

TEST(CapillaryDrop, OscillatesWithRayleighsPeriod) {
  const Outcome drop = oscillating_drop().run(10, {}, 1);
  EXPECT_LE(drop.figure("period"), 10);
  EXPECT_LE(drop.figure("energy rises by"), 1);
}

// Without tension there is no oscillation at all, and the corners stay.
TEST(CapillaryDrop, RoundsASquareAndKeepsItsMomentum) {
  const auto farthest = [](const SceneRun& run) {  // from the middle, over the radius of the disc
    const fluid::Snapshot s = run.solver().snapshot();
    double most = 0;
    for (std::size_t i = 0; i < s.density.size(); ++i)
      most = std::max(most, std::hypot(s.position[3 * i], s.position[3 * i + 1]));
    return most / std::sqrt(4e-4 / M_PI);
  };
  SceneRun drop(case_file("capillary_drop/square_drop.scene"));
  const double corner = farthest(drop);
  double momentum = 0;  // over mass and capillary speed
  while (drop.next_step())
    momentum = std::max(momentum, drop.solver().diagnostics().momentum.norm() / (1000 * 4e-4 * 0.08));
  EXPECT_GT(corner, 1.15);
  EXPECT_LT(farthest(drop), 1.04);
  EXPECT_LT(momentum, 1e-12);
}

}  // namespace
}  // namespace sluice::validation
