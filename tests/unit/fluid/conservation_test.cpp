#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/fluid/splash.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

// Force on the fluid and its moment about the origin, as everything outside the fluid states it.
struct Load {
  Wrench sum;
  double force_scale = 0, moment_scale = 0;  // what was added up, without cancellation

  void add(const Vector3d& force, const Vector3d& moment) {
    sum.force += force;
    sum.moment += moment;
    force_scale += force.norm();
    moment_scale += moment.norm();
  }
};

Load load_on_fluid(Splash& splash, const std::vector<double>& masses) {
  Load load;
  const Snapshot snapshot = splash.solver().snapshot();
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const Vector3d weight = masses[i] * splash.scene().setup.gravity;
    load.add(weight, Eigen::Map<const Vector3d>(&snapshot.position[3 * i]).cross(weight));
  }
  const Wrench walls = splash.solver().wall_wrench();
  load.add(-walls.force, -walls.moment);
  for (std::size_t b = 0; b < 2; ++b) {
    const Wrench& on_body = splash.solver().wrenches()[b];
    load.add(-on_body.force, -on_body.moment - splash.bodies()[b].position.cross(on_body.force));
  }
  return load;
}

// Every step: change of the fluid's momentum = dt/2 (load before + load after), since a step is kick, drift,
// kick. The load is stated by walls, bodies and gravity alone.
void expect_closed_balance(int dimension, double viscosity, int steps) {
  SCOPED_TRACE(testing::Message() << "dimension " << dimension << ", viscosity " << viscosity);
  Splash splash(dimension, viscosity, 1);
  const std::vector<double> masses = splash.scene().masses();
  double worst_linear = 0, worst_angular = 0;
  std::array<double, 3> largest{};  // force of walls and bodies: each must have taken part
  for (int k = 0; k < steps; ++k) {
    const Load before = load_on_fluid(splash, masses);
    const Diagnostics from = splash.solver().diagnostics();
    splash.step();
    const Load after = load_on_fluid(splash, masses);
    const Diagnostics to = splash.solver().diagnostics();
    const double half = 0.5 * splash.dt();
    const Vector3d linear = to.momentum - from.momentum - half * (before.sum.force + after.sum.force);
    const Vector3d angular =
        to.angular_momentum - from.angular_momentum - half * (before.sum.moment + after.sum.moment);
    worst_linear = std::max(worst_linear, linear.norm() / (half * (before.force_scale + after.force_scale)));
    worst_angular =
        std::max(worst_angular, angular.norm() / (half * (before.moment_scale + after.moment_scale)));
    largest[0] = std::max(largest[0], splash.solver().wall_wrench().force.norm());
    for (std::size_t b = 0; b < 2; ++b)
      largest[b + 1] = std::max(largest[b + 1], splash.solver().wrenches()[b].force.norm());
  }
  EXPECT_LT(worst_linear, 1e-10);
  EXPECT_LT(worst_angular, 1e-10);
  const double weight = 9.81 * std::accumulate(masses.begin(), masses.end(), 0.0);
  for (const double force : largest) EXPECT_GT(force, 0.05 * weight);
  EXPECT_LT(splash.solver().diagnostics().max_compression, 0.3);
}

TEST(Conservation, SplashInThePlane) {
  expect_closed_balance(2, 0.0, 400);
}
TEST(Conservation, ViscousSplashInThePlane) {
  expect_closed_balance(2, 20.0, 400);
}
TEST(Conservation, SplashInSpace) {
  expect_closed_balance(3, 0.0, 300);
}
TEST(Conservation, ViscousSplashInSpace) {
  expect_closed_balance(3, 20.0, 400);
}

// A free patch of water that turns about its centre and drifts, off the origin.
void expect_free_patch_keeps_momentum(int dimension, double viscosity, int cells, int steps) {
  SCOPED_TRACE(testing::Message() << "dimension " << dimension << ", viscosity " << viscosity);
  Scene scene(dimension, 1.0 / cells, 0.0, 7.0);
  scene.setup.liquid.viscosity = viscosity;
  const Vector3d half(0.5, 0.5, dimension == 3 ? 0.5 : 0.0), drift(0.2, -0.1, dimension == 3 ? 0.3 : 0.0);
  const Vector3d rate = dimension == 3 ? Vector3d(0.3, -0.2, 1.0) : Vector3d(0, 0, 1);
  for (const Vector3d& x : fill(BoxShape{half}, {0.1, 0.2, 0}, 1.0 / cells, dimension))
    scene.add_particle(x, drift + rate.cross(x), 0.0);
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const Diagnostics first = solver->diagnostics();
  for (int k = 0; k < steps; ++k) solver->step(solver->largest_step(1.5), {});
  const Diagnostics last = solver->diagnostics();
  const double scale = std::sqrt(2.0 * 1000.0 * first.kinetic);
  EXPECT_LT((last.momentum - first.momentum).norm() / scale, 1e-12);
  EXPECT_LT((last.angular_momentum - first.angular_momentum).norm() / first.angular_momentum.norm(), 1e-12);
  const Snapshot snapshot = solver->snapshot();
  double farthest = 0;  // the patch has really deformed: its corners have drawn out
  for (std::size_t i = 0; i < scene.setup.fluid.position.size(); ++i)
    farthest = std::max(
        farthest,
        (Eigen::Map<const Vector3d>(&snapshot.position[3 * i]) - scene.setup.fluid.position[i]).norm());
  EXPECT_GT(farthest, 0.2);
}

TEST(Conservation, TurningPatchInThePlane) {
  expect_free_patch_keeps_momentum(2, 0.0, 30, 400);
}
TEST(Conservation, ViscousTurningPatchInThePlane) {
  expect_free_patch_keeps_momentum(2, 5.0, 30, 400);
}
TEST(Conservation, TurningPatchInSpace) {
  expect_free_patch_keeps_momentum(3, 0.0, 10, 150);
}
TEST(Conservation, ViscousTurningPatchInSpace) {
  expect_free_patch_keeps_momentum(3, 5.0, 10, 150);
}

}  // namespace
}  // namespace sluice::fluid
