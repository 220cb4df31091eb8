#include <gtest/gtest.h>

#include "tests/unit/fluid/forced.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;
constexpr double kGravity = 9.81;

// Whether every particle is above the floor and between the sides, `width` apart.
bool all_inside(const Solver& solver, int dimension, const Vector3d& width) {
  const Snapshot s = solver.snapshot();
  for (std::size_t i = 0; i < s.id.size(); ++i) {
    const Eigen::Map<const Vector3d> x(&s.position[3 * i]);
    if (x.minCoeff() < 0 || (x - width).head(dimension - 1).maxCoeff() > 0) return false;
  }
  return true;
}

double energy(const Diagnostics& d) {
  return d.kinetic + d.potential + d.elastic;
}

// Largest rise of the energy above its least value so far.
class Ledger {
 public:
  explicit Ledger(const Solver& solver) : least_(energy(solver.diagnostics())) {}
  void look(const Solver& solver) {
    const double now = energy(solver.diagnostics());
    least_ = std::min(least_, now);
    rise_ = std::max(rise_, now - least_);
  }
  [[nodiscard]] double rise() const { return rise_; }

 private:
  double least_, rise_ = 0;
};

// A column falls into a tank twice as wide, rises at the far wall and comes back. `rise`: of its energy, of
// what the ledger rises by at most.
void expect_no_crossing(int dimension, double spacing, double duration, double rise) {
  const Vector3d tank = dimension == 2 ? Vector3d(1, 2, 0) : Vector3d(1, 0.4, 2);
  const Vector3d column = dimension == 2 ? Vector3d(0.5, 0.8, 0) : Vector3d(0.5, 0.4, 0.6);
  Scene scene = with_forces(dimension, spacing, kGravity, 40.0);
  scene.add_still_water({0, 0, 0}, column);
  scene.add_tank({0, 0, 0}, tank);
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double potential = solver->diagnostics().potential, dt = solver->largest_step(4.0);
  Ledger ledger(*solver);
  double farthest = 0;
  for (double t = 0; t < duration; t += dt) {
    solver->step(dt, {});
    ASSERT_TRUE(all_inside(*solver, dimension, tank)) << "at " << t << " s";
    ledger.look(*solver);
    const Snapshot s = solver->snapshot();
    for (std::size_t i = 0; i < s.id.size(); ++i) farthest = std::max(farthest, s.position[3 * i]);
  }
  EXPECT_GT(farthest, 0.9) << "it has not come to the far wall";
  EXPECT_LT(ledger.rise(), rise * potential);
}

TEST(BoundaryForces, NoParticleCrossesAWallInThePlane) {
  expect_no_crossing(2, 0.05, 1.2, 0.02);
}
TEST(BoundaryForces, NoParticleCrossesAWallInSpace) {
  expect_no_crossing(3, 0.1, 0.8, 0.05);
}

// The water boils (README.md, "Boundary forces"), but its weight is carried.
TEST(BoundaryForces, CarryTheWeightOfATankAtRest) {
  Scene scene = with_forces(2, 0.05, kGravity, 45.0);
  scene.add_still_water({0, 0, 0}, {2, 1, 0});
  scene.add_tank({0, 0, 0}, {2, 2, 0});
  scene.setup.measure_wall_force = true;
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const Diagnostics first = solver->diagnostics();
  const double dt = solver->largest_step(4.5);
  double impulse = 0, time = 0;
  for (; time < 1; time += dt) {
    solver->step(dt, {});
    impulse -= dt * solver->wall_wrench().force.y();
    ASSERT_TRUE(all_inside(*solver, 2, {2, 2, 0})) << "at " << time << " s";
  }
  EXPECT_NEAR(impulse / (kGravity * first.mass * time), 1, 0.01);
  EXPECT_LT(solver->diagnostics().kinetic / first.potential, 0.03);
}

// A drop that falls on a floor, without gravity: the walls do no work, and of its energy at the start the
// ledger's largest rise, and what is left when it has bounced.
struct Bounce {
  double rise, left;
};
Bounce bounce(bool on_receding) {
  Scene scene = with_forces(2, 0.05, 0.0, 45.0);
  scene.setup.formulation.force_on_receding = on_receding;
  for (const Vector3d& x : fill(BallShape{0.4}, {1, 0.6, 0}, 0.05, 2)) scene.add_particle(x, {0, -2.2, 0}, 0);
  scene.add_tank({0, 0, 0}, {2, 2, 0});
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double start = energy(solver->diagnostics()), dt = solver->largest_step(2.2);
  Ledger ledger(*solver);
  for (double time = 0; time < 0.25; time += dt) {
    solver->step(dt, {});
    ledger.look(*solver);
  }
  EXPECT_EQ(solver->diagnostics().boundary_work, 0);
  return {ledger.rise() / start, energy(solver->diagnostics()) / start};
}

TEST(BoundaryForces, TakeEnergyOutOfABounce) {
  const Bounce printed = bounce(false), both_ways = bounce(true);
  EXPECT_LT(printed.rise, 0.03);
  EXPECT_LT(printed.left, 0.9);
  EXPECT_GT(both_ways.left, printed.left);
}

}  // namespace
}  // namespace sluice::fluid
