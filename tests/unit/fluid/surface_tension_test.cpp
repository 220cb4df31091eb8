#include "fluid/surface_tension.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr double kTension = 50;  // [N/m]: of 1000 kg/m^3 and particles of 0.1 m, speeds of 0.7 m/s

// A crooked block of water in free flight, 12 particles long; corners are where tension acts most.
Scene make_block(int dimension) {
  Scene scene(dimension, 0.1, 0.0, 15.0);
  scene.setup.liquid.surface_tension = kTension;
  const Vector3d top = dimension == 2 ? Vector3d(1.2, 0.6, 0) : Vector3d(0.8, 0.6, 0.5);
  scene.add_block({0, 0, 0}, top, {0.1, -0.2, 0});
  for (Vector3d& x : scene.setup.fluid.position) x.y() += 0.03 * std::sin(7 * x.x()) + 0.1 * x.x() * x.y();
  return scene;
}

// A block thrown on a floor and a body that stands on it.
Scene make_throw(int dimension) {
  Scene scene(dimension, 0.1, 0.0, 15.0);
  scene.setup.liquid.surface_tension = kTension;
  scene.setup.measure_wall_force = true;
  const double depth = dimension == 2 ? 0.0 : 1.0;
  scene.add_tank({0, 0, 0}, {2, dimension == 2 ? 2.0 : 1.0, dimension == 2 ? 0.0 : 2.0});
  const double up = 0.55;
  scene.add_block({0.05, 0.05, dimension == 2 ? 0 : 0.05}, {0.85, up, depth > 0 ? up : 0}, {1, 0, 0});
  scene.add_body(BoxShape{dimension == 2 ? Vector3d(0.3, 0.4, 0) : Vector3d(0.3, 0.4, 0.4)});
  return scene;
}

std::vector<Kinematics> body(int dimension) {
  Kinematics k;
  k.position = dimension == 2 ? Vector3d(1.3, 0.4, 0) : Vector3d(1.3, 0.5, 0.4);
  return {k};
}

double energy(const Solver& solver) {
  const Diagnostics d = solver.diagnostics();
  return d.kinetic + d.elastic;
}

void expect_momentum_kept(int dimension, int steps) {
  const Scene scene = make_block(dimension);
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const Diagnostics from = solver->diagnostics();
  const double dt = 0.7 * solver->largest_step(2.0);
  for (int k = 0; k < steps; ++k) solver->step(dt, {});
  const Diagnostics to = solver->diagnostics();
  EXPECT_LT((to.momentum - from.momentum).norm(), 1e-12 * from.momentum.norm());
  EXPECT_LT((to.angular_momentum - from.angular_momentum).norm(), 1e-11 * from.angular_momentum.norm());
  EXPECT_LT(to.surface, 0.95 * from.surface);  // it did act
}

TEST(SurfaceTension, KeepsMomentumInThePlane) {
  expect_momentum_kept(2, 300);
}

TEST(SurfaceTension, KeepsMomentumInSpace) {
  expect_momentum_kept(3, 60);
}

// Without dissipation what the surface loses is found as motion and compression, up to the error of the
// step, which is of first order: half the step, half the error.
TEST(SurfaceTension, IsAnEnergy) {
  const auto error = [](double courant) {
    Scene scene = make_block(2);
    scene.setup.formulation.density_diffusion = scene.setup.formulation.artificial_viscosity = 0;
    const auto solver = make_solver(scene.setup);
    solver->start({});
    const double before = energy(*solver), surface = solver->diagnostics().surface;
    const double dt = courant * solver->largest_step(2.0), end = 0.05;  // [s]
    for (double t = 0; t < end; t += dt) solver->step(dt, {});
    return std::abs(energy(*solver) - before) / (surface - solver->diagnostics().surface);
  };
  const double coarse = error(0.5), fine = error(0.1);
  EXPECT_LT(fine, 0.02);
  EXPECT_LT(fine, 0.5 * coarse);
}

// Change of the fluid's momentum = dt/2 (load before + load after), stated by walls and body alone.
void expect_exact_reaction(int dimension, int steps) {
  const Scene scene = make_throw(dimension);
  const auto bodies = body(dimension);
  const auto solver = make_solver(scene.setup);
  solver->start(bodies);
  const double dt = 0.7 * solver->largest_step(5.0);
  const auto load = [&] { return Vector3d(-solver->wall_wrench().force - solver->wrenches()[0].force); };
  for (int k = 0; k < steps; ++k) {
    const Vector3d before = load(), from = solver->diagnostics().momentum;
    solver->step(dt, bodies);
    const Vector3d change = solver->diagnostics().momentum - from;
    ASSERT_LT((change - 0.5 * dt * (before + load())).norm(), 1e-12 * from.norm()) << "step " << k;
  }
  EXPECT_GT(solver->wrenches()[0].force.norm(), 1.0);
}

TEST(SurfaceTension, PullsAtWallsAndBodiesAsTheyAtTheLiquid) {
  expect_exact_reaction(2, 150);
  expect_exact_reaction(3, 40);
}

// The same bits with two threads, and after a restart in the middle.
TEST(SurfaceTension, IsExactlyRepeated) {
  Scene scene = make_throw(2);
  const auto bodies = body(2);
  const auto whole = make_solver(scene.setup);
  scene.setup.threads = 2;
  auto other = make_solver(scene.setup);
  whole->start(bodies);
  other->start(bodies);
  const double dt = 0.7 * whole->largest_step(5.0);
  for (int k = 0; k < 120; ++k) {
    if (k == 60) {
      std::vector<std::byte> state;
      whole->write_state(state);
      other = make_solver(scene.setup);
      other->read_state(state);
    }
    ASSERT_EQ(whole->snapshot().position, other->snapshot().position) << "step " << k;
    ASSERT_EQ(whole->diagnostics().surface, other->diagnostics().surface) << "step " << k;
    whole->step(dt, bodies);
    other->step(dt, bodies);
  }
}

TEST(SurfaceTension, LimitsTheStepByCapillaryWaves) {
  Scene scene = make_block(2);
  scene.setup.liquid.surface_tension = 1e6;
  const double h = scene.setup.formulation.smoothing * 0.1;
  EXPECT_DOUBLE_EQ(make_solver(scene.setup)->largest_step(0.0),
                   0.25 * std::sqrt(1000 * h * h * h / (2 * M_PI * 1e6)));
}

TEST(SurfaceTension, IsRefusedWhereItIsNotBuilt) {
  Scene plain = make_block(2);
  plain.setup.formulation.approximation = Approximation::sph;
  EXPECT_THROW((void)make_solver(plain.setup), std::invalid_argument);
  Scene negative = make_block(2);
  negative.setup.liquid.surface_tension = -1;
  EXPECT_THROW((void)make_solver(negative.setup), std::invalid_argument);
}

}  // namespace
}  // namespace sluice::fluid
