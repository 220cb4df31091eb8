#include "fluid/background_cells.hpp"

#include <gtest/gtest.h>

#include "fluid/lattice.hpp"
#include "tests/unit/fluid/clouds.hpp"
#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

Scene with_cells(int dimension) {
  Scene scene(dimension, 0.1, 0.0, 20.0);
  scene.setup.formulation.quadrature = Quadrature::background_cells;
  scene.setup.formulation.artificial_viscosity = 0;
  scene.setup.formulation.density_diffusion = 0;
  return scene;
}

// Velocities after a tiny step, times mass over its length [N].
template <int Dim>
std::vector<Vec<Dim>> forces(const Scene& scene) {
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = 1e-7 * solver->largest_step(1.0);
  solver->step(dt, {});
  const Snapshot s = solver->snapshot();
  const std::vector<double> masses = scene.masses();
  std::vector<Vec<Dim>> force;
  for (std::size_t i = 0; i < masses.size(); ++i)
    force.push_back(masses[i] / dt * narrow<Dim>(Eigen::Map<const Vector3d>(&s.velocity[3 * i])));
  return force;
}

// CF (46) and (49) as they stand, over all points near a disordered block and all particles.
template <int Dim>
std::vector<Vec<Dim>> forces_by_definition(const Scene& scene) {
  const FluidParticles& fluid = scene.setup.fluid;
  const double dx = scene.setup.spacing, h = scene.setup.formulation.smoothing * dx, V = fluid.volume;
  const WendlandC2<Dim> kernel(h);
  const EquationOfState eos(scene.setup.liquid.density, scene.setup.liquid.sound_speed);
  const double floor = scene.setup.formulation.moment_floor * lattice_moment<Dim>(kernel, dx);
  std::vector<Vec<Dim>> force(fluid.position.size(), Vec<Dim>::Zero());
  std::mt19937_64 none;
  for (const Vec<Dim>& half : jittered_lattice<Dim>(Dim == 2 ? 24 : 18, dx / 2, 0, none)) {
    const Vec<Dim> x_q = half - Vec<Dim>::Constant(1.5 * dx);
    double weight = 0;
    Moments<Dim> moments;
    const auto away = [&](std::size_t i) { return Vec<Dim>(narrow<Dim>(fluid.position[i]) - x_q); };
    for (std::size_t i = 0; i < force.size(); ++i) {
      double share = V;
      for (int a = 0; a < Dim; ++a) share *= 0.5 * std::max(0.0, 1 - std::abs(away(i)[a]) / dx);
      weight += share;
      moments.add(V * kernel.value(away(i)), away(i));
    }
    if (weight == 0) continue;
    const Fit<Dim> f = fit(moments, floor);
    double rho = 0, mean = 0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      const double VW = V * kernel.value(away(i)), rho_i = eos.density(fluid.pressure[i]);
      rho += VW * (shape_constant(f) + f.g.dot(away(i))) * rho_i;
      mean += VW / moments.m0 * rho_i;
    }
    const double p = eos.pressure(f.floored ? mean : rho);
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] += weight * p * V * kernel.value(away(i)) * (f.g + f.G * away(i));
  }
  return force;
}

template <int Dim>
void expect_forces_by_definition() {
  Scene scene = with_cells(Dim);
  std::mt19937_64 random(5);
  for (const Vec<Dim>& x : jittered_lattice<Dim>(Dim == 2 ? 9 : 6, 0.1, 0.1, random))
    scene.add_particle(widen<Dim>(x), Vector3d::Zero(), 1000.0 * (2.0 + random_vector<Dim>(random)[0]));
  const std::vector<Vec<Dim>> force = forces<Dim>(scene), expected = forces_by_definition<Dim>(scene);
  double largest = 0, worst = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    largest = std::max(largest, expected[i].norm());
    worst = std::max(worst, (force[i] - expected[i]).norm());
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(worst, 1e-5 * largest);
}

TEST(BackgroundCells, ForcesAreThoseOfTheDefinitionInThePlane) {
  expect_forces_by_definition<2>();
}
TEST(BackgroundCells, ForcesAreThoseOfTheDefinitionInSpace) {
  expect_forces_by_definition<3>();
}

// The undisturbed lattice under pressure without ends is in equilibrium.
TEST(BackgroundCells, APeriodicLatticeUnderPressureIsAtRest) {
  Scene scene = with_cells(2);
  scene.setup.period.length = {1, 1, 0};
  for (const Vector3d& x : fill(BoxShape{{0.5, 0.5, 0}}, {0.5, 0.5, 0}, 0.1, 2))
    scene.add_particle(x, Vector3d::Zero(), 5000.0);
  for (const Vec<2>& force : forces<2>(scene)) EXPECT_LT(force.norm(), 1e-9 * 5000 * 0.1);
}

// Momentum closes across periodic sides, wherever particles and grid stand to each other.
TEST(BackgroundCells, ADisorderedPeriodicTankKeepsItsMomentum) {
  Scene scene = with_cells(2);
  scene.setup.period.length = {1, 1, 0};
  std::mt19937_64 random(3);
  for (const Vec<2>& x : jittered_lattice<2>(10, 0.1, 0.2, random))
    scene.add_particle(widen<2>(x), Vector3d::Zero(), 1000.0 * (2.0 + random_vector<2>(random)[0]));
  Vec<2> sum = Vec<2>::Zero();
  double scale = 0;
  for (const Vec<2>& force : forces<2>(scene)) {
    sum += force;
    scale += force.norm();
  }
  EXPECT_GT(scale, 0.0);
  EXPECT_LT(sum.norm(), 1e-10 * scale);
}

}  // namespace
}  // namespace sluice::fluid
