#include <gtest/gtest.h>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {
namespace {

using Overrides = std::vector<std::string>;

SceneRun floating_box(const Overrides& more) {
  Overrides overrides{"spacing=0.04", "duration=0.4", "body[0].position=[0.8, 0.9]"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return SceneRun(case_file("floating_body/floating_box.scene"), overrides);
}

// A motion that stands still is a lock, to the last bit, whatever the scheme.
TEST(PartlyFree, MotionAtRestIsALock) {
  for (const char* scheme : {"coupling.scheme=EXPLICIT", "coupling.scheme=IMPLICIT"}) {
    SceneRun locked = floating_box({scheme, "body[0].locked=[X_AXIS]", "body[0].locked_rotation=[Z_AXIS]"});
    SceneRun guided = floating_box({scheme, "body[0].prescribed={constant {}}", "body[0].free=[Y_AXIS]"});
    double lowest = 1e9;
    while (locked.next_step() && guided.next_step()) {
      ASSERT_EQ(locked.body(0).position, guided.body(0).position) << "at " << locked.time() << " s";
      ASSERT_EQ(locked.wrench(0).force, guided.wrench(0).force) << "at " << locked.time() << " s";
      lowest = std::min(lowest, guided.body(0).position.y());
    }
    EXPECT_LT(lowest, 0.9);
  }
}

// Towed along x it heaves and pitches; along x it is where the motion is.
TEST(PartlyFree, TowedBoxHeavesAndPitches) {
  SceneRun run =
      floating_box({"coupling.scheme=AUTO", "body[0].prescribed={ramp {offset: [0.2, 0] duration: 0.4}}",
                    "body[0].free=[Y_AXIS]", "body[0].free_rotation=[Z_AXIS]"});
  double pitch = 0, heave = 0;
  while (run.next_step()) {
    const double s = run.time() / 0.4;
    ASSERT_NEAR(run.body(0).position.x(), 0.8 + 0.2 * s * s * s * (10 - 15 * s + 6 * s * s), 1e-12);
    pitch = std::max(pitch, std::abs(run.body(0).orientation.z()));
    heave = std::max(heave, std::abs(run.body(0).position.y() - 0.9));
  }
  EXPECT_GT(pitch, 0.01);
  EXPECT_GT(heave, 0.01);
}

}  // namespace
}  // namespace sluice::validation
