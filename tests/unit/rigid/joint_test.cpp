#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "rigid/world.hpp"
#include "tests/unit/rigid/specs.hpp"
#include "tests/unit/rigid/stepping.hpp"

namespace sluice::rigid {
namespace {

constexpr double kGravity = 9.81;
using Kind = JointSpec::Kind;

WorldSpec world(int dimension, std::vector<BodySpec> bodies, std::vector<JointSpec> joints,
                const Eigen::Vector3d& gravity = {0, 0, 0}) {
  WorldSpec spec = world(dimension, std::move(bodies), gravity);
  spec.joints = std::move(joints);
  return spec;
}

JointSpec joint(Kind kind, const Eigen::Vector3d& point,
                const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ()) {
  JointSpec spec;
  spec.kind = kind;
  spec.point = point;
  spec.axis = axis;
  return spec;
}

// A spring from a wall with a damper beside it: x'' = -w0^2 x - 2 z w0 x'.
double oscillator_error(double dt, double damping) {
  const double mass = 2, stiffness = 50, start = 0.3;
  JointSpec spring = joint(Kind::spring, {start, 0, 0});
  spring.other_end = {-1, 0, 0};
  spring.stiffness = stiffness;
  spring.damping = damping;
  spring.rest = 1;
  World simulated(world(2, {body(Ball{0.1}, mass, {start, 0, 0})}, {spring}));
  const int steps = static_cast<int>(std::lround(2.0 / dt));
  run(simulated, steps, dt);
  const double decay = damping / (2 * mass), omega = std::sqrt(stiffness / mass - decay * decay),
               t = steps * dt;
  const double exact =
      start * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
  return std::abs(simulated.state(0).position.x() - exact);
}

TEST(Spring, oscillator_is_of_second_order_with_and_without_damper) {
  for (const double damping : {0.0, 3.0}) {
    const double coarse = oscillator_error(4e-3, damping), middle = oscillator_error(2e-3, damping),
                 fine = oscillator_error(1e-3, damping);
    EXPECT_NEAR(std::log2(coarse / middle), 2, 0.05) << damping;
    EXPECT_NEAR(std::log2(middle / fine), 2, 0.05) << damping;
    EXPECT_LT(fine, 1e-5);
  }
}

// A uniform rod of length l held at its end: w^2 = 3 g / (2 l) for small swings.
struct Pendulum {
  double length = 0.5, amplitude;
  World simulated;

  Pendulum(double angle, int dimension) : amplitude(angle), simulated(make(angle, dimension, length)) {}

  static World make(double angle, int dimension, double length) {
    BodySpec rod = body(Box{{0.001, length / 2, 0.001}}, 3,
                        {length / 2 * std::sin(angle), -length / 2 * std::cos(angle), 0});
    rod.pose.orientation = rotation({0, 0, angle});
    return World(world(dimension, {rod}, {joint(Kind::hinge, {0, 0, 0})}, {0, -kGravity, 0}));
  }
  double angle() const {
    return std::atan2(simulated.state(0).position.x(), -simulated.state(0).position.y());
  }
  double energy() const {
    return simulated.kinetic_energy(0) + 3 * kGravity * simulated.state(0).position.y();
  }
};

TEST(Hinge, pendulum_swings_with_its_period) {
  for (const int dimension : {2, 3}) {
    const double amplitude = 1.0, dt = 1e-3;
    Pendulum pendulum(amplitude, dimension);
    double before = pendulum.angle(), t = 0;
    std::vector<double> crossings;
    run(pendulum.simulated, 8000, dt, [&] {
      t += dt;
      const double now = pendulum.angle();
      if (before > 0 && now <= 0) crossings.push_back(t - dt * now / (now - before));
      before = now;
    });
    // 4 K(sin(A / 2)) / w0
    const double inertia = 0.5 * 0.5 / 3 + 0.002 * 0.002 / 12;
    const double exact =
        4 * std::comp_ellint_1(std::sin(amplitude / 2)) / std::sqrt(kGravity * 0.25 / inertia);
    const auto swings = static_cast<double>(crossings.size() - 1);
    ASSERT_GE(crossings.size(), 5u);
    EXPECT_NEAR((crossings.back() - crossings.front()) / swings / exact, 1, 5e-6) << dimension;
  }
}

double pendulum_error(double dt) {
  Pendulum pendulum(1.2, 2), exact(1.2, 2);
  run(pendulum.simulated, static_cast<int>(std::lround(1 / dt)), dt);
  run(exact.simulated, 20000, 5e-5);
  return std::abs(pendulum.angle() - exact.angle());
}

TEST(Hinge, pendulum_is_of_second_order) {
  EXPECT_NEAR(std::log2(pendulum_error(4e-3) / pendulum_error(2e-3)), 2, 0.05);
}

TEST(Hinge, keeps_point_axis_and_energy) {
  // A brick about an axis askew through its corner, in space.
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 0.3, 0.2).normalized(), corner(0.1, 0.2, 0.3);
  BodySpec brick = body(Box{{0.1, 0.2, 0.3}}, 5, {0, 0, 0});
  World simulated(world(3, {brick}, {joint(Kind::hinge, corner, axis)}, {0, 0, -kGravity}));
  const auto energy = [&] {
    return simulated.kinetic_energy(0) + 5 * kGravity * simulated.state(0).position.z();
  };
  const double start = energy();
  double point_off = 0, axis_off = 0, energy_off = 0;
  run(simulated, 10000, 1e-3, [&] {
    const Kinematics now = simulated.state(0);
    point_off = std::max(point_off, (now.position + now.orientation * corner - corner).norm());
    axis_off = std::max(axis_off, (now.orientation * axis - axis).norm());
    energy_off = std::max(energy_off, std::abs(energy() - start));
    ASSERT_LT((now.velocity + now.angular_velocity.cross(now.orientation * corner)).norm(), 1e-12);
  });
  EXPECT_LT(point_off, 1e-12);
  EXPECT_LT(axis_off, 1e-12);
  EXPECT_LT(energy_off, 1e-3 * 5 * kGravity * 0.37);
}

TEST(Hinge, chain_of_two_keeps_its_energy) {
  BodySpec upper = body(Box{{0.25, 0.01, 0}}, 1, {0.25, 0, 0}),
           lower = body(Box{{0.25, 0.01, 0}}, 2, {0.75, 0, 0});
  lower.name = "lower";
  JointSpec elbow = joint(Kind::hinge, {0.5, 0, 0});
  elbow.a = 1;
  elbow.b = 0;
  World simulated(world(2, {upper, lower}, {joint(Kind::hinge, {0, 0, 0}), elbow}, {0, -kGravity, 0}));
  const auto energy = [&] {
    return simulated.kinetic_energy(0) + simulated.kinetic_energy(1) +
           kGravity * (simulated.state(0).position.y() + 2 * simulated.state(1).position.y());
  };
  double off = 0;
  run(simulated, 20000, 5e-4, [&] { off = std::max(off, std::abs(energy())); });
  EXPECT_LT(off, 2e-3 * kGravity);
}

TEST(Hinge, motor_turns_at_its_speed_until_it_is_too_weak) {
  JointSpec hinge = joint(Kind::hinge, {0, 0, 0});
  hinge.motor = JointSpec::Motor{2, 1e5};
  World strong(world(2, {body(Box{{0.5, 0.1, 0}}, 3, {0.5, 0, 0})}, {hinge}, {0, -kGravity, 0}));
  run(strong, 1000, 1e-3);
  EXPECT_NEAR(strong.state(0).angular_velocity.z(), 2, 5e-3);  // besides what gravity does in half a step
  EXPECT_NEAR(std::atan2(strong.state(0).position.y(), strong.state(0).position.x()), 2, 1e-11);

  hinge.motor = JointSpec::Motor{2, 0.1};
  World weak(world(2, {body(Box{{0.5, 0.1, 0}}, 3, {0.5, 0, 0})}, {hinge}));
  run(weak, 100, 1e-3);
  const double inertia = 3 * (1 + 0.04) / 12 + 3 * 0.25;
  EXPECT_NEAR(weak.state(0).angular_velocity.z(), 0.1 / inertia * 0.1, 1e-9);
}

TEST(Slider, slides_along_its_axis_between_its_limits) {
  for (const int dimension : {2, 3}) {
    JointSpec slider = joint(Kind::slider, {0, 0, 0}, Eigen::Vector3d(1, -1, 0).normalized());
    slider.lower = -0.1;
    slider.upper = 0.4;
    World simulated(
        world(dimension, {body(Box{{0.1, 0.1, 0.1}}, 3, {0, 0, 0})}, {slider}, {0, -kGravity, 0}));
    run(simulated, 200, 1e-3);
    const double way = kGravity * std::sqrt(0.5) * 0.2 * 0.2 / 2;
    Kinematics now = simulated.state(0);
    EXPECT_NEAR(now.position.x(), way * std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(now.position.y(), -way * std::sqrt(0.5), 1e-12);
    run(simulated, 1000, 1e-3);
    now = simulated.state(0);
    EXPECT_NEAR(now.position.norm(), 0.4, 1e-11);
    EXPECT_LT(now.orientation.vec().norm(), 1e-12);
  }
}

TEST(Fixed, two_bodies_move_as_one) {
  BodySpec left = body(Box{{0.1, 0.1, 0.1}}, 1, {-0.1, 0, 0}),
           right = body(Box{{0.1, 0.1, 0.1}}, 1, {0.1, 0, 0});
  right.name = "right";
  left.angular_velocity = right.angular_velocity = {0.3, 0.7, 3};
  left.velocity = left.angular_velocity.cross(left.pose.position);
  right.velocity = right.angular_velocity.cross(right.pose.position);
  JointSpec weld = joint(Kind::fixed, {0, 0, 0});
  weld.b = 1;
  World pair(world(3, {left, right}, {weld}));
  BodySpec whole = body(Box{{0.2, 0.1, 0.1}}, 2, {0, 0, 0});
  whole.angular_velocity = left.angular_velocity;
  World one(world(3, {whole}, {}));
  run(pair, 2000, 5e-4);
  run(one, 2000, 5e-4);
  EXPECT_LT((pair.state(0).position + pair.state(1).position).norm(), 1e-12);
  EXPECT_LT(pair.state(0).orientation.angularDistance(pair.state(1).orientation), 1e-12);
  EXPECT_LT(pair.state(0).orientation.angularDistance(one.state(0).orientation), 1e-4);
}

TEST(Joints, hold_a_free_body_to_a_prescribed_one) {
  BodySpec hand = body(Ball{0.05}, 0, {0, 0, 0}), weight = body(Ball{0.05}, 1, {0, -0.4, 0});
  weight.name = "weight";
  hand.motion = expression_motion({"0.1*sin(3*t)", "", "", ""});
  JointSpec hinge = joint(Kind::hinge, {0, 0, 0});
  hinge.a = 1;
  hinge.b = 0;
  World simulated(world(2, {hand, weight}, {hinge}, {0, -kGravity, 0}));
  double t = 0;
  run(simulated, 2000, 1e-3, [&] {
    t += 1e-3;
    const Kinematics now = simulated.state(1);
    const Eigen::Vector3d held = now.position + now.orientation * Eigen::Vector3d(0, 0.4, 0);
    ASSERT_LT((held - Eigen::Vector3d(0.1 * std::sin(3 * t), 0, 0)).norm(), 1e-12);
  });
}

TEST(Joints, hold_while_their_body_lies_on_the_floor) {
  // A rod on a hinge falls on the floor and stays there.
  WorldSpec spec = world(2, {body(Box{{0.25, 0.02, 0}}, 1, {0.5, 0.3, 0})},
                         {joint(Kind::hinge, {0.25, 0.3, 0})}, {0, -kGravity, 0});
  spec.tank.max = {1, 1, 0};
  spec.tank.closed = {false, false, true, false, false, false};
  World simulated(std::move(spec));
  run(simulated, 4000, 5e-4, [&] {
    const Kinematics now = simulated.state(0);
    ASSERT_LT((now.position + now.orientation * Eigen::Vector3d(-0.25, 0, 0) - Eigen::Vector3d(0.25, 0.3, 0))
                  .norm(),
              1e-12);
  });
  const Kinematics end = simulated.state(0);
  const double lowest = (end.position + end.orientation * Eigen::Vector3d(0.25, -0.02, 0)).y();
  EXPECT_NEAR(lowest, 0, 1e-3);
  EXPECT_LT(end.angular_velocity.norm(), 0.05);
}

}  // namespace
}  // namespace sluice::rigid
