#include "fluid/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sluice::fluid {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Shape kBox = BoxShape{{1.0, 2.0, 3.0}};
const Shape kBall = BallShape{1.5};
const Shape kTriangle = PolygonShape{{{0, 0}, {4, 0}, {0, 3}}};  // 3-4-5

TEST(Shape, DistanceFromABox) {
  EXPECT_DOUBLE_EQ(signed_distance(kBox, {0, 0, 0}, 3), -1.0);
  EXPECT_NEAR(signed_distance(kBox, {0.9, 0, 2.95}, 3), -0.05, 1e-14);
  EXPECT_DOUBLE_EQ(signed_distance(kBox, {0, 2.5, 0}, 3), 0.5);
  EXPECT_DOUBLE_EQ(signed_distance(kBox, {4, 6, 0}, 3), 5.0);
  EXPECT_DOUBLE_EQ(signed_distance(kBox, {-2, -4, -5}, 3), 3.0);
  EXPECT_DOUBLE_EQ(signed_distance(kBox, {1, 0, 0}, 3), 0.0);
}

TEST(Shape, PlanarDistancesDoNotReadZ) {
  EXPECT_DOUBLE_EQ(signed_distance(kBox, {0, 0, 100}, 2), -1.0);
  EXPECT_DOUBLE_EQ(signed_distance(BoxShape{{1.0, 2.0, 0.0}}, {0, 0, 0}, 2), -1.0);
  EXPECT_DOUBLE_EQ(signed_distance(kBall, {0, 1, 100}, 2), -0.5);
  EXPECT_DOUBLE_EQ(signed_distance(kTriangle, {1, 1, 100}, 2), -1.0);
}

TEST(Shape, DistanceFromABall) {
  EXPECT_DOUBLE_EQ(signed_distance(kBall, {0, 0, 0}, 3), -1.5);
  EXPECT_DOUBLE_EQ(signed_distance(kBall, {2, 3, 6}, 3), 5.5);
}

TEST(Shape, DistanceFromATriangle) {
  EXPECT_DOUBLE_EQ(signed_distance(kTriangle, {1, 0.25, 0}, 2), -0.25);
  EXPECT_DOUBLE_EQ(signed_distance(kTriangle, {2, -0.5, 0}, 2), 0.5);
  EXPECT_DOUBLE_EQ(signed_distance(kTriangle, {-3, -4, 0}, 2), 5.0);              // from a corner
  EXPECT_DOUBLE_EQ(signed_distance(kTriangle, {2 + 0.6, 1.5 + 0.8, 0}, 2), 1.0);  // from the long side
}

// A distance: nowhere steeper than 1, and zero where the sign changes.
TEST(Shape, DistancesAreDistances) {
  std::mt19937_64 random(51);
  std::uniform_real_distribution<double> uniform(-5.0, 5.0);
  const auto point = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
  for (int k = 0; k < 2000; ++k) {
    const Vector3d x = point(), y = x + 0.1 * point();
    for (const Shape& shape : {kBox, kBall}) {
      const double change = signed_distance(shape, y, 3) - signed_distance(shape, x, 3);
      EXPECT_LE(std::abs(change), (y - x).norm() + 1e-12);
    }
    const double change = signed_distance(kTriangle, y, 2) - signed_distance(kTriangle, x, 2);
    EXPECT_LE(std::abs(change), (y - x).norm() + 1e-12);
  }
}

TEST(Shape, Volume) {
  EXPECT_NEAR(volume(BoxShape{{1, 2, 3}}, 2), 8, 1e-12);
  EXPECT_NEAR(volume(BoxShape{{1, 2, 3}}, 3), 48, 1e-12);
  EXPECT_NEAR(volume(BallShape{2}, 2), 4 * M_PI, 1e-12);
  EXPECT_NEAR(volume(BallShape{2}, 3), 32 * M_PI / 3, 1e-12);
  EXPECT_NEAR(volume(PolygonShape{{{0, 0}, {3, 0}, {0, 4}}}, 2), 6, 1e-12);
}

TEST(Shape, Thickness) {
  EXPECT_DOUBLE_EQ(thickness(kBox, 3), 2.0);
  EXPECT_DOUBLE_EQ(thickness(BoxShape{{1.0, 2.0, 0.1}}, 3), 0.2);
  EXPECT_DOUBLE_EQ(thickness(BoxShape{{1.0, 2.0, 0.1}}, 2), 2.0);
  EXPECT_DOUBLE_EQ(thickness(kBall, 2), 3.0);
  EXPECT_DOUBLE_EQ(thickness(kTriangle, 2), 2.4);  // 2 area / longest side
}

TEST(Shape, ThicknessOfATurnedRectangle) {
  const Vector2d along(0.8, 0.6), across(-0.6, 0.8);
  const Shape turned = PolygonShape{
      {-along - 0.1 * across, along - 0.1 * across, along + 0.1 * across, -along + 0.1 * across}};
  EXPECT_NEAR(thickness(turned, 2), 0.2, 1e-15);
}

TEST(Shape, BoundsHoldTheShapeTightly) {
  EXPECT_EQ(bounds(kBox, 3).min, Vector3d(-1, -2, -3));
  EXPECT_EQ(bounds(kBox, 3).max, Vector3d(1, 2, 3));
  EXPECT_EQ(bounds(kBall, 3).max, Vector3d(1.5, 1.5, 1.5));
  EXPECT_EQ(bounds(kTriangle, 2).min, Vector3d(0, 0, 0));
  EXPECT_EQ(bounds(kTriangle, 2).max, Vector3d(4, 3, 0));
  for (const Shape& shape : {kBox, kBall}) {
    EXPECT_EQ(bounds(shape, 2).min.z(), 0.0);
    EXPECT_EQ(bounds(shape, 2).max.z(), 0.0);
  }
}

}  // namespace
}  // namespace sluice::fluid
