#include "rigid/shape.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "rigid/polygon.hpp"

namespace sluice::rigid {
namespace {

constexpr double kPi = std::numbers::pi;

Vertices regular(int corners, double radius, const Eigen::Vector2d& center) {
  Vertices vertices;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * kPi * k / corners;
    vertices.push_back(center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return vertices;
}

TEST(Solid, box) {
  const Box box{{0.1, 0.2, 0.3}};
  const Solid plane = solid(box, 2), space = solid(box, 3);
  EXPECT_DOUBLE_EQ(plane.volume, 0.2 * 0.4);
  EXPECT_DOUBLE_EQ(plane.inertia.z(), 0.08 * (0.04 + 0.16) / 12);
  EXPECT_DOUBLE_EQ(space.volume, 0.2 * 0.4 * 0.6);
  EXPECT_DOUBLE_EQ(space.inertia.x(), 0.048 * (0.16 + 0.36) / 12);
  EXPECT_DOUBLE_EQ(space.inertia.y(), 0.048 * (0.04 + 0.36) / 12);
  EXPECT_DOUBLE_EQ(space.inertia.z(), 0.048 * (0.04 + 0.16) / 12);
}

TEST(Solid, ball) {
  EXPECT_DOUBLE_EQ(solid(Ball{0.5}, 2).volume, kPi * 0.25);
  EXPECT_DOUBLE_EQ(solid(Ball{0.5}, 2).inertia.z(), kPi * 0.25 * 0.25 / 2);
  EXPECT_DOUBLE_EQ(solid(Ball{0.5}, 3).volume, kPi / 6);
  EXPECT_DOUBLE_EQ(solid(Ball{0.5}, 3).inertia.x(), 0.4 * kPi / 6 * 0.25);
}

TEST(Solid, right_triangle_has_its_textbook_moment) {
  const double a = 0.3, b = 0.4;  // I about the centroid: a b (a^2 + b^2) / 36
  const Solid triangle = solid(centred_polygon({{5, 7}, {5 + a, 7}, {5, 7 + b}}), 2);
  EXPECT_NEAR(triangle.volume, a * b / 2, 1e-15);
  EXPECT_NEAR(triangle.inertia.z(), a * b * (a * a + b * b) / 36, 1e-15);
}

TEST(Solid, polygon_with_the_corners_of_a_box_is_that_box) {
  const Solid polygon = solid(centred_polygon({{1, 1}, {1.2, 1}, {1.2, 1.4}, {1, 1.4}}), 2);
  const Solid box = solid(Box{{0.1, 0.2, 0}}, 2);
  EXPECT_NEAR(polygon.volume, box.volume, 1e-15);
  EXPECT_NEAR(polygon.inertia.z(), box.inertia.z(), 1e-16);
}

TEST(Solid, polygon_tends_to_the_disc) {
  const Solid polygon = solid(centred_polygon(regular(2000, 0.5, {3, -2})), 2), disc = solid(Ball{0.5}, 2);
  EXPECT_NEAR(polygon.volume / disc.volume, 1, 4e-6);
  EXPECT_NEAR(polygon.inertia.z() / disc.inertia.z(), 1, 8e-6);
}

TEST(CentredPolygon, moves_its_centroid_to_the_origin_wherever_it_was) {
  const Polygon near = centred_polygon(regular(5, 0.1, {0, 0})),
                far = centred_polygon(regular(5, 0.1, {1e3, 1e3}));
  EXPECT_LT(centroid(near.vertices).norm(), 1e-16);
  EXPECT_LT(centroid(far.vertices).norm(), 1e-13);
  for (int k = 0; k < 5; ++k) EXPECT_LT((near.vertices[k] - far.vertices[k]).norm(), 1e-12);
}

TEST(CentredPolygon, names_the_vertex_that_is_wrong) {
  const auto message = [](Vertices vertices) -> std::string {
    try {
      centred_polygon(std::move(vertices));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({{0, 0}, {1, 0}}).find("2 vertices"), std::string::npos);
  EXPECT_NE(message({{0, 0}, {2, 0}, {1, 0.5}, {1, 2}}).find("vertex 2 turns to the right"),
            std::string::npos);
  EXPECT_NE(message({{0, 0}, {0, 1}, {1, 0}}).find("turns to the right"), std::string::npos);  // clockwise
  EXPECT_NE(message({{0, 0}, {1, 0}, {1, 0}, {0, 1}}).find("vertex 2 repeats"), std::string::npos);
  EXPECT_EQ(message({{0, 0}, {1, 0}, {0, 1}, {0, 0.5}}), "");  // collinear is allowed
  Vertices star;
  for (int k = 0; k < 5; ++k) star.push_back(regular(5, 1, {0, 0})[2 * k % 5]);
  EXPECT_NE(message(star).find("winds around"), std::string::npos);
}

TEST(Thickness, is_the_smallest_width) {
  EXPECT_DOUBLE_EQ(thickness(Box{{0.1, 0.2, 0.05}}, 2), 0.2);
  EXPECT_DOUBLE_EQ(thickness(Box{{0.1, 0.2, 0.05}}, 3), 0.1);
  EXPECT_DOUBLE_EQ(thickness(Ball{0.1}, 2), 0.2);
  EXPECT_NEAR(thickness(centred_polygon({{0, 0}, {3, 0}, {0, 4}}), 2), 2.4, 1e-15);
}

TEST(BoundingRadius, reaches_the_farthest_corner) {
  EXPECT_DOUBLE_EQ(bounding_radius(Box{{0.3, 0.4, 1.2}}, 2), 0.5);
  EXPECT_DOUBLE_EQ(bounding_radius(Box{{0.3, 0.4, 1.2}}, 3), 1.3);
  EXPECT_NEAR(bounding_radius(centred_polygon(regular(6, 0.7, {1, 1})), 2), 0.7, 1e-15);
}

}  // namespace
}  // namespace sluice::rigid
