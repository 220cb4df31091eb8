#include "fluid/body_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fluid/sampling.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSpacing = 0.1, kWidth = 1.0, kHeight = 0.5;

Setup setup_with(double free_mass, int dimension) {
  Setup setup;
  setup.dimension = dimension;
  setup.spacing = kSpacing;
  setup.liquid = {1000, 0, 20};
  const Shape box = BoxShape{{kWidth / 2, kHeight / 2, kHeight / 2}};
  setup.bodies.push_back(sample_body(box, kSpacing, 0.3, dimension));
  setup.bodies.back().free_mass = free_mass;
  return setup;
}

TEST(BodyStep, NothingLimitsAPrescribedBody) {
  EXPECT_TRUE(std::isinf(largest_body_step(setup_with(0.0, 2))));
}

TEST(BodyStep, IsTheTimeInWhichSoundTakesAQuarterOfTheMomentum) {
  const double mass = 25.0;
  EXPECT_NEAR(largest_body_step(setup_with(mass, 2)), mass / (4 * 1000 * 20 * kWidth), 1e-12);
  EXPECT_NEAR(largest_body_step(setup_with(mass, 3)), mass / (4 * 1000 * 20 * kWidth * kHeight), 1e-12);
}

TEST(BodyStep, TheLightestBodyCounts) {
  fluid::Setup setup = setup_with(25.0, 2);
  setup.bodies.push_back(setup.bodies.front());
  setup.bodies.back().free_mass = 2.5;
  EXPECT_NEAR(largest_body_step(setup), 2.5 / (4 * 1000 * 20 * kWidth), 1e-12);
}

}  // namespace
}  // namespace sluice::fluid
