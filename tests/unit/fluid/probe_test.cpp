#include "fluid/probe.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice::fluid {
namespace {

constexpr double kSpacing = 0.02, kDensity = 1000;

// A pool 1 m wide (1 m x 0.2 m in space) and `depth` deep on a lattice, with pressure and velocity linear in
// the place.
Snapshot pool(int dimension, double depth) {
  Snapshot state;
  const int up = dimension - 1;
  const int wide = 50, deep = static_cast<int>(std::lround(depth / kSpacing)),
            across = dimension == 3 ? 10 : 1;
  for (int a = 0; a < wide; ++a)
    for (int b = 0; b < across; ++b)
      for (int c = 0; c < deep; ++c) {
        Eigen::Vector3d x((a + 0.5) * kSpacing, dimension == 3 ? (b + 0.5) * kSpacing : 0, 0);
        x[up] = (c + 0.5) * kSpacing;
        state.position.insert(state.position.end(), x.begin(), x.end());
        state.velocity.insert(state.velocity.end(), {2 * x[up], 0.5 - x.x(), 0});
        state.density.push_back(kDensity);
        state.pressure.push_back(9810 * (depth - x[up]));
      }
  return state;
}

const double kMass[] = {kDensity * kSpacing * kSpacing, kDensity* kSpacing* kSpacing* kSpacing};

ProbedFluid probed(const Snapshot& state, int dimension) {
  return {state, std::span(&kMass[dimension - 2], 1), (dimension == 2 ? 1.45 : 1.49) * kSpacing, dimension};
}

class ProbeIn : public testing::TestWithParam<int> {};

TEST_P(ProbeIn, point_gives_linear_fields_inside_and_at_walls) {
  const int dimension = GetParam(), up = dimension - 1;
  const Snapshot state = pool(dimension, 0.3);
  for (const double height : {0.0, 0.05, 0.153, 0.29}) {
    Eigen::Vector3d x(0.431, dimension == 3 ? 0.103 : 0, 0);
    x[up] = height;
    const PointSample sample = sample_point(probed(state, dimension), x);
    EXPECT_NEAR(sample.pressure, 9810 * (0.3 - height), 1e-8);
    EXPECT_NEAR(sample.velocity.x(), 2 * height, 1e-11);
    EXPECT_NEAR(sample.velocity.y(), 0.5 - 0.431, 1e-11);
    const double wet = height == 0 ? 0.5 : 1;
    if (height == 0 || height == 0.153) {
      EXPECT_NEAR(sample.wetness, wet, 0.02);
    }
  }
}

TEST_P(ProbeIn, point_without_liquid_gives_zeros) {
  const Snapshot state = pool(GetParam(), 0.3);
  Eigen::Vector3d x(0.5, 0.1, 0);
  x[GetParam() - 1] = 0.5;
  const PointSample sample = sample_point(probed(state, GetParam()), x);
  EXPECT_EQ(sample.wetness, 0);
  EXPECT_EQ(sample.pressure, 0);
}

TEST_P(ProbeIn, surface_stands_at_the_depth_of_the_pool) {
  const int dimension = GetParam();
  const Eigen::Vector3d up = Eigen::Vector3d::Unit(dimension - 1);
  for (const double depth : {0.1, 0.3}) {
    const Snapshot state = pool(dimension, depth);
    for (const double x : {0.3, 0.507, 0.711})
      EXPECT_NEAR(surface_height(probed(state, dimension), {x, dimension == 3 ? 0.1 : 0, 0}, up), depth,
                  0.05 * kSpacing);
  }
  const Snapshot shallow = pool(dimension, 0.1);
  EXPECT_FALSE(std::isfinite(surface_height(probed(shallow, dimension), {2, 0, 0}, up)));
}

INSTANTIATE_TEST_SUITE_P(Dimensions, ProbeIn, testing::Values(2, 3));

}  // namespace
}  // namespace sluice::fluid
