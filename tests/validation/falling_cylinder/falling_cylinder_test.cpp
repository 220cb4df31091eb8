#include <gtest/gtest.h>

#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

// The half-buoyant cylinder falls in, comes up again and ends near the level of Archimedes: its centre in the
// surface that its own volume has raised. At half the scene's resolution.
TEST(FallingCylinder, EntersTheWaterAndFloats) {
  SceneRun run(shipped_scene("falling_cylinder"), {"spacing=0.011", "duration=2"});
  const double radius = 0.055, level = 0.396 + 0.5 * M_PI * radius * radius / 1.21;
  double deepest = 1, sum = 0;
  int count = 0;
  while (run.next_output()) {
    const double y = run.body(0).position.y();
    deepest = std::min(deepest, y);
    EXPECT_LT(y, 0.47);
    EXPECT_NEAR(run.body(0).position.x(), 0.605, 3 * radius);
    if (run.time() > 1.2) {
      sum += y;
      ++count;
    }
  }
  EXPECT_LT(deepest, level - radius);
  EXPECT_NEAR(sum / count, level, 0.35 * radius);
  std::printf("falling cylinder: mean level after 1.2 s %.4f m, Archimedes %.4f m\n", sum / count, level);
}

}  // namespace
}  // namespace sluice::validation
