#include "fluid/boundary_velocity.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/fluid/search_oracle.hpp"
#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing = 0.1;

// Fluid above a floor at y = 0 with a given velocity, and what a particle of the floor makes of it.
class Floor {
 public:
  explicit Floor(bool no_slip) : scene_(2, kSpacing, 9.81, 10.0) {
    const Tank tank{.min = {0, 0, 0},
                    .max = {3, 1, 0},
                    .closed = {false, false, true, false, false, false},
                    .no_slip = no_slip};
    scene_.setup.liquid.viscosity = 1.0;
    scene_.setup.walls = sample_walls(tank, kSpacing, scene_.support(), 2);
    scene_.setup.fluid.position.emplace_back(0, 0, 0);
  }

  // What the particles of the floor took from the fluid in the step before.
  struct Before {
    double one_sided = 0, pressure = 1e5;  // [-], [Pa]
  };

  // Largest difference of velocity to `expected(x)` over particles of the floor that see fluid all around
  // them, of at most `layers` layers, with that share of their sticking velocity.
  template <typename Flow, typename Expected>
  double worst(const Flow& flow, const Expected& expected, int layers, double share = 1.0) {
    return worst(flow, expected, layers, share, Before{});
  }
  template <typename Flow, typename Expected>
  double worst(const Flow& flow, const Expected& expected, int layers, double share, const Before& before) {
    std::vector<Vec<2>> places;
    for (int a = 0; a < 30; ++a)
      for (int b = 0; b < 10; ++b) places.emplace_back(kSpacing * (a + 0.5), kSpacing * (b + 0.5));
    Particles<2> fluid = particles_at<2>(places);
    for (Node<2>& node : fluid.node) node.v = flow(node.x);
    BoundaryParticles<2> boundary(scene_.setup);
    const Model<2> model(scene_.setup);
    std::vector<std::uint32_t> all(fluid.size());
    std::iota(all.begin(), all.end(), 0u);
    double worst = 0;
    for (std::size_t w = 0; w < boundary.size(); ++w) {
      const Vec<2> x = boundary.node()[w].x;
      if (x[0] < 0.5 || x[0] > 2.5 || x[1] < -kSpacing * layers) continue;
      boundary.one_sided[w] = before.one_sided;
      boundary.pressure[w] = before.pressure;
      mirror_velocity<2>(model, fluid, all, w, boundary);
      const Vec<2> sticking = boundary.sticks() ? boundary.sticking[w] : Vec<2>::Zero();
      worst = std::max(worst, (boundary.node()[w].v + share * sticking - expected(x)).norm());
    }
    return worst;
  }

 private:
  Scene scene_;
};

TEST(MirrorVelocity, FlowAlongASlipWallGoesOn) {
  const auto flow = [](const Vec<2>& x) { return Vec<2>(2.0 - 0.7 * x[0], 0.0); };
  EXPECT_LT(Floor(false).worst(flow, flow, 2), 1e-12);
}

TEST(MirrorVelocity, FlowThatComesToRestAtASlipWallChangesSign) {
  const auto stagnation = [](const Vec<2>& x) { return Vec<2>(x[0], -x[1]); };
  EXPECT_LT(Floor(false).worst(stagnation, stagnation, 1), 1e-12);
}

TEST(MirrorVelocity, TheImageOfASingleRowIsAsFast) {
  const auto impact = [](const Vec<2>& x) { return Vec<2>(x[0], -2.0); };
  const auto image = [](const Vec<2>& x) { return Vec<2>(x[0], 2.0); };
  EXPECT_LT(Floor(false).worst(impact, image, 2, 1.0, {.one_sided = kSingleRow}), 1e-12);
  EXPECT_LT(Floor(false).worst(impact, image, 2, 1.0, {.one_sided = 1.0}), 1e-12);
}

// Off a wall the fluid is followed by p/(rho c0) and a twentieth of c0 = 10 m/s, no further.
TEST(MirrorVelocity, BeyondTheSpeedThatSoundGivesAVoidOpens) {
  const double most = 1e4 / (1000.0 * 10.0) + kParting * 10.0;
  const auto off = [&](double speed) { return [speed](const Vec<2>&) { return Vec<2>(0.0, speed); }; };
  const auto worst = [&](double speed, double image) {
    return Floor(false).worst(off(speed), off(image), 2, 1.0, {.one_sided = 1.0, .pressure = 1e4});
  };
  EXPECT_LT(worst(0.9 * most, -0.9 * most), 1e-12);
  EXPECT_LT(worst(most + 3.0, 3.0 - most), 1e-12) << "both beside a surface at 3 m/s";
  EXPECT_LT(worst(-most - 3.0, most + 3.0), 1e-12) << "against the wall";
}

TEST(MirrorVelocity, ShearAtANoSlipWallGoesOn) {
  const auto shear = [](const Vec<2>& x) { return Vec<2>(3.0 * x[1], 0.0); };
  EXPECT_LT(Floor(true).worst(shear, shear, 2), 1e-12);
}

TEST(MirrorVelocity, TheDivergenceDoesNotSeeThatANoSlipWallSticks) {
  const auto flow = [](const Vec<2>& x) { return Vec<2>(2.0 - 0.7 * x[0], 0.0); };
  EXPECT_LT(Floor(true).worst(flow, flow, 2, 0.0), 1e-12);
}

TEST(MirrorVelocity, ASlipWallDoesNotSeeShear) {
  const auto shear = [](const Vec<2>& x) { return Vec<2>(3.0 * x[1], 0.0); };
  EXPECT_GT(Floor(false).worst(shear, shear, 1), 0.1);
}

}  // namespace
}  // namespace sluice::fluid
