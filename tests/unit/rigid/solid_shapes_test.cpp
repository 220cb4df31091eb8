#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "rigid/overlap.hpp"
#include "rigid/triangulate.hpp"
#include "rigid/world.hpp"
#include "tests/unit/rigid/stepping.hpp"

namespace sluice::rigid {
namespace {

constexpr double kGravity = 9.81;

Mesh cube(double edge, bool convex) {
  Mesh mesh;
  mesh.convex = convex;
  for (int v = 0; v < 8; ++v)
    mesh.vertices.push_back(edge *
                            (Eigen::Vector3d(v & 1, v >> 1 & 1, v >> 2) - Eigen::Vector3d::Constant(0.5)));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

BodySpec body(Shape shape, const Eigen::Vector3d& position, const Eigen::Vector3d& inertia) {
  BodySpec spec;
  spec.name = "body";
  spec.shape = std::move(shape);
  spec.mass = 2;
  spec.inertia = Eigen::Matrix3d(inertia.asDiagonal());
  spec.pose.position = position;
  return spec;
}

WorldSpec on_floor(std::vector<BodySpec> bodies) {
  WorldSpec spec;
  spec.dimension = 3;
  spec.gravity = {0, 0, -kGravity};
  spec.tank.max = {10, 10, 10};
  spec.tank.closed[4] = true;
  spec.bodies = std::move(bodies);
  return spec;
}

const Eigen::Vector3d kCubeInertia = Eigen::Vector3d::Constant(2 * 0.04 / 6);

TEST(SolidShapes, lie_on_the_floor) {
  const Shape pair = Compound{{{Box{{0.1, 0.1, 0.05}}, {{0, 0, -0.05}, Eigen::Quaterniond::Identity()}},
                               {Box{{0.1, 0.1, 0.05}}, {{0, 0, 0.05}, Eigen::Quaterniond::Identity()}}}};
  for (const Shape& shape : {Shape(cube(0.2, true)), Shape(cube(0.2, false)), pair,
                             Shape(Cylinder{0.1, 0.1, 2}), Shape(Cylinder{0.1, 0.3, 0})}) {
    World simulated(on_floor({body(shape, {5, 5, 0.1001}, kCubeInertia)}));
    run(simulated, 2000, 5e-4);
    EXPECT_NEAR(simulated.state(0).position.z(), 0.1, 1e-4) << shape.index();
    EXPECT_LT(simulated.state(0).orientation.vec().norm(), 1e-2) << shape.index();
  }
}

TEST(SolidShapes, meshes_stack) {
  BodySpec upper = body(cube(0.2, false), {5.02, 5, 0.3002}, kCubeInertia);
  upper.name = "upper";
  World simulated(on_floor({body(cube(0.2, false), {5, 5, 0.1001}, kCubeInertia), upper}));
  run(simulated, 1000, 5e-4);
  EXPECT_NEAR(simulated.state(1).position.z(), 0.3, 2e-3);
}

// The same brick in a frame of its own that is turned against its principal axes.
TEST(SolidShapes, inertia_may_be_askew) {
  const Eigen::Quaterniond turn = rotation({0.3, -0.5, 0.8});
  const Eigen::Vector3d inertia(0.02, 0.03, 0.045);
  BodySpec plain = body(Box{{0.1, 0.2, 0.3}}, {5, 5, 0.5}, inertia), askew = plain;
  plain.angular_velocity = askew.angular_velocity = {0.1, 6, 0.2};
  askew.shape = Compound{{{plain.shape, {Eigen::Vector3d::Zero(), turn}}}};
  askew.inertia = turn.toRotationMatrix() * *plain.inertia * turn.toRotationMatrix().transpose();
  askew.pose.orientation = turn.conjugate();
  World a(on_floor({plain})), b(on_floor({askew}));
  run(a, 600, 1e-3);  // it falls, tumbling, and hits the floor
  run(b, 600, 1e-3);
  EXPECT_LT((a.state(0).position - b.state(0).position).norm(), 1e-6);
  EXPECT_LT(a.state(0).orientation.angularDistance(b.state(0).orientation * turn), 1e-5);
}

TEST(SolidShapes, askew_inertia_keeps_the_energy_of_tumbling) {
  BodySpec spec = body(cube(0.2, true), {5, 5, 5}, {0.02, 0.03, 0.045});
  (*spec.inertia)(0, 1) = (*spec.inertia)(1, 0) = 0.006;
  spec.angular_velocity = {0.1, 6, 0.2};
  WorldSpec weightless = on_floor({spec});
  weightless.gravity.setZero();
  World simulated(std::move(weightless));
  const double start = simulated.kinetic_energy(0);
  double off = 0;
  run(simulated, 10000, 1e-3,
      [&] { off = std::max(off, std::abs(simulated.kinetic_energy(0) / start - 1)); });
  EXPECT_LT(off, 5e-6);
}

TEST(Overlap, of_cylinders_and_meshes) {
  const Pose origin;
  const auto at = [](double x, double y, double z) {
    return Pose{{x, y, z}, Eigen::Quaterniond::Identity()};
  };
  const Shape ball = Ball{0.1}, box = Box{{0.1, 0.1, 0.1}};
  EXPECT_NEAR(penetration(Cylinder{0.1, 0.3, 2}, origin, ball, at(0.19, 0, 0), 3), 0.01, 1e-4);
  EXPECT_LE(penetration(Cylinder{0.1, 0.3, 2}, origin, ball, at(0.21, 0, 0), 3), 1e-4);
  EXPECT_NEAR(penetration(cube(0.2, true), origin, box, at(0.18, 0.03, 0.02), 3), 0.02, 1e-4);
  EXPECT_GT(penetration(cube(0.2, false), origin, box, at(0.18, 0.03, 0.02), 3), 0.01);
  EXPECT_LE(penetration(cube(0.2, false), origin, box, at(0.22, 0, 0), 3), 0);
}

TEST(Extent, of_cylinders_meshes_and_compounds) {
  const Pose turned{{1, 2, 3}, rotation({0, 0, std::numbers::pi / 2})};
  const Interval along = extent(Cylinder{0.1, 0.5, 0}, turned, Eigen::Vector3d::UnitY(), 3);
  EXPECT_NEAR(along.min, 1.5, 1e-12);
  EXPECT_NEAR(along.max, 2.5, 1e-12);
  EXPECT_NEAR(extent(cube(0.2, false), turned, Eigen::Vector3d::UnitX(), 3).max, 1.1, 1e-12);
  const Compound pair{{{Ball{0.1}, {{0.3, 0, 0}, Eigen::Quaterniond::Identity()}}, {Ball{0.1}, {}}}};
  EXPECT_NEAR(extent(pair, turned, Eigen::Vector3d::UnitY(), 3).max, 2.4, 1e-12);
}

}  // namespace
}  // namespace sluice::rigid
