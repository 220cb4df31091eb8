#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr int kCells = 20;
constexpr double kSpacing = 1.0 / kCells;

// Liquid in a box of edge 1 without sides, with velocity `flow(x)`; `moved` moves the lattice, not the flow.
template <typename Flow>
Scene endless(int dimension, const Flow& flow, const Vector3d& moved) {
  Scene scene(dimension, kSpacing, 0.0, 10.0);
  scene.setup.gravity.setZero();
  scene.setup.period.length.head(dimension).setOnes();
  for (int c = 0; c < (dimension == 3 ? kCells : 1); ++c)
    for (int b = 0; b < kCells; ++b)
      for (int a = 0; a < kCells; ++a) {
        Vector3d x = kSpacing * Vector3d(a + 0.5, b + 0.5, dimension == 3 ? c + 0.5 : 0.0) + moved;
        x.head(dimension) -= x.head(dimension).array().floor().matrix();
        scene.add_particle(x, flow(x - moved), 100.0);
      }
  return scene;
}

Vector3d vortices(const Vector3d& x) {
  const double k = 2.0 * std::numbers::pi;
  return {-std::cos(k * x.x()) * std::sin(k * x.y()), std::sin(k * x.x()) * std::cos(k * x.y()), 0.0};
}

Diagnostics after(const Scene& scene, int steps) {
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = solver->largest_step(1.0);
  for (int k = 0; k < steps; ++k) solver->step(dt, {});
  return solver->diagnostics();
}

TEST(Periodic, UniformFlowStaysUniform) {
  for (const int dimension : {2, 3}) {
    const Vector3d U(0.7, -0.4, dimension == 3 ? 0.3 : 0.0);
    const Scene scene = endless(
        dimension, [&](const Vector3d&) { return U; }, Vector3d::Zero());
    const auto solver = make_solver(scene.setup);
    solver->start({});
    const double dt = solver->largest_step(1.0);
    for (int k = 0; k < 60; ++k) solver->step(dt, {});
    const Snapshot s = solver->snapshot();
    for (std::size_t i = 0; i < s.density.size(); ++i) {
      ASSERT_LT((Eigen::Map<const Vector3d>(&s.velocity[3 * i]) - U).norm(), 1e-10);
      ASSERT_NEAR(s.density[i] / s.density[0], 1.0, 1e-12);
    }
  }
}

TEST(Periodic, ParticlesComeInThroughTheOtherSide) {
  const Scene scene = endless(
      2, [](const Vector3d&) { return Vector3d(1, 0, 0); }, Vector3d::Zero());
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = solver->largest_step(1.0);
  for (int k = 0; k < 400; ++k) solver->step(dt, {});
  const Snapshot s = solver->snapshot();
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    ASSERT_GT(s.position[3 * i], -kSpacing);
    ASSERT_LT(s.position[3 * i], 1.0 + kSpacing);
  }
}

// Where the sides are makes no difference.
TEST(Periodic, TheSidesAreNowhere) {
  const Diagnostics one = after(endless(2, vortices, Vector3d::Zero()), 100);
  const Diagnostics two = after(endless(2, vortices, Vector3d(0.31, 0.77, 0)), 100);
  EXPECT_NEAR(two.kinetic / one.kinetic, 1.0, 1e-9);
  EXPECT_NEAR(two.max_compression / one.max_compression, 1.0, 1e-6);
}

TEST(Periodic, MomentumIsConserved) {
  const auto flow = [](const Vector3d& x) { return Vector3d(vortices(x) + Vector3d(0.2, 0.1, 0)); };
  const Scene scene = endless(2, flow, Vector3d::Zero());
  const Vector3d start = after(scene, 0).momentum, end = after(scene, 200).momentum;
  EXPECT_LT((end - start).norm(), 1e-11 * start.norm());
}

}  // namespace
}  // namespace sluice::fluid
