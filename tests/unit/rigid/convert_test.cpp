#include "clients/rigid/convert.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "protocol/scene_check.hpp"

namespace sluice::clients {
namespace {

Scene scene(std::uint32_t dimension) {
  Scene result;
  result.set_dimension(dimension);
  result.set_spacing(0.01);
  result.set_duration(1);
  for (std::uint32_t a = 0; a < dimension; ++a) result.mutable_domain()->add_max(1);
  return result;
}

Body& add_disc(Scene& scene) {
  Body& body = *scene.add_body();
  body.set_name("disc");
  body.mutable_ball()->set_radius(0.1);
  for (std::uint32_t a = 0; a < scene.dimension(); ++a) body.add_position(0.5);
  return body;
}

TEST(ToWorld, mass_follows_from_density_and_dimension) {
  for (const std::uint32_t dimension : {2u, 3u}) {
    Scene given = scene(dimension);
    add_disc(given).set_density(500);
    const double volume = dimension == 2 ? std::numbers::pi * 0.01 : 4.0 / 3 * std::numbers::pi * 0.001;
    EXPECT_NEAR(to_world(protocol::with_defaults(given)).bodies[0].mass, 500 * volume, 1e-12);
  }
}

TEST(ToWorld, gravity_points_down_the_last_axis_and_open_sides_have_no_wall) {
  Scene given = scene(2);
  given.mutable_domain()->add_open(Y_MAX);
  add_disc(given).set_mass(1);
  const rigid::WorldSpec world = to_world(protocol::with_defaults(given));
  EXPECT_EQ(world.gravity, Eigen::Vector3d(0, -9.81, 0));
  EXPECT_THAT(world.tank.closed, testing::ElementsAre(true, true, true, false, false, false));
  EXPECT_EQ(world.tank.max, Eigen::Vector3d(1, 1, 0));
}

TEST(ToWorld, angles_and_twists_in_the_plane_are_about_z) {
  Scene given = scene(2);
  Body& body = add_disc(given);
  body.set_mass(1);
  body.set_angle(0.6);
  body.add_angular_velocity(4);
  const rigid::BodySpec spec = to_world(protocol::with_defaults(given)).bodies[0];
  EXPECT_NEAR(spec.pose.orientation.z(), std::sin(0.3), 1e-16);
  EXPECT_EQ(spec.angular_velocity, Eigen::Vector3d(0, 0, 4));
}

TEST(ToShape, polygon_is_moved_to_its_centroid) {
  Body body;
  for (const auto& [x, y] : {std::pair{5.0, 5.0}, {6.0, 5.0}, {5.0, 8.0}}) {
    Point& vertex = *body.mutable_polygon()->add_vertex();
    vertex.set_x(x);
    vertex.set_y(y);
  }
  const auto polygon = std::get<rigid::Polygon>(to_shape(body, 2));
  EXPECT_NEAR(polygon.vertices[0].x(), -1.0 / 3, 1e-15);
  EXPECT_NEAR(polygon.vertices[0].y(), -1, 1e-15);
}

TEST(ToMotion, errors_carry_the_field_below_the_motion) {
  const auto part = [](const Motion& motion) -> std::string {
    Body body;
    *body.mutable_prescribed() = motion;
    try {
      to_motion(body, 2);
    } catch (const rigid::MotionError& error) {
      return error.part();
    }
    return "none";
  };
  Motion formula, keys, none;
  formula.mutable_expression()->set_angle("1+");
  keys.mutable_keyframes()->add_key()->set_time(1);
  keys.mutable_keyframes()->add_key()->set_time(1);
  EXPECT_EQ(part(formula), "expression.angle");
  EXPECT_EQ(part(keys), "keyframes.key[1].time");
  EXPECT_EQ(part(none), "");
}

}  // namespace
}  // namespace sluice::clients
