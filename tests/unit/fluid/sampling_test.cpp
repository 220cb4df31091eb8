#include "fluid/sampling.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr std::array<bool, 6> kClosed{true, true, true, true, true, true};
constexpr std::array<bool, 6> kNoLid2{true, true, true, false, false, false};

double total(const std::vector<double>& volumes) {
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

TEST(Fill, BoxesHoldExactlyTheirMass) {
  const double dx = 0.1;
  const auto square = fill(BoxShape{{0.6, 0.35, 0}}, {3, -2, 0}, dx, 2);
  EXPECT_EQ(square.size(), 84u);
  EXPECT_NEAR(square.size() * particle_volume(dx, 2), 1.2 * 0.7, 1e-12);
  const auto cube = fill(BoxShape{{0.3, 0.2, 0.5}}, {1, 1, 1}, dx, 3);
  EXPECT_EQ(cube.size(), 240u);
  EXPECT_NEAR(cube.size() * particle_volume(dx, 3), 0.6 * 0.4 * 1.0, 1e-12);
}

// Any box of whole spacings, wherever it stands: the count is exact, whatever the rounding.
RC_GTEST_PROP(Fill, CountsCells, ()) {
  const int nx = *rc::gen::inRange(1, 40), ny = *rc::gen::inRange(1, 40);
  const double dx = *rc::gen::inRange(1, 1000) * 1e-4;
  const Vector3d center(*rc::gen::inRange(-100, 100) * 0.037, *rc::gen::inRange(-100, 100) * 0.051, 0);
  const auto points = fill(BoxShape{{0.5 * nx * dx, 0.5 * ny * dx, 0}}, center, dx, 2);
  RC_ASSERT(points.size() == static_cast<std::size_t>(nx * ny));
}

TEST(Fill, StandsAtHalfSpacingsFromTheLowerCorner) {
  const auto points = fill(BoxShape{{0.2, 0.2, 0.2}}, {1, 2, 3}, 0.1, 3);
  ASSERT_EQ(points.size(), 64u);
  EXPECT_LT((points.front() - Vector3d(0.85, 1.85, 2.85)).norm(), 1e-14);
  EXPECT_LT((points.back() - Vector3d(1.15, 2.15, 3.15)).norm(), 1e-14);
}

TEST(Fill, KeepsInsideTheShape) {
  const Shape ball = BallShape{1.0};
  const Vector3d center(5, -3, 2);
  const auto points = fill(ball, center, 0.05, 3);
  for (const Vector3d& x : points) EXPECT_LT((x - center).norm(), 1.0);
  EXPECT_NEAR(points.size() * particle_volume(0.05, 3), 4.0 / 3.0 * std::numbers::pi, 0.01);
  const auto triangle = fill(PolygonShape{{{0, 0}, {1, 0}, {0, 1}}}, {0, 0, 0}, 0.01, 2);
  for (const Vector3d& x : triangle) EXPECT_LT(x.x() + x.y(), 1.0 + 1e-12);
  EXPECT_NEAR(triangle.size() * 1e-4, 0.5, 0.01);
}

// 49 lattice points lie on the long side; rounding must not choose among them.
TEST(Fill, PointsOnTheSurfaceAreOutside) {
  const auto triangle = fill(PolygonShape{{{0, 0}, {1, 0}, {0, 1}}}, {0, 0, 0}, 0.02, 2);
  EXPECT_EQ(triangle.size(), 49u * 50u / 2u);
}

TEST(Walls, EncloseTheBoxAndKeepOutOfIt) {
  const Vector3d min(-1, 2, 0), max(0, 2.5, 0.3);
  for (const int dimension : {2, 3}) {
    const Boundary walls = sample_walls({min, max, kClosed}, 0.1, 0.3, dimension);
    const double volume = dimension == 2 ? 1.6 * 1.1 - 1.0 * 0.5 : 1.6 * 1.1 * 0.9 - 1.0 * 0.5 * 0.3;
    EXPECT_NEAR(total(walls.volume), volume, 1e-12);
    for (const Vector3d& x : walls.position) {
      bool inside = true;
      for (int a = 0; a < dimension; ++a) {
        inside = inside && x[a] > min[a] && x[a] < max[a];
        EXPECT_GT(x[a], min[a] - 0.3);
        EXPECT_LT(x[a], max[a] + 0.3);
      }
      EXPECT_FALSE(inside) << x.transpose();
    }
  }
}

TEST(Walls, LeaveOpenSidesOpen) {
  const Boundary walls = sample_walls({{0, 0, 0}, {1, 1, 0}, kNoLid2}, 0.1, 0.3, 2);
  EXPECT_NEAR(total(walls.volume), 1.6 * 0.3 + 2 * 0.3 * 1.0, 1e-12);
  for (const Vector3d& x : walls.position) EXPECT_LT(x.y(), 1.0);
  const Boundary floor = sample_walls({{0, 0, 0}, {1, 1, 1}, {0, 0, 0, 0, 1, 0}}, 0.1, 0.3, 3);
  EXPECT_NEAR(total(floor.volume), 0.3, 1e-12);
  for (const Vector3d& x : floor.position) EXPECT_LT(x.z(), 0.0);
  EXPECT_TRUE(sample_walls({{0, 0, 0}, {1, 1, 1}, {}}, 0.1, 0.3, 3).position.empty());
}

TEST(Walls, NoTwoParticlesShareAPlace) {
  const Boundary walls = sample_walls({{0, 0, 0}, {0.7, 0.4, 0.5}, kClosed}, 0.1, 0.3, 3);
  std::set<std::array<long, 3>> places;
  for (const Vector3d& x : walls.position)
    places.insert({std::lround(x.x() / 0.05), std::lround(x.y() / 0.05), std::lround(x.z() / 0.05)});
  EXPECT_EQ(places.size(), walls.position.size());
}

TEST(Walls, DeepEnoughForASupportThatIsNoMultipleOfTheSpacing) {
  const Boundary walls = sample_walls({{0, 0, 0}, {1, 1, 0}, kClosed}, 0.1, 0.25, 2);
  double lowest = 0;
  for (const Vector3d& x : walls.position) lowest = std::min(lowest, x.y());
  EXPECT_NEAR(lowest, -0.25, 1e-12);  // three layers
}

// 1.03 holds ten cells of 0.103: the wall particles along it are as wide as their cells.
TEST(Walls, VolumesFillTheLayersOfAnyBox) {
  const Boundary walls = sample_walls({{0, 0, 0}, {1.03, 0.96, 0}, kClosed}, 0.1, 0.3, 2);
  EXPECT_NEAR(total(walls.volume), 1.63 * 1.56 - 1.03 * 0.96, 1e-12);
}

// A region need not be convex: an L of 3 x 3 cells less its upper right 2 x 2.
TEST(Fill, AnLHasNoParticlesInItsNotch) {
  const PolygonShape l{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}};
  const auto points = fill(l, Eigen::Vector3d::Zero(), 0.1, 2);
  EXPECT_EQ(points.size(), 500u);
  for (const Eigen::Vector3d& x : points) EXPECT_FALSE(x.x() > 1 && x.y() > 1) << x.transpose();
}

}  // namespace
}  // namespace sluice::fluid
