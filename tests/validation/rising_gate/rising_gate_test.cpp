#include <gtest/gtest.h>

#include <cmath>

#include "validation/rising_gate/gate.hpp"
#include "validation/support/files.hpp"

namespace sluice::validation {
namespace {

// Geometry of rising_gate.scene [m].
constexpr Gate kGate{0.100, 0.104, 0.06};

double speed(const fluid::Snapshot& s, std::size_t i) {
  return std::hypot(s.velocity[3 * i], s.velocity[3 * i + 1]);
}

// Share of the kinetic energy within `reach` of the slit under the gate.
double share_near_slit(const fluid::Snapshot& s, double reach) {
  double near = 0, all = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    const double k = speed(s, i) * speed(s, i);
    all += k;
    if (std::hypot(s.position[3 * i] - kGate.left, s.position[3 * i + 1]) < reach) near += k;
  }
  return near / all;
}

// A gate that stays shut one side wet, the other dry: hydrostatic force, nothing through it. Then it opens:
// the water moves under it first. The gate is two spacings thick here, a third of two supports.
TEST(RisingGate, HoldsTheWaterUntilItOpens) {
  SceneRun run(shipped_scene("rising_gate"),
               {"spacing=0.002", "duration=0.14", "body[0].prescribed.constant.start=0.1"});
  const double hydrostatic = 0.5 * 1000 * 9.81 * 0.1 * 0.1;  // [N/m]
  while (run.time() < 0.1 - 1e-6 && run.next_output()) {
    ASSERT_EQ(kGate.leaked(run), 0) << "at " << run.time() << " s";
    EXPECT_LT(run.solver().diagnostics().max_speed, 0.02)
        << "water moves behind the shut gate at " << run.time();
    EXPECT_NEAR(run.wrench(0).force.x(), hydrostatic, 0.05 * hydrostatic) << "at " << run.time() << " s";
  }
  ASSERT_TRUE(run.next_output());
  EXPECT_GT(share_near_slit(run.solver().snapshot(), 0.04), 0.75);
  while (run.next_output()) ASSERT_EQ(kGate.leaked(run), 0) << "at " << run.time() << " s";
}

// The scene itself at half its resolution: nothing through the gate, and the front ahead of the gate, behind
// Ritter's.
TEST(RisingGate, LetsTheWaterOutUnderIt) {
  SceneRun run(shipped_scene("rising_gate"), {"spacing=0.002"});
  double previous = 0;
  while (run.next_output()) {
    const fluid::Snapshot s = run.solver().snapshot();
    ASSERT_EQ(kGate.leaked(run), 0) << "at " << run.time() << " s";
    double front = 0;
    for (std::size_t i = 0; i < s.density.size(); ++i) front = std::max(front, s.position[3 * i]);
    EXPECT_GT(front, previous - run.scene().spacing());
    EXPECT_LT(front, kGate.left + 2.0 * std::sqrt(9.81 * 0.1) * run.time() + run.scene().spacing());
    previous = front;
    if (front > 0.38) break;  // the far wall is next
  }
  EXPECT_GT(previous, 0.3);
}

}  // namespace
}  // namespace sluice::validation
