#include "fluid/wedged.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

constexpr double kSpacing = 0.1;

// A box of 1 x 1 m over a floor at y = 0, its lower side at `gap`, its left one at x = 1.
class Box {
 public:
  explicit Box(double gap) : scene_(2, kSpacing, 9.81, 10.0) {
    const Tank tank{.min = {0, 0, 0}, .max = {3, 3, 0}, .closed = {false, false, true, false, false, false}};
    scene_.setup.walls = sample_walls(tank, kSpacing, scene_.support(), 2);
    scene_.setup.bodies.push_back(sample_body(BoxShape{{0.5, 0.5, 0}}, kSpacing, scene_.support(), 2));
    scene_.setup.fluid.position.emplace_back(0, 0, 0);
    center_ = {1.5, gap + 0.5, 0};
  }

  bool holds(double x, double y) const {
    BoundaryParticles<2> boundary(scene_.setup);
    const Kinematics pose{.position = center_};
    boundary.move({&pose, 1});
    std::vector<std::uint32_t> all(boundary.size());
    std::iota(all.begin(), all.end(), 0u);
    return is_wedged<2>(Model<2>(scene_.setup), Vec<2>(x, y), all, boundary);
  }

 private:
  Scene scene_;
  Eigen::Vector3d center_;
};

TEST(Wedged, InAGapOfASpacing) {
  EXPECT_TRUE(Box(kSpacing).holds(1.5, 0.5 * kSpacing));
}

TEST(Wedged, NotInAGapOfThree) {
  for (const double y : {0.5, 1.5, 2.5}) EXPECT_FALSE(Box(3 * kSpacing).holds(1.5, y * kSpacing)) << y;
}

TEST(Wedged, NotInTheCornerBesideABodyOnTheFloor) {
  EXPECT_FALSE(Box(0).holds(1.0 - 0.5 * kSpacing, 0.5 * kSpacing));
}

TEST(Wedged, NotOnTheFloorAlone) {
  EXPECT_FALSE(Box(5 * kSpacing).holds(0.5, 0.1 * kSpacing));
}

}  // namespace
}  // namespace sluice::fluid
