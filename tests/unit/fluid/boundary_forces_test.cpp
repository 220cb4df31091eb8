#include "fluid/boundary_forces.hpp"

#include <gtest/gtest.h>

#include "fluid/lattice.hpp"
#include "tests/unit/fluid/clouds.hpp"
#include "tests/unit/fluid/forced.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;
constexpr double kGravity = 9.81;

// Velocities after a step [m/s], in the order of the setup.
std::vector<Vector3d> velocities_after(const Setup& setup, double dt) {
  const auto solver = make_solver(setup);
  solver->start({});
  solver->step(dt, {});
  const Snapshot s = solver->snapshot();
  std::vector<Vector3d> v;
  for (std::size_t i = 0; i < s.id.size(); ++i) v.emplace_back(&s.velocity[3 * i]);
  return v;
}

// Of one particle half a spacing above a floor [m/s^2].
double push_at_half_a_spacing(int dimension, double speed, bool on_receding) {
  Scene scene = with_forces(dimension, 0.1, 0.0, 20.0);
  scene.setup.formulation.force_on_receding = on_receding;
  scene.add_tank({0, 0, 0}, {2, 2, 2});
  // Above the middle of a boundary particle's cell.
  const double x = 1 + 0.1 / 6;
  const Vector3d at = dimension == 2 ? Vector3d(x, 0.05, 0) : Vector3d(x, x, 0.05);
  const Vector3d v = speed * Vector3d::Unit(dimension - 1);
  scene.add_particle(at, v, 0.0);
  const double dt = 1e-9;
  return (velocities_after(scene.setup, dt)[0] - v)[dimension - 1] / dt;
}

TEST(BoundaryForces, ArePressuresOfTheDefaultScaleHalfASpacingAway) {
  const double expected = 0.5 * 2.0 * 2.0 / 0.1;  // p dx^(Dim-1)/m = (c0/10)^2/(2 dx)
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    EXPECT_NEAR(push_at_half_a_spacing(dimension, -0.1, false) / expected, 1, 1e-6);
    EXPECT_NEAR(push_at_half_a_spacing(dimension, -0.1, true) / expected, 1, 1e-6);
    EXPECT_NEAR(push_at_half_a_spacing(dimension, 0.1, true) / expected, 1, 1e-6);
    EXPECT_NEAR(push_at_half_a_spacing(dimension, 0.1, false), 0, 1e-6);
  }
}

// A disordered block in the corner of a tank, its particles under way in all directions.
template <int Dim>
Scene block_in_a_corner() {
  Scene scene = with_forces(Dim, 0.1, 0.0, 20.0);
  std::mt19937_64 random(7);
  for (const Vec<Dim>& x : jittered_lattice<Dim>(Dim == 2 ? 8 : 5, 0.1, 0.1, random))
    scene.add_particle(widen<Dim>(x), widen<Dim>(random_vector<Dim>(random)), 0.0);
  scene.setup.fluid.volume *= 1.01;
  return scene;
}

// CF (94)-(95) and (111)-(113) as they stand, with A and v-hat of the present velocities; over A.
template <int Dim>
std::vector<Vec<Dim>> forces_by_definition(const Scene& scene, const Boundary& walls) {
  const FluidParticles& fluid = scene.setup.fluid;
  const double h = scene.setup.formulation.smoothing * scene.setup.spacing, r0 = 0.7 * h;
  const WendlandC2<Dim> kernel(h);
  const double floor =
      scene.setup.formulation.moment_floor * lattice_moment<Dim>(kernel, scene.setup.spacing);
  std::vector<Vec<Dim>> force(fluid.position.size(), Vec<Dim>::Zero());
  for (std::size_t j = 0; j < force.size(); ++j) {
    const auto away = [&](std::size_t i) { return narrow<Dim>(fluid.position[i] - fluid.position[j]); };
    Moments<Dim> moments;
    for (std::size_t i = 0; i < force.size(); ++i) moments.add(fluid.volume * kernel.value(away(i)), away(i));
    const Fit<Dim> f = fit(moments, floor);
    const auto N = [&](std::size_t i) {
      return fluid.volume * kernel.value(away(i)) * (shape_constant(f) + f.g.dot(away(i)));
    };
    Vec<Dim> v_hat = Vec<Dim>::Zero(), F = Vec<Dim>::Zero();
    for (std::size_t i = 0; i < force.size(); ++i) v_hat += N(i) * narrow<Dim>(fluid.velocity[i]);
    for (std::size_t k = 0; k < walls.position.size(); ++k) {
      const Vector3d x_k = walls.position[k] + walls.to_surface[k];
      const Vec<Dim> normal = narrow<Dim>(walls.to_surface[k]).normalized();
      const double r = (fluid.position[j] - x_k).norm();
      if (r < r0 && v_hat.dot(normal) < 0) F += (std::pow(r0 / r, 4) - std::pow(r0 / r, 2)) / r * normal;
    }
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += N(i) * F;
  }
  return force;
}

// Without walls the same block has all other forces.
template <int Dim>
void expect_forces_by_definition() {
  const Scene free = block_in_a_corner<Dim>();
  Scene scene = free;
  scene.add_tank({0, 0, 0}, {2, 2, 2});
  const double dt = 1e-7;
  const std::vector<Vector3d> with = velocities_after(scene.setup, dt),
                              without = velocities_after(free.setup, dt);
  const std::vector<Vec<Dim>> expected = forces_by_definition<Dim>(free, scene.setup.walls);
  double A = 0, largest = 0, worst = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double size = expected[i].norm();
    if (size > largest) A = narrow<Dim>(with[i] - without[i]).norm() / size;
    largest = std::max(largest, size);
  }
  for (std::size_t i = 0; i < expected.size(); ++i)
    worst = std::max(worst, (narrow<Dim>(with[i] - without[i]) - A * expected[i]).norm());
  EXPECT_GT(A, 0.0);
  EXPECT_LT(worst, 1e-5 * A * largest);
}

TEST(BoundaryForces, AreThoseOfTheDefinitionInThePlane) {
  expect_forces_by_definition<2>();
}
TEST(BoundaryForces, AreThoseOfTheDefinitionInSpace) {
  expect_forces_by_definition<3>();
}

// The rows of a tank without ends are alike, beside its periodic sides too.
TEST(BoundaryForces, KnowNoPlaceAlongAPeriodicFloor) {
  Scene scene = with_forces(2, 0.1, kGravity, 20.0);
  scene.add_block({0, 0, 0}, {1, 0.5, 0}, {0.3, -1, 0});
  Tank tank{{0, 0, 0}, {1, 1, 0}};
  tank.periodic[0] = true;
  scene.setup.period.length.x() = 1;
  scene.setup.walls = sample_wall_surface(tank, 0.1, scene.support() / 2, 2);
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = solver->largest_step(2.0);
  for (int k = 0; k < 20; ++k) solver->step(dt, {});
  const Snapshot s = solver->snapshot();
  double highest = 0;
  for (std::size_t i = 0; i < s.id.size(); ++i) {
    const std::size_t row = i / 10 * 10;
    EXPECT_NEAR(s.velocity[3 * i + 1], s.velocity[3 * row + 1], 1e-9);
    highest = std::max(highest, std::abs(s.velocity[3 * i + 1] + 1));
  }
  EXPECT_GT(highest, 0.5) << "the floor has stopped nothing";
}

}  // namespace
}  // namespace sluice::fluid
