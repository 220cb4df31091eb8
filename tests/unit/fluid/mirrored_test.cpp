#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

constexpr double kGravity = 9.81;
constexpr int kCells = 10;
constexpr double kSpacing = 1.0 / kCells;

struct Variant {
  std::string name;
  int dimension;
  std::function<void(Setup&)> change = [](Setup&) {};
};

std::ostream& operator<<(std::ostream& out, const Variant& variant) {
  return out << variant.name;
}

// A flow that is its own mirror image in x = 0 and 1, in space in y = 0 and 1 as well.
Vector3d flow(const Vector3d& x) {
  const double k = std::numbers::pi;
  return 0.3 * Vector3d(std::sin(k * x.x()) * std::cos(k * x.y()), 0.0, 0.0);
}

// Water over a floor. With mirrors it fills a unit square, without them `images` of it side by side between
// periodic sides: the same flow.
class SloshingWater : public Scene {
 public:
  SloshingWater(const Variant& variant, bool with_mirrors)
      : Scene(variant.dimension, kSpacing, kGravity, 20.0), across_(variant.dimension - 1) {
    const double length = with_mirrors ? 1.0 : 2.0;
    Vector3d max = Vector3d::Zero();
    max.head(across_).setConstant(length);
    max[across_] = 0.8;
    add_still_water(Vector3d::Zero(), max);
    for (std::size_t i = 0; i < setup.fluid.position.size(); ++i) {
      Vector3d& x = setup.fluid.position[i];
      setup.fluid.velocity[i] = flow(x);
      // Off the lattice, alike on both sides of the mirrors.
      x.x() += 0.05 * kSpacing * std::sin(2.0 * std::numbers::pi * x.x());
    }
    Tank tank{.min = Vector3d::Zero(), .max = max};
    tank.max[across_] = 2.0;
    tank.closed[2 * static_cast<std::size_t>(across_) + 1] = false;
    for (int a = 0; a < across_; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      if (with_mirrors) {
        tank.mirrored[2 * axis] = tank.mirrored[2 * axis + 1] = true;
      } else {
        tank.periodic[axis] = true;
        setup.period.length[a] = length;
      }
    }
    setup.mirrors = {tank.min, tank.max, tank.mirrored};
    setup.walls = sample_walls(tank, kSpacing, support(), setup.dimension);
    variant.change(setup);
  }

 private:
  int across_;
};

class Mirrored : public testing::TestWithParam<Variant> {};

TEST_P(Mirrored, IsHalfOfAPeriodicFlow) {
  const SloshingWater half(GetParam(), true), whole(GetParam(), false);
  const auto solver = make_solver(half.setup), oracle = make_solver(whole.setup);
  solver->start({});
  oracle->start({});
  const double dt = solver->largest_step(1.0);
  for (int k = 0; k < 60; ++k) {
    solver->step(dt, {});
    oracle->step(dt, {});
  }
  const Snapshot a = solver->snapshot(), b = oracle->snapshot();
  std::size_t found = 0;
  double speed = 0;
  for (std::size_t i = 0; i < half.setup.fluid.position.size(); ++i)
    for (std::size_t j = 0; j < whole.setup.fluid.position.size(); ++j) {
      if ((half.setup.fluid.position[i] - whole.setup.fluid.position[j]).norm() > 1e-9) continue;
      ++found;
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(a.position[3 * i + c], b.position[3 * j + c], 1e-9);
        ASSERT_NEAR(a.velocity[3 * i + c], b.velocity[3 * j + c], 1e-7);
        speed = std::max(speed, std::abs(a.velocity[3 * i + c]));
      }
    }
  EXPECT_EQ(found, half.setup.fluid.position.size());
  EXPECT_GT(speed, 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    Flows, Mirrored,
    testing::Values(Variant{"Planar", 2}, Variant{"Spatial", 3},
                    Variant{"Viscous", 2, [](Setup& s) { s.liquid.viscosity = 1.0; }},
                    Variant{"Shifted", 2, [](Setup& s) { s.formulation.shifting = 6; }},
                    Variant{"Spread", 2, [](Setup& s) { s.formulation.spreading = 0.05; }},
                    Variant{"Sph", 2, [](Setup& s) { s.formulation.approximation = Approximation::sph; }},
                    Variant{
                        "FullDerivative", 2,
                        [](Setup& s) { s.formulation.approximation = Approximation::mls_full_derivative; }}),
    [](const testing::TestParamInfo<Variant>& variant) { return variant.param.name; });

// Takes out the water in a shape.
void displace(Scene& scene, const Shape& shape, const Kinematics& pose) {
  FluidParticles& fluid = scene.setup.fluid;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < fluid.position.size(); ++i) {
    const Vector3d local = pose.orientation.conjugate() * (fluid.position[i] - pose.position);
    if (signed_distance(shape, local, scene.setup.dimension) < 0.3 * kSpacing) continue;
    fluid.position[kept] = fluid.position[i];
    fluid.velocity[kept] = fluid.velocity[i];
    fluid.pressure[kept++] = fluid.pressure[i];
  }
  fluid.position.resize(kept);
  fluid.velocity.resize(kept);
  fluid.pressure.resize(kept);
}

// A plate that moves and turns in the water beside a mirrored side, and its image in the periodic flow. The
// forces on it are the same; the tank's sides bear what is left of the momentum.
// Further off than a film, which a gap between a body and a mirror is at once and one between two bodies when
// it is half as wide.
TEST(MirroredBody, FeelsWhatItFeelsBesideItsImage) {
  const Variant planar{"Planar", 2};
  SloshingWater half(planar, true), whole(planar, false);
  const Shape plate = BoxShape{{0.25, 0.05, 0}};
  half.add_body(plate);
  whole.add_body(plate);
  // The particles behind the corners of a plate are not their own mirror image.
  Boundary other = whole.setup.bodies[0];
  for (Vector3d& x : other.position) x.x() = -x.x();
  for (Vector3d& x : other.to_surface) x.x() = -x.x();
  for (Boundary::Face& face : other.plates.front())
    face = {{-face.point.x(), face.point.y(), 0}, {-face.normal.x(), face.normal.y(), 0}};
  whole.setup.bodies.push_back(other);
  half.setup.measure_wall_force = true;
  const auto pose = [](double t, bool image) {
    const double angle = 0.4 + 0.5 * t, way = image ? -1.0 : 1.0;
    Kinematics k;
    k.position = {1.0 - way * (0.45 - 0.1 * t), 0.4, 0};
    k.velocity = {0.1 * way, 0, 0};
    k.orientation = Eigen::AngleAxisd(way * angle, Vector3d::UnitZ());
    k.angular_velocity = {0, 0, 0.5 * way};
    return k;
  };
  const std::array<Kinematics, 2> start{pose(0, false), pose(0, true)};
  displace(half, plate, start[0]);
  displace(whole, plate, start[0]);
  displace(whole, plate, start[1]);
  const auto solver = make_solver(half.setup), oracle = make_solver(whole.setup);
  solver->start(std::span(start).first(1));
  oracle->start(start);
  const double dt = solver->largest_step(1.0);
  double largest = 0;
  Vector3d momentum = solver->diagnostics().momentum, impulse = Vector3d::Zero();
  const auto on_all = [&] { return Vector3d(solver->wall_wrench().force + solver->wrenches()[0].force); };
  Vector3d last = on_all();
  for (int k = 1; k <= 60; ++k) {
    const std::array<Kinematics, 2> now{pose(k * dt, false), pose(k * dt, true)};
    solver->step(dt, std::span(now).first(1));
    oracle->step(dt, now);
    impulse += 0.5 * dt * (last + on_all());
    last = on_all();
    const Vector3d force = solver->wrenches()[0].force;
    largest = std::max(largest, force.norm());
    ASSERT_LT((force - oracle->wrenches()[0].force).norm(), 1e-6 * (1.0 + force.norm()));
  }
  EXPECT_GT(largest, 10.0);
  double mass = 0;
  for (const double m : half.masses()) mass += m;
  const Vector3d weight = 60 * dt * mass * half.setup.gravity;
  EXPECT_LT((solver->diagnostics().momentum - momentum - weight + impulse).norm(), 1e-9 * weight.norm());
}

// Water that is thrown against a mirrored side comes back, and no energy is made.
TEST(MirroredSide, ThrowsBackWhatHitsIt) {
  Scene scene(2, kSpacing, 0.0, 20.0);
  scene.add_block({0.3, 0, 0}, {0.6, 0.3, 0}, {-2, 0, 0});
  scene.setup.mirrors.at[0] = true;
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = solver->largest_step(2.0), start = solver->diagnostics().kinetic;
  double most = 0;
  for (double t = 0; t < 0.8; t += dt) {
    solver->step(dt, {});
    const Diagnostics d = solver->diagnostics();
    most = std::max(most, d.kinetic + d.elastic);
  }
  EXPECT_LT(most, 1.002 * start);
  const Snapshot end = solver->snapshot();
  for (std::size_t i = 0; i < end.density.size(); ++i) EXPECT_GT(end.position[3 * i], -0.5 * kSpacing);
  EXPECT_GT(solver->diagnostics().momentum.x(), 0.0);
}

// The force on the sides is what stops the water: the impulse is the momentum lost.
TEST(MirroredSide, BearsTheForceThatTurnsTheWater) {
  Scene scene(2, kSpacing, 0.0, 20.0);
  scene.add_block({0.05, 0, 0}, {0.35, 0.3, 0}, {-2, 0, 0});
  scene.setup.mirrors.at[0] = true;
  scene.setup.measure_wall_force = true;
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = solver->largest_step(2.0);
  const double before = solver->diagnostics().momentum.x();
  double impulse = 0, last = solver->wall_wrench().force.x();
  for (int k = 0; k < 40; ++k) {
    solver->step(dt, {});
    impulse += 0.5 * dt * (last + solver->wall_wrench().force.x());
    last = solver->wall_wrench().force.x();
  }
  EXPECT_LT(impulse, -0.01 * std::abs(before));
  EXPECT_NEAR(solver->diagnostics().momentum.x() - before, -impulse, 1e-10 * std::abs(before));
}

// With layers of boundary particles the waterline creeps: 5e-7 (README.md, "Mirrored sides").
TEST(MirroredSide, LeavesStillWaterAtRest) {
  Scene scene(2, 0.05, kGravity, 10.0 * std::sqrt(2.0 * kGravity));
  scene.add_still_water({0, 0, 0}, {2, 1, 0});
  Tank tank{.min = {0, 0, 0}, .max = {2, 2, 0}};
  tank.mirrored[0] = tank.mirrored[1] = true;
  scene.setup.mirrors = {tank.min, tank.max, tank.mirrored};
  scene.setup.walls = sample_walls(tank, 0.05, scene.support(), 2);
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = solver->largest_step(std::sqrt(2.0 * kGravity));
  for (int k = 0; k < 3000; ++k) solver->step(dt, {});
  const Diagnostics end = solver->diagnostics();
  EXPECT_LT(end.kinetic / end.potential, 1e-9);
}

}  // namespace
}  // namespace sluice::fluid
