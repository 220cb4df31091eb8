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

// What shifting did within a step, along the radius and across it: the largest by distance from the centre.
struct Shift {
  double radial = 0, tangential = 0;
};
Shift largest_shift(const Eigen::Matrix3d& gradient, double from, double to) {
  const std::vector<double> plain = positions(0, gradient, 1), shifted = positions(6, gradient, 1);
  Shift largest;
  for (std::size_t i = 0; i < plain.size(); i += 3) {
    const Eigen::Map<const Vector3d> a(&plain[i]), b(&shifted[i]);
    if (a.norm() < from || a.norm() >= to) continue;
    const double radial = (b - a).dot(a.normalized());
    largest.radial = std::max(largest.radial, std::abs(radial));
    largest.tangential = std::max(largest.tangential, (b - a - radial * a.normalized()).norm());
  }
  return largest;
}

TEST(Shifting, MovesStrainedLiquidInside) {
  EXPECT_GT(largest_shift(strain(), 0.0, 0.3).radial, 1e-6);
}

// Its particles move along it, on a lattice's staircase.
TEST(Shifting, DoesNotMoveTheFreeSurface) {
  const Shift shift = largest_shift(strain(), 0.45, 1.0);
  std::printf("at the surface by %.2g across and %.2g along it\n", shift.radial, shift.tangential);
  EXPECT_LT(shift.radial, 0.3 * shift.tangential);
}

// Particles keep their velocity.
TEST(Shifting, KeepsMomentum) {
  Scene scene(2, 0.05, 0.0, 20.0);
  scene.setup.gravity.setZero();
  scene.setup.formulation.shifting = 6;
  for (const Vector3d& x : fill(BallShape{0.6}, Vector3d::Zero(), 0.05, 2))
    scene.add_particle(x + 0.005 * Vector3d(std::sin(91 * x.y()), std::sin(77 * x.x()), 0),
                       strain() * x + Vector3d(1, 2, 0), 0.0);
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const fluid::Diagnostics before = solver->diagnostics();
  for (int k = 0; k < 20; ++k) solver->step(solver->largest_step(3.0), {});
  EXPECT_LT((solver->diagnostics().momentum - before.momentum).norm(), 1e-12 * before.momentum.norm());
}

TEST(Shifting, LeavesRigidMotionAlone) {
  Eigen::Matrix3d turning = Eigen::Matrix3d::Zero();
  turning(0, 1) = -1;
  turning(1, 0) = 1;
  EXPECT_LT(largest_shift(turning, 0.0, 1.0).radial, 1e-3 * largest_shift(strain(), 0.0, 0.3).radial);
}

}  // namespace
}  // namespace sluice::fluid
