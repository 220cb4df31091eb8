#include "server/geometry.hpp"

#include <gtest/gtest.h>

#include "scene_text.hpp"

namespace sluice::testing {
namespace {

Body body_from(const std::string& text) {
  return tank_with("body { name: 'b' " + text + " }").body(0);
}

TEST(Geometry, MovesAPolygonToItsCentroid) {
  // A right triangle far from the origin: its centroid is a third of the way along each leg.
  const fluid::Shape shape = server::to_shape(
      body_from(
          "polygon { vertex { x: 1000 y: 2000 } vertex { x: 1003 y: 2000 } vertex { x: 1000 y: 2006 } }"),
      2);
  const auto& vertex = std::get<fluid::PolygonShape>(shape).vertices;
  EXPECT_LT((vertex[0] - Eigen::Vector2d(-1, -2)).norm(), 1e-9);
  EXPECT_LT((vertex[1] - Eigen::Vector2d(2, -2)).norm(), 1e-9);
  EXPECT_LT((vertex[2] - Eigen::Vector2d(-1, 4)).norm(), 1e-9);
}

TEST(Geometry, HalvesABoxesSize) {
  const auto box = std::get<fluid::BoxShape>(server::to_shape(body_from("box { size: [0.2, 0.6] }"), 2));
  EXPECT_DOUBLE_EQ(box.half_size.x(), 0.1);
  EXPECT_DOUBLE_EQ(box.half_size.y(), 0.3);
}

TEST(Geometry, StartsAFreeBodyWithItsVelocityAndAPrescribedOneAtRest) {
  const std::string motion =
      "ball { radius: 0.1 } position: [1, 2] angle: 0.5 velocity: [3, 4] angular_velocity: 5 ";
  const fluid::Kinematics free = server::initial_kinematics(body_from(motion), 2);
  EXPECT_EQ(free.position, Eigen::Vector3d(1, 2, 0));
  EXPECT_DOUBLE_EQ(Eigen::AngleAxisd(free.orientation).angle(), 0.5);
  EXPECT_EQ(free.velocity, Eigen::Vector3d(3, 4, 0));
  EXPECT_EQ(free.angular_velocity, Eigen::Vector3d(0, 0, 5));

  const fluid::Kinematics prescribed =
      server::initial_kinematics(body_from(motion + "prescribed { constant {} }"), 2);
  EXPECT_EQ(prescribed.position, Eigen::Vector3d(1, 2, 0));
  EXPECT_TRUE(prescribed.velocity.isZero(0));
  EXPECT_TRUE(prescribed.angular_velocity.isZero(0));
}

TEST(Geometry, ReadsOrientationsInThreeDimensions) {
  Body body;
  for (const double q : {0.5, 0.5, 0.5, 0.5}) body.add_orientation(q);
  EXPECT_TRUE(
      server::initial_kinematics(body, 3).orientation.isApprox(Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5)));
}

TEST(Geometry, MeasuresDistanceInTheBodysPose) {
  const fluid::Shape box = fluid::BoxShape{{2, 1, 0}};
  fluid::Kinematics pose;
  pose.position = {10, 0, 0};
  pose.orientation = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ());  // a quarter turn
  EXPECT_NEAR(server::distance(box, pose, {10, 3, 0}, 2), 1, 1e-12);
  EXPECT_NEAR(server::distance(box, pose, {13, 0, 0}, 2), 2, 1e-12);
  EXPECT_NEAR(server::distance(box, pose, {10, 0, 0}, 2), -1, 1e-12);
}

TEST(Geometry, FindsTheFurthestPointOfEveryShape) {
  const Eigen::Vector3d direction(3, -4, 0);
  EXPECT_DOUBLE_EQ(server::support(fluid::BoxShape{{1, 2, 0}}, direction), 11);
  EXPECT_DOUBLE_EQ(server::support(fluid::BallShape{2}, direction), 10);
  EXPECT_DOUBLE_EQ(server::support(fluid::PolygonShape{{{-5, -4}, {1, -1}, {0, 3}}}, direction), 7);
}

TEST(Geometry, ReadsRegions) {
  const Scene scene = tank_with(
      "fluid { box { min: [0.2, 0.4] max: [0.4, 1] } } "
      "fluid { ball { center: [0.5, 1.5] radius: 0.25 } }");
  const server::Region box = server::to_region(scene.fluid(0)), ball = server::to_region(scene.fluid(1));
  EXPECT_LT((box.center - Eigen::Vector3d(0.3, 0.7, 0)).norm(), 1e-12);
  EXPECT_LT((std::get<fluid::BoxShape>(box.shape).half_size - Eigen::Vector3d(0.1, 0.3, 0)).norm(), 1e-12);
  EXPECT_EQ(ball.center, Eigen::Vector3d(0.5, 1.5, 0));
  EXPECT_EQ(std::get<fluid::BallShape>(ball.shape).radius, 0.25);
}

}  // namespace
}  // namespace sluice::testing
