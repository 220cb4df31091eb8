#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;
using Field = std::function<Vector3d(const Vector3d&)>;

// A block of water with a field of velocities, far from everything, and where its particles move at first.
struct Start {
  std::vector<Vector3d> given, moving, parameter;  // [m/s]
};

Start start(int dimension, const Field& field, double interpolated, bool initial_parameters) {
  Scene scene(dimension, 0.1, 0.0, 20.0);
  scene.setup.gravity.setZero();
  scene.setup.formulation.interpolated_motion = interpolated;
  scene.setup.formulation.initial_parameters = initial_parameters;
  const Vector3d size(1.2, 1.1, dimension == 3 ? 1.0 : 0.0);
  for (const Vector3d& x : fill(BoxShape{size / 2}, {0.1, 0.2, 0}, 0.1, dimension))
    scene.add_particle(x, field(x), 0.0);
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const Snapshot before = solver->snapshot();
  const double dt = 1e-4 * solver->largest_step(1.0);
  solver->step(dt, {});
  const Snapshot after = solver->snapshot();
  Start result;
  for (std::size_t i = 0; i < scene.setup.fluid.position.size(); ++i) {
    const auto at = [i](const std::vector<double>& v) {
      return Vector3d(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
    };
    result.given.push_back(scene.setup.fluid.velocity[i]);
    result.moving.push_back((at(after.position) - at(before.position)) / dt);
    result.parameter.push_back(at(before.velocity));
  }
  return result;
}

double largest_difference(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

Vector3d linear(const Vector3d& x) {
  return {1.0 + 0.5 * x.y(), -0.3 * x.x() + 0.2 * x.y(), 0};
}
Vector3d wavy(const Vector3d& x) {
  return {std::sin(4.0 * x.y()), std::cos(3.0 * x.x()), 0};
}

// sum N_j x_j = x: what is linear is interpolated as it is, CF (101), but at the edges of the block, whose
// fits are floored.
TEST(InterpolatedMotion, LinearVelocitiesMoveParticlesAsTheyAre) {
  for (const int dimension : {2, 3}) {
    const Start s = start(dimension, linear, 1.0, false);
    int missed = 0;
    for (std::size_t i = 0; i < s.given.size(); ++i) missed += (s.moving[i] - s.given[i]).norm() > 1e-7;
    EXPECT_LE(missed, dimension == 2 ? 4 : 4 * (12 + 11 + 10) - 16);
  }
}

TEST(InterpolatedMotion, OthersAreSmoothed) {
  const Start full = start(2, wavy, 1.0, false), half = start(2, wavy, 0.5, false);
  const double smoothed = largest_difference(full.moving, full.given);
  EXPECT_GT(smoothed, 1e-2);
  EXPECT_NEAR(largest_difference(half.moving, half.given), 0.5 * smoothed, 1e-3 * smoothed);
}

// CF (99): with the parameters found the particles move with the velocities given.
TEST(InterpolatedMotion, InitialParametersInterpolateToTheGivenVelocities) {
  for (const int dimension : {2, 3}) {
    const Start s = start(dimension, wavy, 1.0, true);
    EXPECT_LT(largest_difference(s.moving, s.given), 1e-4);
    EXPECT_GT(largest_difference(s.parameter, s.given), 1e-2);
  }
}

// Velocities that alternate from particle to particle in space would need parameters forty times as large.
TEST(InterpolatedMotion, VelocitiesThatJumpEverywhereAreRefused) {
  const Field alternating = [](const Vector3d& x) {
    const Vector3d cell = (x / 0.1 + Vector3d::Constant(0.25)).array().floor();
    return Vector3d(std::lround(cell.sum()) % 2 == 0 ? 1.0 : -1.0, 0, 0);
  };
  EXPECT_THROW(start(3, alternating, 1.0, true), std::invalid_argument);
}

}  // namespace
}  // namespace sluice::fluid
