// Bodies whose motion is prescribed along some axes and that are free along the others.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/rigid/specs.hpp"
#include "tests/unit/rigid/stepping.hpp"

namespace sluice::rigid {
namespace {

using Eigen::Vector3d;
using Force = std::function<Wrench(double)>;

const Vector3d kDown(0, -9.81, 0);

BodySpec towed(const MotionPtr& motion, double mass = 2) {
  BodySpec spec = body(Box{{0.2, 0.1, 0}}, mass, {1, 2, 0});
  spec.motion = motion;
  spec.free = {false, true, false};
  return spec;
}

// Steps a world of one body under a force of time.
std::vector<Kinematics> go(World& simulated, const Force& force, int from, int to, double dt) {
  std::vector<Kinematics> steps;
  for (int n = from + 1; n <= to; ++n) {
    steps.push_back(simulated.predict(n * dt, dt)[0]);
    simulated.correct(dt, std::vector<Wrench>{force(n * dt)});
  }
  return steps;
}

TEST(PartlyFree, GoesAsPrescribedAlongOneAxisAndFallsAlongTheOther) {
  World simulated(world(2, {towed(expression_motion({"0.3*t + 0.1*t^2", "", "", ""}))}, kDown));
  const double dt = 1e-3;
  const std::vector<Kinematics> steps = go(
      simulated, [](double) { return Wrench{}; }, 0, 1000, dt);
  Vector3d before(1, 2, 0);
  for (std::size_t n = 0; n < steps.size(); ++n) {
    const double t = static_cast<double>(n + 1) * dt;
    ASSERT_NEAR(steps[n].position.x(), 1 + 0.3 * t + 0.1 * t * t, 1e-12);
    ASSERT_NEAR(steps[n].position.y(), 2 - 0.5 * 9.81 * t * t, 1e-11);
    ASSERT_NEAR((steps[n].position - before - dt * steps[n].velocity).norm(), 0, 1e-15);
    ASSERT_NEAR(steps[n].acceleration.x(), 0.2, 1e-6);
    ASSERT_DOUBLE_EQ(steps[n].acceleration.y(), -9.81);
    ASSERT_EQ(steps[n].orientation.coeffs(), Eigen::Quaterniond::Identity().coeffs());
    before = steps[n].position;
  }
  EXPECT_NEAR(simulated.state(0).velocity.x(), 0.3 + 0.2, 1e-9);
  EXPECT_NEAR(simulated.state(0).velocity.y(), -9.81, 1e-12);
}

TEST(PartlyFree, SpinsAsPrescribedWhileItFlies) {
  BodySpec spec = towed(constant_velocity({0, 0, 0}, {0, 0, 3}, 0));
  spec.free = {true, true, false};
  spec.velocity = {0.5, 0, 0};
  World simulated(world(2, {spec}, kDown));
  const Kinematics last = go(
                              simulated,
                              [](double) {
                                return Wrench{{0, 0, 0}, {0, 0, 7}};
                              },
                              0, 500, 1e-3)
                              .back();
  EXPECT_NEAR(last.position.x(), 1 + 0.5 * 0.5, 1e-12);
  EXPECT_NEAR(last.position.y(), 2 - 0.5 * 9.81 * 0.25, 1e-12);
  EXPECT_NEAR(2 * std::atan2(last.orientation.z(), last.orientation.w()), 3 * 0.5, 1e-12);
}

// A moment turns it as if it were free, whatever the way that it is towed.
TEST(PartlyFree, TurnsByTheMomentWhileItIsTowed) {
  BodySpec spec = towed(expression_motion({"sin(5*t)", "0.2*t", "", ""}));
  spec.free = {false, false, false};
  spec.free_rotation = {false, false, true};
  World simulated(world(2, {spec}, kDown));
  simulated.start(std::vector<Wrench>{{{0, 0, 0}, {0, 0, 0.01}}});
  const double inertia = 2 * (0.4 * 0.4 + 0.2 * 0.2) / 12;
  const Kinematics last = go(
                              simulated,
                              [](double) {
                                return Wrench{{5, 6, 0}, {0, 0, 0.01}};
                              },
                              0, 1000, 1e-3)
                              .back();
  EXPECT_NEAR(2 * std::atan2(last.orientation.z(), last.orientation.w()), 0.5 * 0.01 / inertia, 1e-12);
  EXPECT_NEAR(last.position.x(), 1 + std::sin(5.0), 1e-12);
  EXPECT_NEAR(last.position.y(), 2.2, 1e-12);
}

// In space: driven about z, free about x and y. The drive's torque is about z alone, so what is about x and y
// follows from Euler's equations, here for a ball: I dw/dt = T.
TEST(PartlyFree, BallSpunAboutOneAxisTurnsFreelyAboutTheOthers) {
  BodySpec spec = body(Ball{0.1}, 2);
  spec.motion = constant_velocity({0, 0, 0}, {0, 0, 4}, 0);
  spec.free_rotation = {true, true, false};
  World simulated(world(3, {spec}));
  simulated.start(std::vector<Wrench>{{{0, 0, 0}, {0.02, 0, 0}}});
  go(
      simulated,
      [](double) {
        return Wrench{{0, 0, 0}, {0.02, 0, 0}};
      },
      0, 200, 1e-3);
  const double inertia = 0.4 * 2 * 0.01;
  EXPECT_NEAR(simulated.state(0).angular_velocity.x(), 0.02 / inertia * 0.2, 1e-12);
  EXPECT_NEAR(simulated.state(0).angular_velocity.y(), 0, 1e-12);
  EXPECT_NEAR(simulated.state(0).angular_velocity.z(), 4, 1e-12);
}

// A lopsided body driven about z and free about x: the energy that it gains is what the drive did.
TEST(PartlyFree, TheDrivesWorkIsWhereTheEnergyOfASpunBodyComesFrom) {
  const auto error = [](double dt) {
    BodySpec spec = body(Box{{0.1, 0.2, 0.3}}, 2);
    spec.pose.orientation = Eigen::AngleAxisd(0.5, Vector3d(1, 2, 1).normalized());
    spec.motion = constant_velocity({0, 0, 0}, {0, 0, 6}, 0);
    spec.free_rotation = {true, false, false};
    spec.angular_velocity = {1, 0, 0};
    World simulated(world(3, {spec}));
    const double start = simulated.kinetic_energy(0);
    double largest = 0, swing = 0;
    run(simulated, static_cast<int>(std::lround(1 / dt)), dt, [&] {
      const Account account = simulated.account(0);
      largest = std::max(largest, std::abs(account.kinetic_energy - start - account.drive.work));
      swing = std::max(swing, std::abs(account.kinetic_energy - start));
    });
    EXPECT_GT(swing, 0.05);
    return largest;
  };
  const double coarse = error(1e-3), fine = error(5e-4);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_GT(coarse / fine, 3);  // second order
}

// All that changes momentum and energy is in the account: liquid, gravity, drive, a spring; also when it is
// let go.
TEST(PartlyFree, TheAccountCloses) {
  const double dt = 1e-3, mass = 2;
  for (const double release : {1e9, 0.4}) {
    BodySpec spec = towed(expression_motion({"0.2*sin(4*t)", "", "", "0.3*sin(3*t)"}), mass);
    spec.locked = {false, false, false};
    spec.release = release;
    WorldSpec all = world(2, {spec}, kDown);
    JointSpec spring;
    spring.kind = JointSpec::Kind::spring;
    spring.a = 0;
    spring.b = kWorld;
    spring.point = {1.1, 2, 0};
    spring.other_end = {1.5, 2.5, 0};
    spring.stiffness = 30;
    spring.damping = 2;
    all.joints = {spring};
    World simulated(all);
    const Force force = [](double t) {
      return Wrench{{3 * std::cos(t), 20 + t, 0}, {0, 0, 0.1 * std::sin(2 * t)}};
    };
    simulated.start(std::vector<Wrench>{force(0)});
    const Account first = simulated.account(0);
    Vector3d given = Vector3d::Zero();
    double turned = 0, work = 0, fallen = 0;
    for (int n = 1; n <= 800; ++n) {
      const Kinematics k = simulated.predict(n * dt, dt)[0];
      const Wrench before = force((n - 1) * dt), after = force(n * dt);
      simulated.correct(dt, std::vector<Wrench>{after});
      const Vector3d mean = 0.5 * (before.force + after.force);
      given += dt * mean;
      turned += dt * 0.5 * (before.moment.z() + after.moment.z());
      work += dt * mean.dot(k.velocity) +
              dt * 0.5 * (before.moment.z() + after.moment.z()) * k.angular_velocity.z();
      fallen += mass * kDown.dot(dt * k.velocity);
    }
    const Account last = simulated.account(0);
    const Vector3d weight = 0.8 * mass * kDown;
    const Vector3d missing = last.momentum.force - first.momentum.force - given - weight -
                             last.joints.impulse.force - last.drive.impulse.force -
                             last.contact.impulse.force;
    EXPECT_LT(missing.norm(), 1e-12);
    EXPECT_NEAR(last.momentum.moment.z() - first.momentum.moment.z() - turned -
                    last.joints.impulse.moment.z() - last.drive.impulse.moment.z(),
                0, 1e-12);
    EXPECT_GT(last.drive.impulse.force.norm(), 0.1);
    const double gained = last.kinetic_energy - first.kinetic_energy;
    const double errors = gained - work - fallen - last.joints.work - last.drive.work;
    EXPECT_LT(std::abs(errors), 2e-5 * std::abs(last.drive.work) + 2e-5) << release;
  }
}

// An axis that is locked is held by an impulse too.
TEST(PartlyFree, LocksTakeUpWhatTheLiquidGives) {
  BodySpec spec = body(Box{{0.1, 0.1, 0}}, 3);
  spec.locked = {true, false, false};
  World simulated(world(2, {spec}, kDown));
  simulated.start(std::vector<Wrench>{{{5, 0, 0}, {0, 0, 0}}});
  go(
      simulated,
      [](double) {
        return Wrench{{5, 0, 0}, {0, 0, 0}};
      },
      0, 100, 1e-2);
  EXPECT_NEAR(simulated.account(0).drive.impulse.force.x(), -5, 1e-12);
  EXPECT_EQ(simulated.account(0).drive.impulse.force.y(), 0);
  EXPECT_EQ(simulated.account(0).drive.work, 0);
}

TEST(PartlyFree, GoesOnFromItsStateBeforeAndAfterItIsReleased) {
  const Force force = [](double t) { return Wrench{{2 * t, 18, 0}, {0, 0, 0.2}}; };
  BodySpec spec = towed(expression_motion({"0.4*t", "", "", "t"}));
  spec.release = 0.3;
  const WorldSpec all = world(2, {spec}, kDown);
  const double dt = 1e-3;
  for (const int middle : {100, 299, 300, 301, 400}) {
    World whole(all), resumed(all);
    go(whole, force, 0, middle, dt);
    whole.renew_contact();
    const std::vector<double> state = whole.write_state();
    ASSERT_TRUE(resumed.read_state(state).empty());
    EXPECT_EQ(resumed.write_state(), state);
    whole.save();
    const std::vector<Kinematics> once = go(whole, force, middle, 500, dt);
    whole.restore();
    const std::vector<Kinematics> again = go(whole, force, middle, 500, dt);
    const std::vector<Kinematics> other = go(resumed, force, middle, 500, dt);
    for (std::size_t n = 0; n < once.size(); ++n) {
      ASSERT_EQ(once[n].position, again[n].position) << middle;
      ASSERT_EQ(once[n].position, other[n].position) << middle;
      ASSERT_EQ(once[n].orientation.coeffs(), other[n].orientation.coeffs()) << middle;
    }
  }
}

// Towed along the floor it lies on it, and pushes what is in its way.
TEST(PartlyFree, TouchesAsOthersDo) {
  BodySpec pusher = towed(constant_velocity({0.4, 0, 0}, {0, 0, 0}, 0));
  pusher.pose.position = {0.3, 0.1, 0};
  BodySpec pushed = body(Box{{0.1, 0.1, 0}}, 1, {0.601, 0.1, 0});
  WorldSpec all = world(2, {pusher, pushed}, kDown);
  all.tank.max = {3, 1, 0};
  all.tank.closed[2] = true;
  World simulated(all);
  run(simulated, 1000, 1e-3, [&] {
    EXPECT_NEAR(simulated.state(0).position.y(), 0.1, 1e-6);
    EXPECT_NEAR(simulated.state(1).position.y(), 0.1, 1e-4);
  });
  EXPECT_NEAR(simulated.state(0).position.x(), 0.7, 1e-12);
  EXPECT_NEAR(simulated.state(1).position.x(), 1.0, 1e-3);
  EXPECT_NEAR(simulated.account(0).contact.impulse.force.y(), 2 * 9.81, 0.02 * 2 * 9.81);
}

TEST(PartlyFree, NeedsAMass) {
  EXPECT_THROW(World(world(2, {towed(constant_velocity({1, 0, 0}, {0, 0, 0}, 0), 0)})),
               std::invalid_argument);
}

}  // namespace
}  // namespace sluice::rigid
