#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid/streams.hpp"

namespace sluice::fluid {
namespace {

// A stream that a box in it disturbs, with a level to hold and formulas in time: all that openings keep.
Setup disturbed(int dimension, int threads) {
  const Eigen::Vector3d size = dimension == 2 ? Eigen::Vector3d(3, 1.5, 0) : Eigen::Vector3d(1.6, 0.5, 1.2);
  Stream stream = Stream::open(dimension, size, 0.8, 2.0);
  stream.inflow().level = [](double t) { return 0.85 + 0.1 * t; };
  stream.outflow().level = [](double t) { return 0.75 - 0.1 * t; };
  stream.close();
  stream.add_body(BoxShape{{0.15, 0.15, 0.15}});
  stream.setup.threads = threads;
  stream.setup.measure_wall_force = true;
  return stream.setup;
}

std::vector<Kinematics> box(int dimension) {
  Kinematics k;
  k.position = dimension == 2 ? Eigen::Vector3d(1.5, 0.6, 0) : Eigen::Vector3d(0.8, 0.25, 0.7);
  return {k};
}

struct DisturbedStream {
  DisturbedStream(int dimension, int threads)
      : bodies(box(dimension)), solver(make_solver(disturbed(dimension, threads))) {}
  void step(int count) {
    for (int k = 0; k < count; ++k) solver->step(1e-3, bodies);
  }
  std::vector<Kinematics> bodies;
  std::unique_ptr<Solver> solver;
};

std::vector<double> everything(const Solver& solver) {
  const Diagnostics d = solver.diagnostics();
  std::vector<double> all{d.kinetic, d.potential, d.elastic, d.boundary_work, d.mass};
  for (const Passage& p : d.openings) all.insert(all.end(), {p.mass_in, p.mass_out});
  const Snapshot s = solver.snapshot();
  all.insert(all.end(), s.id.begin(), s.id.end());
  for (const auto* values : {&s.position, &s.velocity, &s.density, &s.pressure})
    all.insert(all.end(), values->begin(), values->end());
  const Eigen::Vector3d wall = solver.wall_wrench().force, body = solver.wrenches()[0].force;
  all.insert(all.end(), wall.begin(), wall.end());
  all.insert(all.end(), body.begin(), body.end());
  return all;
}

void expect_particles_came_and_went(const Solver& solver) {
  for (const Passage& p : solver.diagnostics().openings) EXPECT_GT(p.mass_in + p.mass_out, 0);
}

class OpeningsState : public testing::TestWithParam<int> {
 protected:
  int dimension() const { return GetParam(); }
  int steps() const { return dimension() == 2 ? 300 : 60; }
};

TEST_P(OpeningsState, IsTheSameForAnyNumberOfThreads) {
  DisturbedStream one(dimension(), 1), three(dimension(), 3);
  for (DisturbedStream* run : {&one, &three}) {
    run->solver->start(run->bodies);
    run->step(steps());
  }
  EXPECT_EQ(everything(*one.solver), everything(*three.solver));
  expect_particles_came_and_went(*one.solver);
}

TEST_P(OpeningsState, IsRestored) {
  DisturbedStream straight(dimension(), 1), back(dimension(), 1);
  for (DisturbedStream* run : {&straight, &back}) {
    run->solver->start(run->bodies);
    run->step(20);
  }
  back.solver->save();
  back.bodies[0].position.y() += 0.01;
  back.step(steps());
  back.solver->restore();
  back.bodies = straight.bodies;
  straight.step(steps());
  back.step(steps());
  EXPECT_EQ(everything(*straight.solver), everything(*back.solver));
}

TEST_P(OpeningsState, GoesOnFromItsBytes) {
  DisturbedStream whole(dimension(), 1), resumed(dimension(), 2);
  whole.solver->start(whole.bodies);
  whole.step(steps());
  std::vector<std::byte> bytes;
  whole.solver->write_state(bytes);
  resumed.solver->read_state(bytes);
  ASSERT_EQ(everything(*whole.solver), everything(*resumed.solver));
  whole.step(steps());
  resumed.step(steps());
  EXPECT_EQ(everything(*whole.solver), everything(*resumed.solver));
}

INSTANTIATE_TEST_SUITE_P(Dimensions, OpeningsState, testing::Values(2, 3));

}  // namespace
}  // namespace sluice::fluid
