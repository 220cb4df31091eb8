// What joints give to bodies, in impulse and work.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/rigid/specs.hpp"

namespace sluice::rigid {
namespace {

using Eigen::Vector3d;

constexpr double kMass = 3;
const Vector3d kGravity(0, -9.81, 0);

// A rod on a hinge at its left end, which starts level and is pushed by a force of time.
struct Swing {
  explicit Swing(const JointSpec& hinge) : world(spec(hinge)) {}

  static WorldSpec spec(const JointSpec& hinge) {
    WorldSpec all = rigid::world(2, {body(Box{{0.5, 0.05, 0}}, kMass, {0.5, 0, 0})}, kGravity);
    all.joints = {hinge};
    return all;
  }

  void go(double until, double dt) {
    const auto force = [](double t) { return Vector3d(4 * std::sin(7 * t), 3 * std::cos(5 * t), 0); };
    world.start(std::vector<Wrench>{{force(0), Vector3d::Zero()}});
    const Account first = world.account(0);
    Vector3d given = Vector3d::Zero();
    double work = 0;
    const int steps = static_cast<int>(std::lround(until / dt));
    for (int n = 1; n <= steps; ++n) {
      const Kinematics k = world.predict(n * dt, dt)[0];
      world.correct(dt, std::vector<Wrench>{{force(n * dt), Vector3d::Zero()}});
      const Vector3d mean = 0.5 * (force((n - 1) * dt) + force(n * dt)) + kMass * kGravity;
      given += dt * mean;
      work += dt * mean.dot(k.velocity);
    }
    const Account last = world.account(0);
    missing_momentum =
        (last.momentum.force - first.momentum.force - given - last.joints.impulse.force).norm();
    missing_energy = last.kinetic_energy - first.kinetic_energy - work - last.joints.work;
    joints = last.joints;
  }

  World world;
  Given joints;
  double missing_momentum = 0, missing_energy = 0;
};

JointSpec hinge() {
  JointSpec spec;
  spec.kind = JointSpec::Kind::hinge;
  return spec;
}

// A bearing holds and does no work.
TEST(JointAccount, HingeGivesAnImpulseAndNoWork) {
  Swing coarse(hinge()), fine(hinge());
  coarse.go(2, 1e-3);
  fine.go(2, 5e-4);
  EXPECT_LT(coarse.missing_momentum, 1e-11);
  EXPECT_GT(coarse.joints.impulse.force.norm(), 10);
  EXPECT_LT(std::abs(coarse.joints.work), 2e-4);
  EXPECT_LT(std::abs(fine.joints.work), 0.3 * std::abs(coarse.joints.work));
  EXPECT_LT(std::abs(coarse.missing_energy), 2e-4);
  EXPECT_LT(std::abs(fine.missing_energy), 0.3 * std::abs(coarse.missing_energy));
}

// What a damper takes is in its work.
TEST(JointAccount, SpringAndDamperWork) {
  JointSpec damped = hinge();
  damped.stiffness = 20;
  damped.damping = 2;
  Swing swing(damped);
  swing.go(2, 1e-3);
  EXPECT_LT(swing.missing_momentum, 1e-11);
  EXPECT_LT(swing.joints.work, -3);
  EXPECT_LT(std::abs(swing.missing_energy), 1e-3);
}

// A stop takes the energy that the body had when it hit it.
TEST(JointAccount, LimitTakesEnergyWhereItIsHit) {
  JointSpec stopped = hinge();
  stopped.lower = -0.5;
  Swing swing(stopped);
  swing.go(1, 1e-4);
  EXPECT_LT(swing.missing_momentum, 1e-11);
  const double fallen = kMass * 9.81 * 0.5 * std::sin(0.5);
  EXPECT_NEAR(swing.joints.work, -fallen, 0.2 * fallen);
  EXPECT_LT(std::abs(swing.missing_energy), 0.01 * fallen);
}

}  // namespace
}  // namespace sluice::rigid
