#include <gtest/gtest.h>

#include <algorithm>

#include "fluid/sampling.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing = 0.1, kSupport = 0.29;  // three layers

Boundary walls(std::vector<Opening> openings,
               std::array<bool, 6> closed = {true, true, true, true, true, true}) {
  Tank tank{Vector3d(0, 0, 0), Vector3d(2, 1, 0), closed};
  tank.openings = std::move(openings);
  return sample_walls(tank, kSpacing, kSupport, 2);
}

Opening at_left(double low, double high) {
  Opening opening;
  opening.min = {0, low, 0};
  opening.max = {0, high, 0};
  return opening;
}

std::size_t count_in(const Boundary& walls, const Vector3d& low, const Vector3d& high) {
  return static_cast<std::size_t>(
      std::count_if(walls.position.begin(), walls.position.end(), [&](const Vector3d& x) {
        return (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
      }));
}

// Six layers of floor and ceiling beside the buffer, nothing in between.
TEST(WallsAtOpenings, GoOnBesideTheBuffer) {
  const Boundary whole = walls({at_left(0, 1)});
  EXPECT_EQ(count_in(whole, {-1, 0, 0}, {0, 1, 0}), 0u);
  EXPECT_EQ(count_in(whole, {-1, -1, 0}, {0, 0, 0}), 18u);
  EXPECT_EQ(count_in(whole, {-1, 1, 0}, {0, 2, 0}), 18u);
  for (std::size_t w = 0; w < whole.position.size(); ++w)
    EXPECT_TRUE(whole.position[w].x() > 0 || whole.to_surface[w].x() == 0) << whole.position[w].transpose();
}

// Behind a part of the side stands a channel with walls of its own; what is far from it is as without it.
TEST(WallsAtOpenings, StandAroundAChannel) {
  const Boundary closed = walls({}), nozzle = walls({at_left(0.4, 0.6)});
  EXPECT_EQ(count_in(nozzle, {-1, 0.4, 0}, {0, 0.6, 0}), 0u);
  EXPECT_EQ(count_in(nozzle, {-0.3, -1, 0}, {0, 2, 0}), count_in(closed, {-0.3, -1, 0}, {0, 2, 0}) - 6);
  EXPECT_EQ(count_in(nozzle, {0, -1, 0}, {3, 2, 0}), count_in(closed, {0, -1, 0}, {3, 2, 0}));
  for (std::size_t w = 0; w < nozzle.position.size(); ++w) {
    const Vector3d &x = nozzle.position[w], end = x + nozzle.to_surface[w];
    if (x.x() > 0) continue;
    const bool on_side = std::abs(end.x()) < 1e-12, on_lip = std::abs(std::abs(end.y() - 0.5) - 0.1) < 1e-12;
    EXPECT_TRUE(on_side || on_lip) << x.transpose() << " leads to " << end.transpose();
  }
  EXPECT_EQ(count_in(nozzle, {-0.6, 0.6, 0}, {-0.3, 0.9, 0}), 9u);
}

TEST(WallsAtOpenings, AnOpenSideHasNone) {
  const Boundary open = walls({at_left(0, 0.5)}, {false, true, true, false, true, true});
  EXPECT_EQ(count_in(open, {-1, 0, 0}, {0, 2, 0}), 0u);
  EXPECT_EQ(count_in(open, {-1, -1, 0}, {0, 0, 0}), 18u);
}

}  // namespace
}  // namespace sluice::fluid
