#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "fluid/kernel.hpp"
#include "fluid/sampling.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing = 0.1, kSupport = 0.3;

MeshShape mesh(std::vector<Vector3d> vertices, std::vector<TriangleSurface::Triangle> triangles) {
  return {std::make_shared<TriangleSurface>(std::move(vertices), std::move(triangles))};
}

MeshShape cube(double edge) {
  std::vector<Vector3d> vertices;
  for (int v = 0; v < 8; ++v)
    vertices.push_back(edge * (Vector3d(v & 1, v >> 1 & 1, v >> 2) - Vector3d(0.5, 0.5, 0.5)));
  return mesh(std::move(vertices), {{0, 2, 1},
                                    {1, 2, 3},
                                    {4, 5, 6},
                                    {5, 7, 6},
                                    {0, 1, 4},
                                    {1, 5, 4},
                                    {2, 6, 3},
                                    {3, 6, 7},
                                    {0, 4, 2},
                                    {2, 4, 6},
                                    {1, 3, 5},
                                    {3, 7, 5}});
}

// A sphere of many triangles: an octahedron divided and pushed out.
MeshShape sphere(double radius, int divisions) {
  std::vector<Vector3d> vertices;
  std::vector<TriangleSurface::Triangle> triangles;
  const auto add = [&](const Vector3d& x) {
    const Vector3d on = radius * x.normalized();
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if ((vertices[v] - on).norm() < 1e-9) return static_cast<std::uint32_t>(v);
    vertices.push_back(on);
    return static_cast<std::uint32_t>(vertices.size() - 1);
  };
  for (int octant = 0; octant < 8; ++octant) {
    const Vector3d a((octant & 1) ? -1 : 1, 0, 0), b(0, (octant & 2) ? -1 : 1, 0),
        c(0, 0, (octant & 4) ? -1 : 1);
    const bool flip = (((octant & 1) + (octant >> 1 & 1) + (octant >> 2)) % 2) != 0;
    const auto at = [&](int i, int j) {
      return Vector3d(a + (b - a) * i / divisions + (c - a) * j / divisions);
    };
    const auto triangle = [&](const Vector3d& x, const Vector3d& y, const Vector3d& z) {
      triangles.push_back({add(x), flip ? add(z) : add(y), flip ? add(y) : add(z)});
    };
    for (int i = 0; i < divisions; ++i)
      for (int j = 0; i + j < divisions; ++j) {
        triangle(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < divisions) triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  return mesh(std::move(vertices), std::move(triangles));
}

double volume(const Boundary& body) {
  return std::accumulate(body.volume.begin(), body.volume.end(), 0.0);
}

// Every particle inside, its way ends on the surface and is as long as it is deep.
void expect_on_surface(const Shape& shape, const Boundary& body, int dimension, double tolerance = 1e-9) {
  ASSERT_FALSE(body.position.empty());
  for (std::size_t k = 0; k < body.position.size(); ++k) {
    const double depth = -signed_distance(shape, body.position[k], dimension);
    ASSERT_GT(depth, 0) << k;
    ASSERT_NEAR(body.to_surface[k].norm(), depth, tolerance) << body.position[k].transpose();
    ASSERT_NEAR(signed_distance(shape, body.position[k] + body.to_surface[k], dimension), 0, tolerance);
  }
}

double nearest_pair(const Boundary& body) {
  double nearest = 1e9;
  for (std::size_t a = 0; a < body.position.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      nearest = std::min(nearest, (body.position[a] - body.position[b]).norm());
  return nearest;
}

TEST(TriangleSurface, DistanceIsThatOfTheCube) {
  const MeshShape shape = cube(2);
  const Shape box = BoxShape{{1, 1, 1}};
  for (int n = 0; n < 2000; ++n) {
    const Vector3d x = 2 * Vector3d(std::sin(1.3 * n), std::sin(2.7 * n + 1), std::cos(0.7 * n));
    ASSERT_NEAR(signed_distance(shape, x, 3), signed_distance(box, x, 3), 1e-12) << x.transpose();
  }
  EXPECT_NEAR(shape.surface->volume(), 8, 1e-12);
}

TEST(Cylinder, DistanceInsideOutsideAndBeyondItsEdge) {
  const Shape cylinder = CylinderShape{1, 2, 0};
  EXPECT_DOUBLE_EQ(signed_distance(cylinder, {0, 0, 0}, 3), -1);
  EXPECT_DOUBLE_EQ(signed_distance(cylinder, {0, 3, 0}, 3), 2);
  EXPECT_DOUBLE_EQ(signed_distance(cylinder, {2.5, 0, 0.2}, 3), 0.5);
  EXPECT_DOUBLE_EQ(signed_distance(cylinder, {5, 5, 0}, 3), 5);
  EXPECT_NEAR(signed_distance(cylinder, {1.9, 0, 0}, 3), -0.1, 1e-15);
}

TEST(Sampling, CylinderHasItsVolumeAndItsSurface) {
  const Shape thick = CylinderShape{0.5, 0.8, 1};
  const Boundary body = sample_body(thick, kSpacing, kSupport, 3);
  expect_on_surface(thick, body, 3);
  const double hollow = std::numbers::pi * (0.25 * 1.6 - 0.04 * 1.0);
  EXPECT_NEAR(volume(body), hollow, 1e-9);
  EXPECT_GT(nearest_pair(body), 0.5 * kSpacing);
  const Shape thin = CylinderShape{0.15, 0.2, 2};
  EXPECT_NEAR(volume(sample_body(thin, kSpacing, kSupport, 3)), std::numbers::pi * 0.0225 * 0.4, 1e-12);
}

TEST(Sampling, OutlineThatIsNotConvexFansOutAtItsNotch) {
  // An L of two arms 1 m long and 0.7 m wide.
  const Shape shape = PolygonShape{{{0, 0}, {2, 0}, {2, 0.7}, {0.7, 0.7}, {0.7, 2}, {0, 2}}};
  const Boundary body = sample_body(shape, kSpacing, kSupport, 2);
  expect_on_surface(shape, body, 2);
  EXPECT_GT(nearest_pair(body), 0.4 * kSpacing);
  // The band below the outline: its length times the depth, less the mitres of five corners, plus the fan.
  const double band = 8 * 0.3 - 5 * 0.09 + std::numbers::pi / 4 * 0.09;
  EXPECT_NEAR(volume(body), band, 0.03 * band);
}

// Sum of V W over the particles, at a point `above` the middle of a face, over that of a half-space of
// particles.
double wetness(const Boundary& body, const Vector3d& x, double h) {
  const WendlandC2<3> kernel(h);
  double sum = 0;
  for (std::size_t k = 0; k < body.position.size(); ++k)
    sum += body.volume[k] * kernel.value(Vec<3>(x - body.position[k]));
  return sum;
}

TEST(Sampling, MeshIsSampledAsEvenlyAsABox) {
  const Shape shape = cube(1.2);
  const Boundary body = sample_body(shape, kSpacing, kSupport, 3),
                 lattice = sample_body(BoxShape{{0.6, 0.6, 0.6}}, kSpacing, kSupport, 3);
  expect_on_surface(shape, body, 3, 1e-6);
  EXPECT_NEAR(volume(body), volume(lattice), 0.02 * volume(lattice));
  EXPECT_GT(nearest_pair(body), 0.4 * kSpacing);
  for (int n = 0; n < 50; ++n) {
    const Vector3d x(0.4 * std::sin(3.1 * n), 0.4 * std::sin(1.7 * n + 1), 0.6 + 0.5 * kSpacing);
    EXPECT_NEAR(wetness(body, x, 1.5 * kSpacing) / wetness(lattice, x, 1.5 * kSpacing), 1, 0.1)
        << x.transpose();
  }
}

TEST(Sampling, MeshOfASphereIsSampledAsTheBall) {
  const Shape shape = sphere(0.6, 8);
  const Boundary body = sample_body(shape, kSpacing, kSupport, 3),
                 shells = sample_body(BallShape{0.6}, kSpacing, kSupport, 3);
  expect_on_surface(shape, body, 3, 1e-6);
  EXPECT_NEAR(volume(body), volume(shells), 0.04 * volume(shells));
  for (int n = 0; n < 50; ++n) {
    const Vector3d x = (0.6 + 0.5 * kSpacing) *
                       Vector3d(std::sin(1.3 * n), std::sin(2.7 * n + 1), std::cos(0.7 * n)).normalized();
    EXPECT_NEAR(wetness(body, x, 1.5 * kSpacing) / wetness(shells, x, 1.5 * kSpacing), 1, 0.12)
        << x.transpose();
  }
}

TEST(Sampling, CompoundOfTwoBoxesIsTheirUnion) {
  CompoundShape pair;
  pair.parts.push_back({BoxShape{{0.5, 0.5, 0.5}}, {-0.5, 0, 0}, Eigen::Quaterniond::Identity()});
  pair.parts.push_back({BoxShape{{0.5, 0.5, 0.5}}, {0.5, 0, 0}, Eigen::Quaterniond::Identity()});
  const Boundary body = sample_body(pair, kSpacing, kSupport, 3),
                 whole = sample_body(BoxShape{{1, 0.5, 0.5}}, kSpacing, kSupport, 3);
  const Shape box = BoxShape{{1, 0.5, 0.5}};
  EXPECT_NEAR(volume(body), volume(whole), 0.05 * volume(whole));
  for (std::size_t k = 0; k < body.position.size(); ++k) {
    const double off = std::abs(signed_distance(box, body.position[k] + body.to_surface[k], 3));
    ASSERT_LT(off, 1e-9) << body.position[k].transpose();  // none ends on the seam
  }
}

TEST(Sampling, CompoundOfOnePartIsThatPartElsewhere) {
  const Shape plate = BoxShape{{0.05, 0.5, 0.5}};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()));
  CompoundShape moved;
  moved.parts.push_back({plate, {0.1, 0.2, 0.3}, turn});
  const Boundary there = sample_body(moved, kSpacing, kSupport, 3),
                 here = sample_body(plate, kSpacing, kSupport, 3);
  ASSERT_EQ(there.plates.front().size(), 6u);
  ASSERT_EQ(there.position.size(), here.position.size());
  EXPECT_TRUE(there.position[7].isApprox(Vector3d(0.1, 0.2, 0.3) + turn * here.position[7], 1e-14));
  EXPECT_TRUE(there.plates.front()[2].normal.isApprox(turn * here.plates.front()[2].normal, 1e-14));
}

}  // namespace
}  // namespace sluice::fluid
