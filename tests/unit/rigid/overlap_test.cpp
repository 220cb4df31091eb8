#include "rigid/overlap.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <numbers>

namespace sluice::rigid {
namespace {

Pose at(double x, double y, double angle = 0) {
  return {{x, y, 0}, rotation({0, 0, angle})};
}
constexpr double kPi = std::numbers::pi;
const Shape kSquare = Box{{0.5, 0.5, 0}};

TEST(Penetration, boxes_side_by_side) {
  EXPECT_NEAR(penetration(kSquare, at(0, 0), kSquare, at(0.9, 0.1), 2), 0.1, 1e-15);
  EXPECT_NEAR(penetration(kSquare, at(0, 0), kSquare, at(1, 0.1), 2), 0, 1e-15);
  EXPECT_NEAR(penetration(kSquare, at(0, 0), kSquare, at(1.25, 0.1), 2), -0.25, 1e-15);
}

TEST(Penetration, corner_of_a_turned_box_in_a_side) {
  const double reach = std::sqrt(0.5);
  EXPECT_NEAR(penetration(kSquare, at(0, 0), kSquare, at(0.5 + reach - 0.05, 0, kPi / 4), 2), 0.05, 1e-15);
}

TEST(Penetration, ball_at_a_corner_is_measured_along_the_diagonal) {
  const double d = 0.1 / std::sqrt(2.0);
  EXPECT_NEAR(penetration(kSquare, at(0, 0), Ball{0.2}, at(0.5 + d, 0.5 + d), 2), 0.1, 1e-15);
  EXPECT_NEAR(penetration(Ball{0.2}, at(0.5 + 3 * d, 0.5 + 3 * d), kSquare, at(0, 0), 2), -0.1, 1e-15);
}

TEST(Penetration, ball_inside_a_box_leaves_by_the_nearest_side) {
  EXPECT_NEAR(penetration(kSquare, at(0, 0), Ball{0.1}, at(0.3, 0.1), 2), 0.3, 1e-15);
}

TEST(Penetration, balls) {
  EXPECT_NEAR(penetration(Ball{0.3}, at(0, 0), Ball{0.4}, at(0.3, 0.4), 2), 0.2, 1e-15);
  EXPECT_NEAR(penetration(Ball{0.3}, at(0, 0), Ball{0.4}, at(0, 0), 2), 0.7, 1e-15);
}

TEST(Penetration, polygon_against_ball_and_box) {
  const Shape triangle = centred_polygon({{0, 0}, {3, 0}, {0, 3}});  // centroid (1, 1)
  const double d = 0.5 / std::sqrt(2.0);
  EXPECT_NEAR(penetration(triangle, at(1, 1), Ball{0.6}, at(1.5 + d, 1.5 + d), 2), 0.1, 1e-14);
  EXPECT_NEAR(penetration(triangle, at(1, 1), kSquare, at(1, -0.4), 2), 0.1, 1e-14);
}

TEST(Penetration, crossed_edges_need_the_product_axes_in_3d) {
  // Two bars turned by 45 degrees about their own lengths, crossing edge over edge.
  const Shape bar_x = Box{{2, 0.5, 0.5}}, bar_y = Box{{0.5, 2, 0.5}};
  const double ridge = std::sqrt(0.5);
  const Pose below{{0, 0, 0}, rotation({kPi / 4, 0, 0})};
  const Pose above{{0, 0, 2 * ridge - 0.01}, rotation({0, kPi / 4, 0})};
  EXPECT_NEAR(penetration(bar_x, below, bar_y, above, 3), 0.01, 1e-14);
}

RC_GTEST_PROP(Penetration, is_symmetric_and_moves_with_the_frame, (int a, int b, int c, int d)) {
  const auto unit = [](int i) { return static_cast<double>(i % 1000) / 1000; };
  const std::vector<Shape> shapes{kSquare, Ball{0.4},
                                  centred_polygon({{0, 0}, {1, 0}, {0.8, 0.7}, {0.1, 0.9}})};
  const Pose first = at(0, 0, 3 * unit(a)), second = at(unit(b), unit(c), 3 * unit(d));
  const Pose frame = at(10 * unit(d), -5 * unit(a), 2 * unit(b));
  const auto moved = [&](const Pose& pose) {
    return Pose{frame.position + frame.orientation * pose.position, frame.orientation * pose.orientation};
  };
  for (const Shape& s : shapes)
    for (const Shape& t : shapes) {
      const double depth = penetration(s, first, t, second, 2);
      RC_ASSERT(std::abs(depth - penetration(t, second, s, first, 2)) < 1e-13);
      RC_ASSERT(std::abs(depth - penetration(s, moved(first), t, moved(second), 2)) < 1e-12);
    }
}

TEST(Extent, along_any_direction) {
  const Eigen::Vector3d diagonal = Eigen::Vector3d(1, 1, 0).normalized();
  const Interval square = extent(kSquare, at(1, 2), diagonal, 2);
  EXPECT_NEAR(square.max - square.min, std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(square.max + square.min, 2 * 3 / std::sqrt(2.0), 1e-15);
  const Interval turned = extent(Box{{0.5, 0.25, 0.1}}, {{0, 0, 1}, rotation({kPi / 2, 0, 0})}, {0, 0, 1}, 3);
  EXPECT_NEAR(turned.min, 0.75, 1e-15);
  EXPECT_NEAR(turned.max, 1.25, 1e-15);
}

}  // namespace
}  // namespace sluice::rigid
