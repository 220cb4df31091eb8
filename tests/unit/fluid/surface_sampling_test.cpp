#include <gtest/gtest.h>

#include "fluid/sampling.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;
constexpr double kSpacing = 0.1, kEdge = kSpacing / 3;

// Every particle is half its edge behind the surface, and its nearest neighbour there about an edge away.
void expect_on_surface(const Boundary& boundary, double least, double most) {
  ASSERT_GT(boundary.position.size(), 10u);
  for (std::size_t w = 0; w < boundary.position.size(); ++w) {
    EXPECT_NEAR(boundary.to_surface[w].norm(), kEdge / 2, 1e-9);
    const Vector3d at = boundary.position[w] + boundary.to_surface[w];
    double nearest = 1;
    for (std::size_t k = 0; k < boundary.position.size(); ++k)
      if (k != w) nearest = std::min(nearest, (boundary.position[k] + boundary.to_surface[k] - at).norm());
    EXPECT_GT(nearest, least * kEdge);
    EXPECT_LT(nearest, most * kEdge);
  }
}

TEST(SurfaceSampling, WallsAreOneLayerWithoutEdges) {
  const Boundary walls = sample_wall_surface({{0, 0, 0}, {1, 2, 0}}, kSpacing, 2 * kSpacing, 2);
  EXPECT_EQ(walls.position.size(), 2u * (30 + 60));
  expect_on_surface(walls, 0.7, 1.01);
  double area = 0;
  for (std::size_t w = 0; w < walls.position.size(); ++w) {
    const Vector3d at = walls.position[w] + walls.to_surface[w];
    EXPECT_LT(std::min({std::abs(at.x()), std::abs(at.x() - 1), std::abs(at.y()), std::abs(at.y() - 2)}),
              1e-9);
    area += walls.volume[w] / kEdge;
  }
  EXPECT_NEAR(area, 6, 1e-9);
}

TEST(SurfaceSampling, WallsGoOnPastPeriodicSides) {
  Tank tank{{0, 0, 0}, {1, 2, 0}};
  tank.periodic[0] = true;
  const Boundary walls = sample_wall_surface(tank, kSpacing, 2 * kSpacing, 2);
  double lowest = 0, highest = 0;
  for (const Vector3d& x : walls.position) {
    lowest = std::min(lowest, x.x());
    highest = std::max(highest, x.x());
  }
  EXPECT_LT(lowest, -2 * kSpacing);
  EXPECT_GT(highest, 1 + 2 * kSpacing);
}

TEST(SurfaceSampling, BodiesAreOneLayerWithOutwardNormals) {
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const Boundary ball = sample_body_surface(BallShape{0.4}, kSpacing, dimension);
    expect_on_surface(ball, 0.5, 1.3);
    for (std::size_t w = 0; w < ball.position.size(); ++w)
      EXPECT_NEAR((ball.position[w] + ball.to_surface[w]).norm(), 0.4, 1e-9);
    expect_on_surface(sample_body_surface(BoxShape{{0.3, 0.2, 0.4}}, kSpacing, dimension), 0.7, 1.01);
  }
}

}  // namespace
}  // namespace sluice::fluid
