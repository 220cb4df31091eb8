#include "fluid/crowding.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;
constexpr double kGravity = 9.81, kDepth = 1.0, kSpacing = kDepth / 16;

// Sum of weights over share of the support, and that of the whole lattice, at a particle `row` rows under the
// surface of a lattice turned by `angle` in the plane of the surface's normal.
template <int Dim>
double crowding(int row, double angle) {
  const double h = stable_smoothing(Dim);
  const WendlandC2<Dim> kernel(h);
  const HalfSpace<Dim> half_space(kernel, h);
  Vec<Dim> normal = Vec<Dim>::Zero();
  normal[0] = std::sin(angle);
  normal[1] = std::cos(angle);
  double m0 = 0;
  Vec<Dim> m1 = Vec<Dim>::Zero();
  sum_on_lattice<Dim>(kernel, 1.0, [&](double V, const Vec<Dim>& x) {
    const double weight = x.dot(normal) <= row + 1e-9 ? V * kernel.value(x) : 0.0;
    m0 += weight;
    m1 += weight * x;
    return 0.0;
  });
  return m0 / half_space.share(m1.norm() / (m0 * h)) / lattice_sum<Dim>(kernel, 1.0);
}

TEST(Crowding, IsOneOnALatticeUpToItsSurface) {
  const double bound[] = {0.04, 0.01, 0.001, 0.001};
  for (const int row : {0, 1, 2, 3}) {
    EXPECT_NEAR(crowding<2>(row, 0.0), 1.0, bound[row]) << row;
    EXPECT_NEAR(crowding<3>(row, 0.0), 1.0, bound[row]) << row;
  }
}

TEST(Crowding, IsNearlyOneWhereTheSurfaceCutsTheLattice) {
  for (const double angle : {0.2, 0.5, 0.785}) {
    EXPECT_NEAR(crowding<2>(0, angle), 1.0, 0.06) << angle;
    EXPECT_NEAR(crowding<3>(0, angle), 1.0, 0.06) << angle;
  }
}

// A tank between mirrors whose particles were displaced by up to 1 % of a spacing.
Scene stirred_tank(double spreading) {
  Scene scene(2, kSpacing, kGravity, 10.0 * std::sqrt(2.0 * kGravity * kDepth));
  scene.add_still_water({0, 0, 0}, {kDepth, kDepth, 0});
  std::minstd_rand random(1);
  std::uniform_real_distribution<double> share(-0.01, 0.01);
  for (Vector3d& x : scene.setup.fluid.position) x += kSpacing * Vector3d(share(random), share(random), 0);
  Tank tank{{0, 0, 0}, {kDepth, 2 * kDepth, 0}, {true, true, true, false}};
  tank.mirrored = {true, true};
  scene.setup.mirrors = {tank.min, tank.max, tank.mirrored};
  scene.setup.walls = sample_walls(tank, kSpacing, scene.support(), 2);
  scene.setup.formulation.spreading = spreading;
  return scene;
}

struct Watched {
  double kinetic = 0;  // the largest, over the potential energy
  double sunk = 0;     // of the highest particle, the most [spacings]
};

// From t sqrt(g/H) = 20 to 100: README.md, "Crowding".
Watched watch(const Scene& scene) {
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double potential = solver->diagnostics().potential, time_unit = std::sqrt(kDepth / kGravity);
  const double dt = solver->largest_step(std::sqrt(2.0 * kGravity * kDepth));
  Watched seen;
  for (double t = 0; t < 100 * time_unit; t += 100 * dt) {
    for (int k = 0; k < 100; ++k) solver->step(dt, {});
    if (t < 20 * time_unit) continue;
    seen.kinetic = std::max(seen.kinetic, solver->diagnostics().kinetic / potential);
    const Snapshot now = solver->snapshot();
    double top = 0;
    for (std::size_t i = 1; i < now.position.size(); i += 3) top = std::max(top, now.position[i]);
    seen.sunk = std::max(seen.sunk, (kDepth - 0.5 * kSpacing - top) / kSpacing);
  }
  return seen;
}

TEST(Crowding, SinksWithoutSpreading) {
  EXPECT_GT(watch(stirred_tank(0)).kinetic, 1e-4);
}

TEST(Crowding, SpreadAStirredTankStaysAtRest) {
  const Watched tank = watch(stirred_tank(0.02));
  EXPECT_LT(tank.kinetic, 2e-7);
  EXPECT_LT(tank.sunk, 0.1);
}

}  // namespace
}  // namespace sluice::fluid
