#include "validation/support/oscillation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice::validation {
namespace {

TEST(Oscillation, IsFoundInItsOwnCurve) {
  Curve curve;
  for (int k = 0; k <= 200; ++k) {
    const double t = 0.02 * k;
    curve.x.push_back(t);
    curve.y.push_back(std::exp(-0.3 * t) * (2 * std::cos(5 * t) - 0.5 * std::sin(5 * t)) + 0.25);
  }
  const Oscillation found = fit_oscillation(curve, {.frequency = 5.2, .cosine = 1});
  EXPECT_NEAR(found.frequency, 5, 1e-9);
  EXPECT_NEAR(found.decay, 0.3, 1e-9);
  EXPECT_NEAR(found.cosine, 2, 1e-9);
  EXPECT_NEAR(found.sine, -0.5, 1e-9);
  EXPECT_NEAR(found.offset, 0.25, 1e-9);
}

}  // namespace
}  // namespace sluice::validation
