#include <gtest/gtest.h>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

// Largest deviation from its start of a jet that has half left a channel between two bodies that end in
// square edges, so that liquid goes past the corner between a surface that it slid along and one that it is
// not in front of. `length` is that of the bodies, over the spacing.
double deviation_past_edges(double length) {
  const double dx = 0.1, speed = 1;
  Scene scene(2, dx, 0, 20 * speed);
  scene.add_block({-2, -0.5, 0}, {0, 0.5, 0}, {speed, 0, 0});
  const Vector3d half(0.5 * length * dx, 0.6, 0);
  scene.add_body(BoxShape{half});
  scene.add_body(BoxShape{half});
  std::vector<Kinematics> bodies(2);
  bodies[0].position = {-half.x(), 0.5 + half.y(), 0};
  bodies[1].position = {-half.x(), -0.5 - half.y(), 0};
  const auto solver = make_solver(scene.setup);
  solver->start(bodies);
  const double dt = solver->largest_step(speed);
  for (double t = 0; t < 1; t += dt) solver->step(dt, bodies);
  const Snapshot end = solver->snapshot();
  double most = 0;
  for (std::size_t i = 0; i < end.density.size(); ++i)
    most = std::max(most, std::hypot(end.velocity[3 * i] - speed, end.velocity[3 * i + 1]));
  return most / speed;
}

// On the corner's diagonal particles of the bodies belong to either surface, as their cells happen to fit.
TEST(Edge, AJetLeavesAChannelAsItCame) {
  for (const double length : {30.0, 30.25, 30.5}) EXPECT_LT(deviation_past_edges(length), 1e-9) << length;
}

}  // namespace
}  // namespace sluice::fluid
