#include "fluid/shifting.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

// A disc of liquid at rest, or turning, or strained, whose lattice is disturbed; positions after a number of
// steps.
std::vector<double> positions(double shifting, const Eigen::Matrix3d& gradient, int steps) {
  Scene scene(2, 0.05, 0.0, 20.0);
  scene.setup.gravity.setZero();
  scene.setup.formulation.shifting = shifting;
  for (const Vector3d& x : fill(BallShape{0.6}, Vector3d::Zero(), 0.05, 2)) {
    const Vector3d moved = x + 0.005 * Vector3d(std::sin(91 * x.y()), std::sin(77 * x.x()), 0);
    scene.add_particle(moved, gradient * moved, 0.0);
  }
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = solver->largest_step(1.0);
  for (int k = 0; k < steps; ++k) solver->step(dt, {});
  return solver->snapshot().position;
}

Eigen::Matrix3d strain() {
  return Vector3d(1, -1, 0).asDiagonal();
}

// By distance from the centre: what shifting did within a step.
double largest_shift(const Eigen::Matrix3d& gradient, double from, double to) {
  const std::vector<double> plain = positions(0, gradient, 1), shifted = positions(6, gradient, 1);
  double largest = 0;
  for (std::size_t i = 0; i < plain.size(); i += 3) {
    const Eigen::Map<const Vector3d> a(&plain[i]), b(&shifted[i]);
    if (a.norm() >= from && a.norm() < to) largest = std::max(largest, (a - b).norm());
  }
  return largest;
}

TEST(Shifting, MovesStrainedLiquidInside) {
  EXPECT_GT(largest_shift(strain(), 0.0, 0.3), 1e-6);
}

TEST(Shifting, NeverMovesTheFreeSurface) {
  EXPECT_EQ(largest_shift(strain(), 0.5, 1.0), 0.0);
}

TEST(Shifting, LeavesRigidMotionAlone) {
  Eigen::Matrix3d turning = Eigen::Matrix3d::Zero();
  turning(0, 1) = -1;
  turning(1, 0) = 1;
  EXPECT_LT(largest_shift(turning, 0.0, 1.0), 1e-3 * largest_shift(strain(), 0.0, 0.3));
}

}  // namespace
}  // namespace sluice::fluid
