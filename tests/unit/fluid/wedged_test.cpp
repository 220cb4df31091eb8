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

  // Whether fluid there is a film; `mirrors` are sides besides the floor.
  bool holds(double x, double y, std::span<const Plane<2>> mirrors = {}) const {
    const BoundaryParticles<2> boundary = placed();
    return film_speed<2>(Model<2>(scene_.setup), Vec<2>(x, y), all(boundary), boundary, mirrors).has_value();
  }
  // Whether fluid there is behind a surface.
  bool has_inside(double x, double y) const {
    const BoundaryParticles<2> boundary = placed();
    return is_inside_boundary<2>(Vec<2>(x, y), all(boundary), boundary);
  }

 private:
  BoundaryParticles<2> placed() const {
    BoundaryParticles<2> boundary(scene_.setup);
    const Kinematics pose{.position = center_};
    boundary.move({&pose, 1});
    return boundary;
  }
  static std::vector<std::uint32_t> all(const BoundaryParticles<2>& boundary) {
    std::vector<std::uint32_t> index(boundary.size());
    std::iota(index.begin(), index.end(), 0u);
    return index;
  }

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

TEST(Wedged, InAGapOfASpacingBesideAMirror) {
  const Plane<2> near{Vec<2>::UnitX(), 1.0 - kSpacing}, far{Vec<2>::UnitX(), 1.0 - 2 * kSpacing};
  const Plane<2> facing_away{-Vec<2>::UnitX(), -1.0};
  const Box box(5 * kSpacing);
  EXPECT_TRUE(box.holds(1.0 - 0.5 * kSpacing, 1.0, {&near, 1}));
  EXPECT_FALSE(box.holds(1.0 - 0.5 * kSpacing, 1.0, {&far, 1}));
  EXPECT_FALSE(box.holds(1.0 - 0.5 * kSpacing, 1.0, {&facing_away, 1}));
}

// Around the whole box, its corners included.
TEST(InsideABoundary, BehindItsSurfaceOnly) {
  const double gap = 5 * kSpacing;
  const Box box(gap);
  int inside = 0;
  for (double along = -0.1; along < 1.1; along += 0.017) {
    EXPECT_FALSE(box.has_inside(1.0 + along, gap - 1e-6)) << along;
    EXPECT_FALSE(box.has_inside(1.0 - 1e-6, gap + along)) << along;
    inside += box.has_inside(1.0 + along, gap + 0.3 * kSpacing);
  }
  EXPECT_GT(inside, 50);
}

TEST(Wedged, NotOnTheFloorAlone) {
  EXPECT_FALSE(Box(5 * kSpacing).holds(0.5, 0.1 * kSpacing));
}

}  // namespace
}  // namespace sluice::fluid
