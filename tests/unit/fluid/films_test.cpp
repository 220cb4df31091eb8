// What passes under a gate whose gap is too narrow for two rows of particles (films.hpp).
#include <gtest/gtest.h>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSpacing = 0.01, kThickness = 2 * kSpacing, kHeight = 0.3;
constexpr double kDeep = 0.3, kShallow = 0.12, kWidth = 0.2;  // of the pools on both sides

// Pools of water on both sides of a gate, x = 0 to 0.2 and 0.22 to 0.42, its foot on the floor.
Scene gate_between_pools() {
  Scene scene(2, kSpacing, 9.81, 24.0);
  scene.add_still_water({0, 0, 0}, {kWidth, kDeep, 0});
  scene.add_still_water({kWidth + kThickness, 0, 0}, {2 * kWidth + kThickness, kShallow, 0});
  scene.add_tank({0, 0, 0}, {2 * kWidth + kThickness, kHeight + 10 * kSpacing, 0});
  scene.add_body(BoxShape{{kThickness / 2, kHeight / 2, 0}});
  return scene;
}

Kinematics gate_at(double gap, double speed) {
  Kinematics gate;
  gate.position = {kWidth + kThickness / 2, gap + kHeight / 2, 0};
  gate.velocity = {0, speed, 0};
  return gate;
}

// Most particles within a spacing of one.
std::size_t largest_crowd(const Snapshot& snapshot) {
  const std::size_t n = snapshot.position.size() / 3;
  const auto at = [&](std::size_t i) { return Eigen::Map<const Eigen::Vector3d>(&snapshot.position[3 * i]); };
  std::size_t largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t crowd = 0;
    for (std::size_t j = 0; j < n; ++j) crowd += j != i && (at(i) - at(j)).norm() < kSpacing ? 1 : 0;
    largest = std::max(largest, crowd);
  }
  return largest;
}

// Particles beyond the gate.
std::size_t beyond(const Snapshot& snapshot) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < snapshot.position.size(); k += 3)
    count += snapshot.position[k] > kWidth + kThickness ? 1 : 0;
  return count;
}

// The gate moves from one gap to the other at `speed` [m/s].
Snapshot after_moving(double from, double to, double speed) {
  const Scene scene = gate_between_pools();
  const auto solver = make_solver(scene.setup);
  const Kinematics start = gate_at(from, speed);
  solver->start({&start, 1});
  const double dt = solver->largest_step(2.5), duration = (to - from) / speed;
  for (double time = dt; time < duration; time += dt) {
    const Kinematics gate = gate_at(from + time * speed, speed);
    solver->step(dt, {&gate, 1});
  }
  return solver->snapshot();
}

TEST(Films, LetTheWaterUnderAGateThatRisesSlowly) {
  const Snapshot end = after_moving(0.8 * kSpacing, 1.5 * kSpacing, 0.012);
  EXPECT_LE(largest_crowd(end), 8u);
  EXPECT_GT(beyond(end), static_cast<std::size_t>(kWidth * kShallow / (kSpacing * kSpacing) + 10));
}

TEST(Films, AreNotFilledByAGateThatComesDownSlowly) {
  const Snapshot end = after_moving(1.6 * kSpacing, 0.9 * kSpacing, -0.012);
  EXPECT_LE(largest_crowd(end), 8u);
}

}  // namespace
}  // namespace sluice::fluid
