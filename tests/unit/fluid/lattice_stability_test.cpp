#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr int kCells = 24;

// Acceleration along a small wave of displacement of the lattice under uniform pressure, over displacement,
// pressure and square of the wave number [m^2/(kg/m^3)]-free: a ~ s k^2 p/rho u. Positive: it grows.
double growth(double smoothing, const Vector3d& wave, const Vector3d& direction) {
  const double dx = 1.0 / kCells, amplitude = 1e-4 * dx, pressure = 1000.0;
  Scene scene(2, dx, 0.0, 10.0);
  scene.setup.gravity.setZero();
  scene.setup.period.length = {1, 1, 0};
  scene.setup.formulation.smoothing = smoothing;
  const Vector3d k = 2.0 * std::numbers::pi * wave;
  std::vector<Vector3d> displacement;
  for (int b = 0; b < kCells; ++b)
    for (int a = 0; a < kCells; ++a) {
      const Vector3d x = dx * Vector3d(a + 0.5, b + 0.5, 0);
      displacement.push_back(amplitude * std::sin(k.dot(x)) * direction);
      scene.add_particle(x + displacement.back(), Vector3d::Zero(), pressure);
    }
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = 1e-6 * solver->largest_step(1.0);
  solver->step(dt, {});
  const Snapshot s = solver->snapshot();
  double along = 0, square = 0;
  for (std::size_t i = 0; i < displacement.size(); ++i) {
    along += Eigen::Map<const Vector3d>(&s.velocity[3 * i]).dot(displacement[i]) / dt;
    square += displacement[i].squaredNorm();
  }
  return along / square / (k.squaredNorm() * pressure / 1000.0);
}

// Waves across their direction, along rows and diagonals; those along it are sound and stable anyway.
double fastest_growth(double smoothing) {
  double fastest = -1e300;
  for (int m = 1; m <= 10; ++m)
    for (const int n : {0, m / 2, m}) {
      const Vector3d wave(n, m, 0);
      const Vector3d across = Vector3d(m, -n, 0).normalized();
      fastest = std::max(fastest, growth(smoothing, wave, across));
    }
  return fastest;
}

TEST(LatticeUnderPressure, IsStableAtTheDefaultSmoothing) {
  EXPECT_LT(fastest_growth(stable_smoothing(2)), 1e-6);
}

TEST(LatticeUnderPressure, IsNotBesideIt) {
  EXPECT_GT(fastest_growth(1.4), 1e-4);
  EXPECT_GT(fastest_growth(1.5), 1e-4);
}

}  // namespace
}  // namespace sluice::fluid
