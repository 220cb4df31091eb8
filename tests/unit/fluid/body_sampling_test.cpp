#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "fluid/sampling.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing = 0.1, kSupport = 0.3, kPi = std::numbers::pi;

double total(const Boundary& body) {
  return std::accumulate(body.volume.begin(), body.volume.end(), 0.0);
}

void expect_within(const Boundary& body, const Shape& shape, int dimension) {
  ASSERT_EQ(body.position.size(), body.volume.size());
  ASSERT_FALSE(body.position.empty());
  for (std::size_t k = 0; k < body.position.size(); ++k) {
    EXPECT_LT(signed_distance(shape, body.position[k], dimension), 1e-12) << body.position[k].transpose();
    EXPECT_GT(body.volume[k], 0.0);
    if (dimension == 2) {
      EXPECT_EQ(body.position[k].z(), 0.0);
    }
  }
}

TEST(SampleBox, FillsItsShellInThePlane) {
  const Shape box = BoxShape{{0.8, 0.5, 0}};
  const Boundary body = sample_body(box, kSpacing, kSupport, 2);
  expect_within(body, box, 2);
  EXPECT_TRUE(body.plates.empty());
  EXPECT_NEAR(total(body), 1.6 * 1.0 - 1.0 * 0.4, 1e-12);
  for (const Vector3d& x : body.position) EXPECT_GT(signed_distance(box, x, 2), -kSupport);
}

TEST(SampleBox, FillsItsShellInSpace) {
  const Shape box = BoxShape{{0.8, 0.5, 0.4}};
  const Boundary body = sample_body(box, kSpacing, kSupport, 3);
  expect_within(body, box, 3);
  EXPECT_NEAR(total(body), 1.6 * 1.0 * 0.8 - 1.0 * 0.4 * 0.2, 1e-12);
}

TEST(SampleBox, StretchesItsCellsToASizeThatIsNoMultipleOfTheSpacing) {
  const Shape box = BoxShape{{0.815, 0.485, 0}};  // 16 cells of 0.101875 by 10 of 0.097
  const Boundary body = sample_body(box, kSpacing, kSupport, 2);
  expect_within(body, box, 2);
  EXPECT_NEAR(total(body), 1.63 * 0.97 - (1.63 - 6 * 0.101875) * (0.97 - 6 * 0.097), 1e-12);
}

TEST(SampleBox, AsThickAsTwoSupportsIsFull) {
  const Boundary body = sample_body(BoxShape{{0.3, 0.3, 0}}, kSpacing, kSupport, 2);
  EXPECT_TRUE(body.plates.empty());
  EXPECT_NEAR(total(body), 0.36, 1e-12);
}

TEST(SampleBall, FillsItsShells) {
  for (const double radius : {0.31, 0.5, 1.0}) {
    const Shape ball = BallShape{radius};
    const double hole = std::max(radius - kSupport, 0.0);
    const Boundary disc = sample_body(ball, kSpacing, kSupport, 2);
    expect_within(disc, ball, 2);
    EXPECT_NEAR(total(disc), kPi * (radius * radius - hole * hole), 1e-12);
    const Boundary sphere = sample_body(ball, kSpacing, kSupport, 3);
    expect_within(sphere, ball, 3);
    EXPECT_NEAR(total(sphere), 4.0 / 3.0 * kPi * (std::pow(radius, 3) - std::pow(hole, 3)), 1e-12);
  }
}

TEST(SampleBall, IsBalancedAndEvenlySpaced) {
  for (const int dimension : {2, 3}) {
    const Boundary body = sample_body(BallShape{1.0}, kSpacing, kSupport, dimension);
    Vector3d center = Vector3d::Zero();
    for (std::size_t k = 0; k < body.position.size(); ++k) center += body.volume[k] * body.position[k];
    EXPECT_LT(center.norm() / total(body), dimension == 2 ? 1e-12 : 0.01 * kSpacing);
    for (const double volume : body.volume)
      EXPECT_NEAR(volume / particle_volume(kSpacing, dimension), 1.0, 0.05);
  }
}

TEST(SampleBall, SmallerThanALayerIsStillThere) {
  for (const int dimension : {2, 3}) {
    const Boundary body = sample_body(BallShape{0.04}, kSpacing, kSupport, dimension);
    ASSERT_EQ(body.position.size(), 1u);
    EXPECT_EQ(body.position[0], Vector3d::Zero());
    EXPECT_NEAR(body.volume[0], dimension == 2 ? kPi * 0.0016 : 4.0 / 3.0 * kPi * 6.4e-5, 1e-15);
  }
}

TEST(SamplePolygon, FillsItsShellWithMitredCorners) {
  const Shape hexagon = PolygonShape{{{1, 0},
                                      {0.5, std::sqrt(0.75)},
                                      {-0.5, std::sqrt(0.75)},
                                      {-1, 0},
                                      {-0.5, -std::sqrt(0.75)},
                                      {0.5, -std::sqrt(0.75)}}};
  const Boundary body = sample_body(hexagon, 0.02, 0.06, 2);
  EXPECT_TRUE(body.plates.empty());
  expect_within(body, hexagon, 2);
  const double inner = 1.0 - 0.06 / std::sqrt(0.75);
  const double shell = 1.5 * std::sqrt(3.0) * (1.0 - inner * inner);
  EXPECT_NEAR(total(body) / shell, 1.0, 0.02);
  for (const Vector3d& x : body.position) EXPECT_GT(signed_distance(hexagon, x, 2), -0.06);
}

TEST(SamplePlate, HasLayersOfItsOwnForEveryFace) {
  const Shape plate = BoxShape{{0.1, 0.6, 0}};
  const Boundary body = sample_body(plate, kSpacing, kSupport, 2);
  ASSERT_EQ(body.plates.front().size(), 4u);
  ASSERT_EQ(body.face.size(), body.position.size());
  std::vector<double> depth(4, 0.0), volume(4, 0.0);
  for (std::size_t k = 0; k < body.position.size(); ++k) {
    const auto f = static_cast<std::size_t>(body.face[k]);
    ASSERT_LT(f, 4u);
    const double d = -(body.position[k] - body.plates.front()[f].point).dot(body.plates.front()[f].normal);
    EXPECT_GT(d, 0.0);  // behind its own face
    depth[f] = std::max(depth[f], d);
    volume[f] += body.volume[k];
  }
  for (std::size_t f = 0; f < 4; ++f) {
    EXPECT_NEAR(depth[f], kSupport - 0.5 * kSpacing, 1e-12);
    const double length = std::abs(body.plates.front()[f].normal.x()) > 0.5 ? 1.2 : 0.2;
    EXPECT_NEAR(volume[f], length * kSupport, 1e-12);
    EXPECT_NEAR(signed_distance(plate, body.plates.front()[f].point, 2), 0.0, 1e-12);
  }
}

// A body whose centre of mass is given is a compound of one part.
TEST(SamplePlate, KeepsItsFacesInAnotherFrame) {
  const BoxShape box{{0.1, 0.6, 0}};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector3d shift(0.2, -0.1, 0);
  const Boundary plate = sample_body(box, kSpacing, kSupport, 2);
  const Boundary placed = sample_body(CompoundShape{{{box, shift, turn}}}, kSpacing, kSupport, 2);
  ASSERT_EQ(placed.position.size(), plate.position.size());
  ASSERT_EQ(placed.plates.front().size(), 4u);
  EXPECT_EQ(placed.face, plate.face);
  for (std::size_t w = 0; w < plate.position.size(); ++w) {
    EXPECT_NEAR((placed.position[w] - shift - turn * plate.position[w]).norm(), 0, 1e-15);
    EXPECT_NEAR((placed.to_surface[w] - turn * plate.to_surface[w]).norm(), 0, 1e-15);
  }
  for (std::size_t f = 0; f < 4; ++f) {
    EXPECT_NEAR((placed.plates.front()[f].point - shift - turn * plate.plates.front()[f].point).norm(), 0,
                1e-15);
    EXPECT_NEAR((placed.plates.front()[f].normal - turn * plate.plates.front()[f].normal).norm(), 0, 1e-15);
  }
}

TEST(SamplePlate, InSpaceHasSixFaces) {
  const Boundary body = sample_body(BoxShape{{0.1, 0.6, 0.5}}, kSpacing, kSupport, 3);
  ASSERT_EQ(body.plates.front().size(), 6u);
  EXPECT_NEAR(total(body), kSupport * 2 * (0.2 * 1.2 + 1.2 * 1.0 + 1.0 * 0.2), 1e-12);
}

TEST(SamplePlate, ATurnedPolygonIsOneToo) {
  const Boundary body =
      sample_body(PolygonShape{{{0, 0}, {0.8, 0.6}, {0.74, 0.68}, {-0.06, 0.08}}}, kSpacing, kSupport, 2);
  ASSERT_EQ(body.plates.front().size(), 4u);
  EXPECT_NEAR(total(body), kSupport * 2 * (1.0 + 0.1), 1e-12);
}

}  // namespace
}  // namespace sluice::fluid
