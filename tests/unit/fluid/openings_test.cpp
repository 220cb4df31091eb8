#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/fluid/streams.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

std::unique_ptr<Solver> run(const Setup& setup, double duration, double max_speed) {
  auto solver = make_solver(setup);
  solver->start({});
  const double dt = solver->largest_step(max_speed);
  for (double t = 0; t < duration; t += dt) solver->step(dt, {});
  return solver;
}

Vector3d vector(const std::vector<double>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

double largest_deviation(const Snapshot& state, const Vector3d& velocity) {
  double most = 0;
  for (std::size_t i = 0; i < state.density.size(); ++i)
    most = std::max(most, (vector(state.velocity, i) - velocity).norm());
  return most;
}

double energy(const Diagnostics& d) {
  return d.kinetic + d.potential + d.elastic - d.boundary_work;
}

double net_inflow(const Diagnostics& d) {
  double mass = 0;
  for (const Passage& passage : d.openings) mass += passage.mass_in - passage.mass_out;
  return mass;
}

// Liquid that comes in as a lattice and leaves as one: nothing in between may notice.
void expect_uniform(int dimension, const Vector3d& size, double duration) {
  const fluid::Setup setup = Stream::closed(dimension, size).setup;
  auto start = make_solver(setup);
  start->start({});
  const auto end = run(setup, duration, Stream::kSpeed);
  const Diagnostics before = start->diagnostics(), after = end->diagnostics();
  EXPECT_LT(largest_deviation(end->snapshot(), {Stream::kSpeed, 0, 0}), 1e-12 * Stream::kSpeed);
  EXPECT_LT(after.max_compression, 1e-12);
  EXPECT_NEAR(after.mass - before.mass, net_inflow(after), 1e-12 * before.mass);
  EXPECT_NEAR(energy(after), energy(before), 1e-12 * before.kinetic);
  EXPECT_GT(after.openings[1].mass_out, 1.2 * before.mass) << "the tank was not filled anew";
}

TEST(Openings, AUniformStreamStaysUniformInThePlane) {
  expect_uniform(2, {2, 1, 0}, 2.6);
}

TEST(Openings, AUniformStreamStaysUniformInSpace) {
  expect_uniform(3, {1, 0.5, 0.6}, 1.3);
}

TEST(Openings, AUniformStreamStaysUniformBetweenMirrors) {
  fluid::Setup setup = Stream::closed(2, {2, 1, 0}).setup;
  setup.mirrors = {Vector3d(0, 0, 0), Vector3d(2, 1, 0), {false, false, true, true, false, false}};
  setup.walls = {};
  const auto end = run(setup, 2.6, Stream::kSpeed);
  EXPECT_LT(largest_deviation(end->snapshot(), {Stream::kSpeed, 0, 0}), 1e-12 * Stream::kSpeed);
}

// A tank that starts without liquid: the viscous stress is there all the same once some has come in.
TEST(Openings, AViscousStreamComesIntoAnEmptyTank) {
  fluid::Setup setup = Stream::closed(2, {2, 1, 0}).setup;
  setup.fluid.position.clear();
  setup.fluid.velocity.clear();
  setup.fluid.pressure.clear();
  setup.liquid.viscosity = 1;
  const auto end = run(setup, 1.0, Stream::kSpeed);
  const Diagnostics after = end->diagnostics();
  EXPECT_NEAR(after.mass, net_inflow(after), 1e-12 * after.mass);
  EXPECT_NEAR(after.mass, 1000 * Stream::kSpeed * 1.0, 0.1 * after.mass);
}

// A gust in the stream leaves through the outflow; energy goes down by what dissipation takes, of the gust's.
TEST(Openings, LetADisturbanceOut) {
  fluid::Setup setup = Stream::closed(2, {2, 1, 0}).setup;
  for (std::size_t i = 0; i < setup.fluid.position.size(); ++i)
    setup.fluid.velocity[i].x() +=
        0.3 * std::exp(-30 * (setup.fluid.position[i] - Vector3d(1, 0.5, 0)).squaredNorm());
  const auto first = run(setup, 0.01, 1.5), last = run(setup, 10, 1.5);
  EXPECT_GT(largest_deviation(first->snapshot(), {1, 0, 0}), 0.2);
  EXPECT_LT(largest_deviation(last->snapshot(), {1, 0, 0}), 0.02);
  const Diagnostics before = first->diagnostics(), after = last->diagnostics();
  EXPECT_NEAR(after.mass - before.mass, net_inflow(after) - net_inflow(before), 1e-11 * before.mass);
  EXPECT_NEAR(energy(after), energy(before), 0.01 * before.kinetic);
}

// Twice the critical speed: nothing of the outflow is felt upstream, what comes in decides.
TEST(Openings, AStreamAboveTheCriticalSpeedKeepsItsDepth) {
  const double speed = 2 * std::sqrt(9.81);
  Stream stream = Stream::open(2, {3, 1.4, 0}, 1.0, speed);
  stream.inflow().speed = [speed](double, const Vector3d&) { return speed; };
  stream.inflow().level = [](double) { return 1.0; };
  stream.close();
  const auto end = run(stream.setup, 1.0, speed + 3);
  const Snapshot state = end->snapshot();
  EXPECT_LT(largest_deviation(state, {speed, 0, 0}), 2e-3 * speed);
  for (std::size_t i = 0; i < state.density.size(); ++i)
    EXPECT_LT(state.position[3 * i + 1], 1.0 - 0.45 * Stream::kSpacing);
  const Diagnostics d = end->diagnostics();
  EXPECT_NEAR(energy(d), energy(run(stream.setup, 0, speed + 3)->diagnostics()), 1e-3 * d.kinetic);
}

double volume_at_level(double depth, double duration, Diagnostics& end) {
  Stream stream = Stream::open(2, {2, 1.5, 0}, depth, 0);
  stream.inflow().level = [](double) { return 1.0; };
  stream.setup.openings.resize(1);
  stream.close();
  end = run(stream.setup, duration, 5)->diagnostics();
  return end.mass / 1000 / 2;
}

TEST(Openings, StillWaterStaysAtItsLevel) {
  Diagnostics end;
  EXPECT_NEAR(volume_at_level(1.0, 10, end), 1.0, 0.01);
  EXPECT_LT(end.max_speed, 0.1);
}

// It overshoots first; then what is too much goes back out, to a few particles of the last row, how many is
// chance: a quarter of a row at most.
TEST(Openings, LowWaterIsFilledUpToTheLevel) {
  Diagnostics end;
  EXPECT_NEAR(volume_at_level(0.8, 30, end), 1.0, 0.25 * Stream::kSpacing);
  EXPECT_GT(end.openings[0].mass_out, 0);
}

// A jet from a nozzle above a dry bed falls freely: v^2 = v0^2 + 2 g s.
void expect_free_fall(int dimension) {
  Scene scene(dimension, 0.05, 9.81, 40);
  const int up = dimension - 1;
  Vector3d size(1, 1, 2), low(0.4, 0.4, 0.4), high(0.6, 0.6, 0.6);
  if (dimension == 2) size = {1, 2, 0}, low.z() = high.z() = 0;
  low[up] = high[up] = 2;
  Opening nozzle;
  nozzle.side = 2 * up + 1;
  nozzle.min = low;
  nozzle.max = high;
  nozzle.speed = [](double, const Vector3d&) { return 4.0; };
  nozzle.pressure = [](double, const Vector3d&) { return 0.0; };
  scene.setup.openings = {nozzle};
  Tank tank{Vector3d::Zero(), size};
  tank.openings = scene.setup.openings;
  scene.setup.walls = sample_walls(tank, 0.05, scene.support(), dimension);
  const double time = 0.25;
  const auto end = run(scene.setup, time, 7);
  const Snapshot state = end->snapshot();
  const double rate = 1000 * 4.0 * std::pow(0.2, dimension - 1);
  EXPECT_NEAR(end->diagnostics().mass, rate * time, 0.05 * rate);
  for (std::size_t i = 0; i < state.density.size(); ++i) {
    const double fallen = 2 - vector(state.position, i)[up];
    const double speed = std::sqrt(16 + 2 * 9.81 * fallen);
    EXPECT_NEAR(-vector(state.velocity, i)[up], speed, 0.1 * speed) << "after " << fallen << " m";
  }
}

TEST(Openings, AJetFallsInThePlane) {
  expect_free_fall(2);
}

TEST(Openings, AJetFallsInSpace) {
  expect_free_fall(3);
}

TEST(Openings, NumbersRiseAndAreNotUsedAgain) {
  const fluid::Setup setup = Stream::closed(2, {2, 1, 0}).setup;
  auto solver = make_solver(setup);
  solver->start({});
  const double dt = solver->largest_step(1);
  std::uint32_t largest = 0;
  for (int k = 0; k < 300; ++k) {
    const Snapshot before = solver->snapshot();
    solver->step(dt, {});
    const Snapshot after = solver->snapshot();
    ASSERT_TRUE(std::is_sorted(after.id.begin(), after.id.end(), std::less_equal<>()));
    for (std::size_t i = 0; i < after.id.size(); ++i) {
      const auto was = std::lower_bound(before.id.begin(), before.id.end(), after.id[i]);
      if (was != before.id.end() && *was == after.id[i]) {
        const auto j = static_cast<std::size_t>(was - before.id.begin());
        ASSERT_LT((vector(after.position, i) - vector(before.position, j)).norm(), 2 * dt);
      } else {
        ASSERT_LT(vector(after.position, i).x(), 0.5 * Stream::kSpacing) << "appeared in the stream";
      }
    }
    largest = std::max(largest, after.id.back());
  }
  EXPECT_GT(largest, setup.fluid.position.size() + 50);
}

}  // namespace
}  // namespace sluice::fluid
