#include "fluid/lagged_acceleration.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr double kAcousticTime = 1e-3;  // [s]

Kinematics accelerated(double a) {
  Kinematics k;
  k.acceleration = Vector3d(a, 0, 0);
  k.angular_acceleration = Vector3d(0, 0, 2 * a);
  return k;
}

TEST(LaggedAcceleration, OfAPrescribedBodyIsThePresentOne) {
  LaggedAcceleration lagged(false, kAcousticTime);
  for (const double a : {1.0, -3.0, 7.0}) {
    Kinematics k = accelerated(a);
    lagged.replace(k, 1e-4);
    EXPECT_EQ(k.acceleration, Vector3d(a, 0, 0));
    EXPECT_EQ(k.angular_acceleration, Vector3d(0, 0, 2 * a));
  }
}

TEST(LaggedAcceleration, OfAFreeBodyTendsToAConstantOne) {
  LaggedAcceleration lagged(true, kAcousticTime);
  Kinematics k = accelerated(0.0);
  lagged.replace(k, 0.0);
  const double dt = 1e-4, end = 0.1;
  for (int n = 0; n < end / dt; ++n) {
    k = accelerated(9.81);
    lagged.replace(k, dt);
  }
  // exp(-end / (20 h/c0)) of the step is left, to first order in dt.
  EXPECT_NEAR(k.acceleration.x() / 9.81, 1.0 - std::exp(-end / (20 * kAcousticTime)), 1e-4);
}

// The force on a light body answers to its acceleration with -ratio m a: without a lag that grows by `ratio`
// a step.
TEST(LaggedAcceleration, AddedMassManyTimesTheBodysIsStable) {
  for (const double ratio : {0.5, 5.0, 80.0}) {
    LaggedAcceleration lagged(true, kAcousticTime);
    double a = 1.0, largest = 0.0;
    for (int n = 0; n < 20000; ++n) {
      Kinematics k = accelerated(a);
      lagged.replace(k, 0.4 * kAcousticTime);
      a = 1.0 - ratio * k.acceleration.x();
      if (n > 10000) largest = std::max(largest, std::abs(a - 1.0 / (1.0 + ratio)));
    }
    EXPECT_LT(largest, 1e-9) << ratio;
  }
}

}  // namespace
}  // namespace sluice::fluid
