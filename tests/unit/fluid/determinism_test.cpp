#include <gtest/gtest.h>

#include <cstring>

#include "tests/unit/fluid/splash.hpp"

namespace sluice::fluid {
namespace {

testing::AssertionResult same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return testing::AssertionFailure() << "sizes " << a.size() << " and " << b.size();
  if (std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0) return testing::AssertionSuccess();
  std::size_t k = 0;
  while (std::memcmp(&a[k], &b[k], sizeof(double)) == 0) ++k;
  return testing::AssertionFailure() << "entry " << k << ": " << a[k] << " and " << b[k];
}

// Everything that a run gives away of its state.
std::vector<double> wrenches(const Solver& solver) {
  std::vector<double> all;
  const auto append = [&all](const Wrench& w) {
    all.insert(all.end(), w.force.data(), w.force.data() + 3);
    all.insert(all.end(), w.moment.data(), w.moment.data() + 3);
  };
  append(solver.wall_wrench());
  for (const Wrench& w : solver.wrenches()) append(w);
  return all;
}

void expect_same_state(const Solver& a, const Solver& b) {
  const Snapshot s = a.snapshot(), t = b.snapshot();
  EXPECT_TRUE(same_bits(s.position, t.position));
  EXPECT_TRUE(same_bits(s.velocity, t.velocity));
  EXPECT_TRUE(same_bits(s.density, t.density));
  EXPECT_TRUE(same_bits(s.pressure, t.pressure));
  EXPECT_TRUE(same_bits(wrenches(a), wrenches(b)));
  EXPECT_TRUE(same_bits({a.diagnostics().boundary_work, a.diagnostics().kinetic},
                        {b.diagnostics().boundary_work, b.diagnostics().kinetic}));
}

// Wrenches are compared in every step, for an exchange needs them all.
void expect_same_for_any_threads(int dimension, int steps) {
  Splash reference(dimension, 20.0, 1), again(dimension, 20.0, 1), two(dimension, 20.0, 2),
      three(dimension, 20.0, 3);
  for (int k = 0; k < steps && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "step " << k);
    for (Splash* splash : {&reference, &again, &two, &three}) splash->step();
    for (const Splash* other : {&again, &two, &three})
      EXPECT_TRUE(same_bits(wrenches(reference.solver()), wrenches(other->solver())));
  }
  {
    SCOPED_TRACE("run twice");
    expect_same_state(reference.solver(), again.solver());
  }
  {
    SCOPED_TRACE("2 threads");
    expect_same_state(reference.solver(), two.solver());
  }
  SCOPED_TRACE("3 threads");
  expect_same_state(reference.solver(), three.solver());
}

TEST(Determinism, AnyThreadsInThePlane) {
  expect_same_for_any_threads(2, 200);
}
TEST(Determinism, AnyThreadsInSpace) {
  expect_same_for_any_threads(3, 60);
}

// Particles are sorted inside the solver; whoever reads a snapshot must not notice.
TEST(Determinism, SnapshotKeepsTheOrderOfTheSetup) {
  Scene scene(2, 0.1, 0.0, 20.0);
  scene.add_block({0, 0, 0}, {2, 2, 0}, {0, 0, 0});
  for (std::size_t i = 0; i < scene.setup.fluid.position.size(); ++i)
    scene.setup.fluid.velocity[i] = {1.0, 2.0, 0.0};
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = solver->largest_step(3.0);
  for (int k = 0; k < 50; ++k) solver->step(dt, {});
  const Snapshot snapshot = solver->snapshot();
  for (std::size_t i = 0; i < scene.setup.fluid.position.size(); ++i) {
    const Eigen::Vector3d expected = scene.setup.fluid.position[i] + 50 * dt * Eigen::Vector3d(1, 2, 0);
    EXPECT_LT((Eigen::Map<const Eigen::Vector3d>(&snapshot.position[3 * i]) - expected).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace sluice::fluid
