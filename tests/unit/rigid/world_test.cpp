#include "rigid/world.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/unit/rigid/specs.hpp"

namespace sluice::rigid {
namespace {

constexpr double kGravity = 9.81;
using Force = std::function<Wrench(const Kinematics&, double)>;

// A floor and two side walls.
WorldSpec in_tank(std::vector<BodySpec> bodies) {
  WorldSpec spec = world(2, std::move(bodies), {0, -kGravity, 0});
  spec.tank.max = {1, 1, 0};
  spec.tank.closed = {true, true, true, false, false, false};
  return spec;
}

// Steps the world with the same force on every body; gives the last step's kinematics.
std::vector<Kinematics> run(World& simulated, int steps, double dt, const Force& force = {}) {
  std::vector<Kinematics> last;
  for (int n = 1; n <= steps; ++n) {
    last = simulated.predict(n * dt, dt);
    std::vector<Wrench> wrenches(simulated.size());
    for (std::size_t b = 0; force && b < wrenches.size(); ++b) wrenches[b] = force(last[b], n * dt);
    simulated.correct(dt, wrenches);
  }
  return last;
}

TEST(World, free_fall_is_exact) {
  BodySpec ball = body(Ball{0.1}, 2, {0, 1000, 0});
  ball.velocity = {3, 0, 0};
  World simulated(world(2, {ball}, {0, -kGravity, 0}));
  const double dt = 1e-5;
  const int steps = 100000;
  run(simulated, steps, dt);
  const double t = steps * dt;
  const Kinematics end = simulated.state(0);
  EXPECT_NEAR(end.position.x(), 3 * t, 1e-9);
  EXPECT_NEAR(end.position.y(), 1000 - kGravity * t * t / 2, 1e-8);  // 1e5 roundings at 1000 m
  EXPECT_NEAR(end.velocity.y(), -kGravity * t, 1e-10);
}

double oscillator_error(double dt) {
  const double mass = 2, stiffness = 50, drive = 3, omega = 4, omega0 = std::sqrt(stiffness / mass);
  World simulated(world(2, {body(Ball{0.1}, mass)}));
  const Force force = [&](const Kinematics& k, double t) {
    Wrench wrench;
    wrench.force.x() = -stiffness * k.position.x() + drive * std::sin(omega * t);
    return wrench;
  };
  const int steps = static_cast<int>(std::lround(2.0 / dt));
  run(simulated, steps, dt, force);
  const double amplitude = drive / mass / (omega0 * omega0 - omega * omega), t = steps * dt;
  const double exact = amplitude * (std::sin(omega * t) - omega / omega0 * std::sin(omega0 * t));
  return std::abs(simulated.state(0).position.x() - exact);
}

TEST(World, forced_oscillator_is_of_second_order) {
  const double coarse = oscillator_error(2e-3), middle = oscillator_error(1e-3),
               fine = oscillator_error(5e-4);
  EXPECT_LT(fine, 1e-6);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.02);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.02);
}

TEST(World, planar_bodies_keep_exact_zeros) {
  BodySpec box = body(Box{{0.05, 0.03, 0}}, 1, {0.5, 0.3, 0});
  box.pose.orientation = rotation({0, 0, 0.4});
  box.angular_velocity = {0, 0, 5};
  World simulated(in_tank({box, body(Ball{0.04}, 1, {0.45, 0.5, 0})}));
  const Force noisy = [](const Kinematics&, double t) {
    return Wrench{{std::sin(t), 0, 0.3}, {0.2, -0.1, 0.01}};
  };
  for (int n = 1; n <= 5000; ++n) {
    const auto step = simulated.predict(n * 1e-4, 1e-4);
    simulated.correct(1e-4, std::vector<Wrench>{noisy(step[0], n), noisy(step[1], n)});
    for (const Kinematics& k : step) {
      ASSERT_EQ(k.position.z(), 0);
      ASSERT_EQ(k.velocity.z(), 0);
      ASSERT_EQ(k.orientation.x(), 0);
      ASSERT_EQ(k.orientation.y(), 0);
      ASSERT_EQ(k.angular_velocity.x(), 0);
      ASSERT_EQ(k.angular_velocity.y(), 0);
      ASSERT_EQ(k.acceleration.z(), 0);
    }
  }
}

TEST(World, prescribed_pose_is_its_formula) {
  BodySpec gate = body(Box{{0.01, 0.2, 0}}, 0, {0.3, 0.2, 0});
  gate.pose.orientation = rotation({0, 0, 0.1});
  gate.motion = expression_motion({"0.02*sin(2*pi*t)", "0.7*t", "", "0.3*t^2"});
  World simulated(world(2, {gate}));
  const double dt = 1.7e-4;
  for (int n = 1; n <= 3000; ++n) {
    const double t = n * dt;
    const Kinematics k = simulated.predict(t, dt)[0];
    ASSERT_NEAR(k.position.x(), 0.3 + 0.02 * std::sin(2 * std::numbers::pi * t), 1e-14);
    ASSERT_NEAR(k.position.y() / (0.2 + 0.7 * t), 1, 1e-14);
    const double half = (0.1 + 0.3 * t * t) / 2;
    ASSERT_NEAR(k.orientation.w(), std::cos(half), 1e-14);
    ASSERT_NEAR(k.orientation.z(), std::sin(half), 1e-14);
  }
}

TEST(World, prescribed_velocities_sum_to_the_displacement) {
  BodySpec gate = body(Box{{0.01, 0.2, 0}}, 0);
  gate.motion = keyframe_motion({{0.05, {0, 0, 0}, 0}, {0.2, {0.1, -0.3, 0}, 2}});
  World simulated(world(2, {gate}));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double turn = 0;
  for (int n = 1; n <= 2500; ++n) {
    const Kinematics k = simulated.predict(n * 1e-4, 1e-4)[0];
    sum += 1e-4 * k.velocity;
    turn += 1e-4 * k.angular_velocity.z();
    ASSERT_LT((sum - k.position).norm(), 1e-13);
  }
  EXPECT_NEAR(turn, 2, 1e-13);
}

TEST(World, free_velocities_sum_to_the_displacement_through_contact) {
  BodySpec box = body(Box{{0.05, 0.03, 0}}, 1, {0.5, 0.2, 0});
  box.angular_velocity = {0, 0, 8};
  World simulated(in_tank({box}));
  Eigen::Vector3d sum = box.pose.position;
  double turn = 0;
  for (int n = 1; n <= 10000; ++n) {
    const Kinematics k = simulated.predict(n * 1e-4, 1e-4)[0];
    simulated.correct(1e-4, std::vector<Wrench>(1));
    sum += 1e-4 * k.velocity;
    turn += 1e-4 * k.angular_velocity.z();
    ASSERT_LT((sum - k.position).norm(), 1e-9) << n;
    ASSERT_NEAR(std::abs((rotation({0, 0, turn}).conjugate() * k.orientation).w()), 1, 1e-9) << n;
  }
}

TEST(World, spinning_box_in_the_plane_keeps_its_angular_velocity) {
  BodySpec box = body(Box{{0.1, 0.05, 0}}, 3);
  box.angular_velocity = {0, 0, 12};
  World simulated(world(2, {box}));
  const double start = simulated.state(0).angular_velocity.z();
  const int steps = 20000;
  const auto last = run(simulated, steps, 1e-4);
  EXPECT_DOUBLE_EQ(start, 12);
  EXPECT_EQ(simulated.state(0).angular_velocity.z(), start);
  EXPECT_EQ(last[0].angular_velocity.z(), start);
  const Eigen::Quaterniond expected =
      rotation({0, 0, std::remainder(12 * steps * 1e-4, 2 * std::numbers::pi)});
  EXPECT_NEAR(std::abs(expected.dot(last[0].orientation)), 1, 1e-12);
}

struct Drift {
  double energy, momentum;
};
// Largest relative change over 10 s of a brick tumbling about its unstable middle axis.
Drift tumble(double dt) {
  BodySpec brick = body(Box{{0.1, 0.2, 0.3}}, 5);
  brick.angular_velocity = {0.01, 6, 0.02};
  World simulated(world(3, {brick}));
  const auto momentum = [&] {
    const Kinematics k = simulated.state(0);
    const Eigen::Vector3d inertia = 5 * solid(brick.shape, 3).inertia / solid(brick.shape, 3).volume;
    return Eigen::Vector3d(k.orientation *
                           inertia.cwiseProduct(k.orientation.conjugate() * k.angular_velocity));
  };
  const double energy0 = simulated.kinetic_energy(0);
  const Eigen::Vector3d momentum0 = momentum();
  Drift largest{0, 0};
  bool flipped = false;
  for (int n = 1; n <= std::lround(10 / dt); ++n) {
    simulated.predict(n * dt, dt);
    simulated.correct(dt, std::vector<Wrench>(1));
    largest.energy = std::max(largest.energy, std::abs(simulated.kinetic_energy(0) / energy0 - 1));
    largest.momentum = std::max(largest.momentum, (momentum() - momentum0).norm() / momentum0.norm());
    const Kinematics k = simulated.state(0);
    flipped = flipped || (k.orientation.conjugate() * k.angular_velocity).y() < -5;
  }
  EXPECT_TRUE(flipped) << "the brick did not tumble; the test shows nothing";
  return largest;
}

TEST(World, tumbling_brick_keeps_energy_and_momentum) {
  const Drift coarse = tumble(1e-3), fine = tumble(5e-4);
  RecordProperty("energy_change_at_1ms", std::to_string(coarse.energy));
  std::cout << "tumbling for 10 s: largest relative change of energy " << coarse.energy << " at 1e-3 s, "
            << fine.energy << " at 5e-4 s; of angular momentum " << coarse.momentum << "\n";
  EXPECT_LT(coarse.energy, 1e-5);
  EXPECT_NEAR(std::log2(coarse.energy / fine.energy), 2, 0.1);
  EXPECT_LT(coarse.momentum, 1e-11);
}

class Resting : public testing::TestWithParam<std::pair<const char*, Shape>> {};

TEST_P(Resting, on_the_floor_without_drift) {
  const Shape& shape = GetParam().second;
  World simulated(in_tank({body(shape, 4, {0.5, 0.1, 0})}));  // lower side at y = 0
  const double dt = 1e-4;
  Kinematics k;
  for (int n = 1; n <= 20000; ++n) {
    k = simulated.predict(n * dt, dt)[0];
    simulated.correct(dt, std::vector<Wrench>(1));
    ASSERT_NEAR(k.position.y(), 0.1, 1e-9) << n;
    ASSERT_LT(std::abs(k.velocity.y()), 1e-6) << n;
  }
  EXPECT_NEAR(k.position.x(), 0.5, 1e-9);
  EXPECT_NEAR(k.orientation.z(), 0, 1e-9);
  EXPECT_NEAR(k.acceleration.y(), 0, 1e-6) << "the floor holds the body";
  EXPECT_NEAR(k.angular_velocity.z(), 0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    World, Resting,
    testing::Values(std::pair{"box", Shape(Box{{0.2, 0.1, 0}})}, std::pair{"disc", Shape(Ball{0.1})},
                    std::pair{"polygon",
                              Shape(centred_polygon({{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.1}}))}),
    [](const auto& instance) { return std::string(instance.param.first); });

TEST(World, dropped_bodies_come_to_rest_on_the_floor_and_on_each_other) {
  const auto slab = centred_polygon({{0, 0}, {0.2, 0}, {0.2, 0.1}, {0, 0.1}});
  const auto cube = centred_polygon({{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}});
  for (const Shape& lower : {Shape(Box{{0.1, 0.05, 0}}), Shape(slab)})
    for (const Shape& upper : {Shape(Box{{0.05, 0.05, 0}}), Shape(cube), Shape(Ball{0.05})}) {
      SCOPED_TRACE(testing::Message() << "shape " << upper.index() << " on shape " << lower.index());
      World simulated(in_tank({body(lower, 4, {0.5, 0.1, 0}), body(upper, 1, {0.5, 0.3, 0})}));
      const auto last = run(simulated, 10000, 1e-4);
      EXPECT_NEAR(last[0].position.y(), 0.05, 1e-6);
      EXPECT_NEAR(last[1].position.y(), 0.15, 1e-6);
      // Nothing holds a disc against rolling.
      EXPECT_LT(last[1].velocity.norm(), std::holds_alternative<Ball>(upper) ? 1e-3 : 1e-6);
    }
}

TEST(World, prescribed_body_pushes_a_free_one) {
  BodySpec pusher = body(Box{{0.05, 0.05, 0}}, 0, {0.2, 0.5, 0});
  pusher.motion = constant_velocity({0.5, 0, 0}, {0, 0, 0}, 0);
  World simulated(world(2, {pusher, body(Box{{0.05, 0.05, 0}}, 1, {0.35, 0.5, 0})}));
  const auto last = run(simulated, 5000, 1e-4);
  EXPECT_NEAR(last[1].position.x() - last[0].position.x(), 0.1, 1e-6);
  EXPECT_NEAR(last[1].velocity.x(), 0.5, 1e-9);
}

TEST(World, friction_stops_a_sliding_box_where_coulomb_says) {
  BodySpec box = body(Box{{0.05, 0.05, 0}}, 1, {0.2, 0.05, 0});
  box.velocity = {1, 0, 0};
  World simulated(in_tank({box}));
  const auto last = run(simulated, 10000, 1e-4);
  EXPECT_NEAR(last[0].position.x(), 0.2 + 1 / (2 * 0.3 * kGravity), 1e-3);
  EXPECT_LT(last[0].velocity.norm(), 1e-9);
}

TEST(World, forces_wake_what_has_long_been_still) {
  World simulated(world(2, {body(Ball{0.1}, 1)}));
  run(simulated, 50000, 1e-3);
  const auto last = run(simulated, 1000, 1e-3, [](const Kinematics&, double) {
    return Wrench{{1e-6, 0, 0}, {0, 0, 0}};
  });
  EXPECT_NEAR(last[0].position.x(), 0.5e-6, 1e-9);
}

TEST(World, starts_from_the_wrench_at_time_zero) {
  World simulated(world(2, {body(Ball{0.1}, 2)}));
  const Wrench push{{4, 0, 0}, {0, 0, 0}};
  simulated.start(std::vector<Wrench>{push});
  const Kinematics k = simulated.predict(0.1, 0.1)[0];
  EXPECT_DOUBLE_EQ(k.velocity.x(), 0.1);  // half a kick of 2 m/s^2
  EXPECT_DOUBLE_EQ(k.acceleration.x(), 2);
}

// A pile of boxes, a body that is let go and one that is carried: half way another world reads the state.
TEST(World, goes_on_to_the_last_bit_from_its_state) {
  std::vector<BodySpec> bodies;
  for (int b = 0; b < 3; ++b) {
    bodies.push_back(body(Box{{0.1, 0.05, 0}}, 1 + b, {0.5 + 0.01 * b, 0.05 + 0.1 * b, 0}));
    bodies.back().contact.restitution = 0.3;
  }
  for (const double release : {0.02, 0.5}) {
    bodies.push_back(body(Ball{0.05}, 0.5, {0.2 + release, 0.6, 0}));
    bodies.back().motion = constant_velocity({0.3, -1, 0}, {0, 0, 2}, 0);
    bodies.back().release = release;
  }
  const Force push = [](const Kinematics& k, double t) {
    return Wrench{{-std::sin(9 * t), -0.1 * k.velocity.y(), 0}, {0, 0, 0.01 * std::cos(t)}};
  };
  const double dt = 5e-4;
  World whole(in_tank(bodies)), resumed(in_tank(bodies));
  const auto advance = [&](World& simulated, int from, int to) {
    std::vector<double> poses;
    for (int n = from + 1; n <= to; ++n) {
      const std::vector<Kinematics> step = simulated.predict(n * dt, dt);
      std::vector<Wrench> wrenches;
      for (const Kinematics& k : step) {
        wrenches.push_back(push(k, n * dt));
        poses.insert(poses.end(), k.position.begin(), k.position.end());
        poses.insert(poses.end(), k.orientation.coeffs().begin(), k.orientation.coeffs().end());
        poses.insert(poses.end(), k.acceleration.begin(), k.acceleration.end());
      }
      simulated.correct(dt, wrenches);
    }
    return poses;
  };
  advance(whole, 0, 300);
  whole.renew_contact();
  const std::vector<double> state = whole.write_state();
  EXPECT_TRUE(resumed.read_state(state).empty());
  EXPECT_EQ(resumed.write_state(), state);
  EXPECT_EQ(advance(whole, 300, 1500), advance(resumed, 300, 1500));
  for (std::size_t b = 0; b < bodies.size(); ++b)
    EXPECT_EQ(whole.account(b).contact.work, resumed.account(b).contact.work);
  EXPECT_THROW(resumed.read_state(std::span(state).first(state.size() - 1)), std::invalid_argument);
}

TEST(World, refuses_what_it_cannot_integrate) {
  EXPECT_THAT([] { World(world(2, {body(Ball{0.1}, 0)})); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("body 'body' is free")));
  BodySpec jumping = body(Ball{0.1}, 0);
  jumping.motion = expression_motion({"1+t", "", "", ""});
  EXPECT_THAT(
      [&] { World(world(2, {jumping})); },
      testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("body 'body': the motion starts at")));

  World simulated(world(2, {body(Ball{0.1}, 1)}));
  EXPECT_THROW(simulated.correct(1e-3, std::vector<Wrench>(2)), std::invalid_argument);
  EXPECT_THAT(([&] {
                simulated.correct(1e-3, std::vector<Wrench>{{{NAN, 0, 0}, {0, 0, 0}}});
              }),
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("'body' is not finite")));
  simulated.correct(1, std::vector<Wrench>{{{0, 0, 0}, {0, 0, 1e4}}});
  EXPECT_THAT([&] { simulated.predict(1, 1); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("body 'body' moves at")));
}

}  // namespace
}  // namespace sluice::rigid
