#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "rigid/world.hpp"

namespace sluice::rigid {
namespace {

constexpr double kGravity = 9.81;

BodySpec body(Shape shape, const Eigen::Vector3d& position, double restitution) {
  BodySpec spec;
  spec.name = "body";
  spec.shape = std::move(shape);
  spec.mass = 2;
  spec.pose.position = position;
  spec.contact.restitution = restitution;
  return spec;
}

WorldSpec above_floor(int dimension, std::vector<BodySpec> bodies) {
  WorldSpec spec;
  spec.dimension = dimension;
  spec.gravity = -kGravity * Eigen::Vector3d::Unit(dimension - 1);
  spec.tank.max = {10, 10, 10};
  spec.tank.closed[static_cast<std::size_t>(2 * (dimension - 1))] = true;
  spec.bodies = std::move(bodies);
  return spec;
}

void run(World& simulated, double duration, double dt, const std::function<void()>& look = {}) {
  const std::vector<Wrench> none(simulated.size());
  const int steps = static_cast<int>(std::lround(duration / dt));
  for (int n = 1; n <= steps; ++n) {
    simulated.predict(n * dt, dt);
    simulated.correct(dt, none);
    if (look) look();
  }
}

// Highest point after the first impact, over the height of the fall.
double rebound_height(int dimension, const Shape& shape, double half, double fall, double restitution,
                      double dt) {
  const int up = dimension - 1;
  Eigen::Vector3d start(5, 5, dimension == 3 ? 5 : 0);
  start[up] = half + fall;
  World simulated(above_floor(dimension, {body(shape, start, restitution)}));
  double highest = 0;
  bool rose = false, fell = false;
  double before = 0;
  run(simulated, 1.6 * std::sqrt(2 * fall / kGravity) * (1 + restitution), dt, [&] {
    const double speed = simulated.state(0).velocity[up];
    rose = rose || (before < 0 && speed > 0);
    fell = fell || (rose && speed < 0);
    if (rose && !fell) highest = std::max(highest, simulated.state(0).position[up] - half);
    before = speed;
  });
  return highest / fall;
}

TEST(Restitution, rebound_height_is_its_square_at_any_step) {
  for (const double dt : {2e-3, 1.1e-3, 5e-4, 1.3e-4})
    for (const double fall : {0.31, 0.5}) {
      // The apex lies between two steps: off by up to g dt^2 / 8.
      const double apex = kGravity * dt * dt / 8 / fall;
      EXPECT_NEAR(rebound_height(2, Ball{0.1}, 0.1, fall, 0.8, dt), 0.64, 2e-5 + 4 * apex) << dt;
      EXPECT_NEAR(rebound_height(3, Ball{0.1}, 0.1, fall, 0.5, dt), 0.25, 2e-5 + 4 * apex) << dt;
      EXPECT_NEAR(rebound_height(2, Box{{0.1, 0.05, 0}}, 0.05, fall, 0.6, dt), 0.36, 2e-5 + 4 * apex) << dt;
    }
}

TEST(Restitution, bouncing_comes_to_rest) {
  World simulated(above_floor(2, {body(Ball{0.1}, {5, 0.3, 0}, 0.5)}));
  run(simulated, 3, 5e-4);
  EXPECT_NEAR(simulated.state(0).position.y(), 0.1, 1e-5);
  EXPECT_LT(std::abs(simulated.state(0).velocity.y()), 2 * kGravity * 5e-4);
}

TEST(Restitution, equal_discs_swap_their_velocities) {
  BodySpec left = body(Ball{0.1}, {1, 0, 0}, 1), right = body(Ball{0.1}, {1.5, 0, 0}, 0);
  left.velocity = {2, 0, 0};
  right.name = "right";
  WorldSpec spec = above_floor(2, {left, right});
  spec.gravity.setZero();
  spec.tank.closed = {};
  World simulated(std::move(spec));
  run(simulated, 0.5, 1e-3);
  EXPECT_NEAR(simulated.state(0).velocity.x(), 0, 1e-9);
  EXPECT_NEAR(simulated.state(1).velocity.x(), 2, 1e-9);
  // They met at t = 0.15 s.
  EXPECT_NEAR(simulated.state(1).position.x(), 1.5 + 2 * 0.35, 1e-6);
}

// A box pushed off with v on the floor slides v^2 / (2 mu g).
TEST(Friction, box_slides_as_far_as_coulomb_lets_it) {
  for (const double friction : {0.1, 0.4}) {
    BodySpec box = body(Box{{0.1, 0.05, 0}}, {1, 0.05, 0}, 0);
    box.velocity = {1, 0, 0};
    box.contact.friction = friction;
    WorldSpec spec = above_floor(2, {box});
    spec.contact.friction = friction;
    World simulated(std::move(spec));
    run(simulated, 2, 5e-4);
    EXPECT_NEAR(simulated.state(0).position.x() - 1, 1 / (2 * friction * kGravity), 0.01 / friction * 0.1);
    EXPECT_LT(simulated.state(0).velocity.norm(), 1e-2);
  }
}

TEST(Locks, body_moves_along_and_about_free_axes_only) {
  BodySpec brick = body(Box{{0.1, 0.2, 0.3}}, {5, 5, 5}, 0);
  brick.velocity = {1, 2, 3};
  brick.angular_velocity = {1, 2, 3};
  brick.locked = {true, false, false};
  brick.locked_rotation = {true, false, true};
  WorldSpec spec = above_floor(3, {brick});
  spec.tank.closed = {};
  World simulated(std::move(spec));
  std::vector<Kinematics> step;
  for (int n = 1; n <= 1000; ++n) {
    step = simulated.predict(n * 1e-3, 1e-3);
    simulated.correct(1e-3, std::vector<Wrench>{{{7, 0, 0}, {5, 0.04, 3}}});
  }
  const Kinematics end = simulated.state(0);
  EXPECT_EQ(end.position.x(), 5);
  EXPECT_NEAR(end.position.y(), 7, 1e-12);
  EXPECT_NEAR(end.position.z(), 8 - kGravity / 2, 1e-9);
  EXPECT_EQ(end.angular_velocity.x(), 0);
  EXPECT_EQ(end.angular_velocity.z(), 0);
  // About y: I = m (a^2 + c^2) / 12, the first half step without moment.
  const double inertia = 2 * (0.04 + 0.36) / 12;
  EXPECT_NEAR(end.angular_velocity.y(), 2 + 0.04 / inertia * (1 - 0.5e-3), 1e-12);
}

TEST(Release, motion_goes_on_as_a_free_one) {
  BodySpec gate = body(Box{{0.01, 0.1, 0}}, {5, 5, 0}, 0);
  gate.motion = constant_velocity({0, 0.7, 0}, {0, 0, 0.4}, 0.1);
  gate.release = 0.5;
  WorldSpec spec = above_floor(2, {gate});
  World simulated(std::move(spec));
  EXPECT_TRUE(simulated.has_free_bodies());
  const double dt = 1e-3;
  const std::vector<Wrench> none(1);
  Eigen::Vector3d before(5, 5, 0);
  for (int n = 1; n <= 900; ++n) {
    const Kinematics step = simulated.predict(n * dt, dt)[0];
    simulated.correct(dt, none);
    ASSERT_NEAR((step.position - before).norm(), step.velocity.norm() * dt, 1e-14);
    before = step.position;
    const double t = n * dt, free = std::max(0.0, t - 0.5);
    const double exact = 5 + 0.7 * std::max(0.0, t - 0.1) - kGravity * free * free / 2;
    ASSERT_NEAR(step.position.y(), exact, 1e-11) << t;
    ASSERT_NEAR(2 * std::asin(step.orientation.z()), 0.4 * std::max(0.0, t - 0.1), 1e-12);
  }
}

}  // namespace
}  // namespace sluice::rigid
