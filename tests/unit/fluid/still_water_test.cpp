#include <gtest/gtest.h>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;
constexpr double kGravity = 9.81;

// A tank of width and depth as given, filled to `cells` particles of depth.
Scene still_tank(int dimension, int cells, const Vector3d& water) {
  const double dx = water[dimension - 1] / cells;
  Scene scene(dimension, dx, kGravity, 10.0 * std::sqrt(2.0 * kGravity * water[dimension - 1]));
  scene.add_still_water({0, 0, 0}, water);
  Vector3d tank = water;
  tank[dimension - 1] += 10 * dx;
  scene.add_tank({0, 0, 0}, tank);
  scene.setup.measure_wall_force = true;
  return scene;
}

// Largest acceleration over g of particles deeper than `skip` spacings under the surface, from the velocity
// after one tiny step.
double start_acceleration(const Scene& scene, double surface, double skip) {
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = 1e-5 * solver->largest_step(1.0);
  solver->step(dt, {});
  const Snapshot snapshot = solver->snapshot();
  double largest = 0;
  const int up = scene.setup.dimension - 1;
  for (std::size_t i = 0; i < scene.setup.fluid.position.size(); ++i)
    if (scene.setup.fluid.position[i][up] < surface - skip * scene.setup.spacing)
      largest =
          std::max(largest, Eigen::Map<const Vector3d>(&snapshot.velocity[3 * i]).norm() / dt / kGravity);
  return largest;
}

TEST(StillWater, StartsAtRestInThePlane) {
  EXPECT_LT(start_acceleration(still_tank(2, 25, {2, 1, 0}), 1.0, 6.0), 1e-3);
}

TEST(StillWater, StartsAtRestInSpace) {
  EXPECT_LT(start_acceleration(still_tank(3, 10, {0.8, 0.7, 1.0}), 1.0, 6.0), 1e-3);
}

// The pressure that a shorter or longer start would have: the test above must be able to see it.
TEST(StillWater, AWrongPressureIsNotAtRest) {
  Scene scene = still_tank(2, 25, {2, 1, 0});
  for (double& p : scene.setup.fluid.pressure) p *= 0.99;
  EXPECT_GT(start_acceleration(scene, 1.0, 6.0), 5e-3);
}

// `settling`: largest kinetic over potential energy while the surface of the first lattice settles; it falls
// with the depth in particles.
void expect_rest(const Scene& scene, const Vector3d& water, int steps, double settling) {
  const int up = scene.setup.dimension - 1;
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double potential = solver->diagnostics().potential;
  const double dt = solver->largest_step(std::sqrt(2.0 * kGravity * water[up]));
  double kinetic = 0;
  for (int k = 0; k < steps; ++k) {
    solver->step(dt, {});
    kinetic = std::max(kinetic, solver->diagnostics().kinetic);
  }
  EXPECT_LT(kinetic / potential, settling);
  const Snapshot snapshot = solver->snapshot();
  double sum = 0, moved = 0, highest = 0;
  for (std::size_t i = 0; i < snapshot.density.size(); ++i) {
    const Eigen::Map<const Vector3d> x(&snapshot.position[3 * i]);
    const double error = snapshot.pressure[i] - 1000 * kGravity * (water[up] - x[up]);
    sum += error * error;
    moved = std::max(moved, (x - scene.setup.fluid.position[i]).norm());
    highest = std::max(highest, x[up]);
  }
  const double rms = std::sqrt(sum / static_cast<double>(snapshot.density.size()));
  EXPECT_LT(rms / (1000 * kGravity * water[up]), 0.01);
  EXPECT_LT(moved, 0.25 * scene.setup.spacing);
  EXPECT_NEAR(highest, water[up] - 0.5 * scene.setup.spacing, 0.2 * scene.setup.spacing);
  // The floor carries the weight.
  const double volume = scene.setup.dimension == 2 ? water.x() * water.y() : water.prod();
  EXPECT_NEAR(-solver->wall_wrench().force[up] / (1000 * kGravity * volume), 1.0, 0.02);
}

TEST(StillWater, StaysAtRestInThePlane) {
  const Vector3d water{2, 1, 0};
  expect_rest(still_tank(2, 20, water), water, 1000, 1.5e-6);
}

TEST(StillWater, StaysAtRestInSpace) {
  const Vector3d water{0.8, 0.8, 1.0};  // 8 x 8 x 10 particles
  expect_rest(still_tank(3, 10, water), water, 200, 5e-5);
}

}  // namespace
}  // namespace sluice::fluid
