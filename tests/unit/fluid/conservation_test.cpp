#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/fluid/splash.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

// Force on the fluid and its moment about the origin, as everything outside the fluid states it.
struct Load {
  Wrench sum;
  double force_scale = 0, moment_scale = 0;  // what was added up, without cancellation

  void add(const Vector3d& force, const Vector3d& moment) {
    sum.force += force;
    sum.moment += moment;
    force_scale += force.norm();
    moment_scale += moment.norm();
  }
};

Load load_on_fluid(Splash& splash, const std::vector<double>& masses) {
  Load load;
  const Snapshot snapshot = splash.solver().snapshot();
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const Vector3d weight = masses[i] * splash.scene().setup.gravity;
    load.add(weight, Eigen::Map<const Vector3d>(&snapshot.position[3 * i]).cross(weight));
  }
  const Wrench walls = splash.solver().wall_wrench();
  load.add(-walls.force, -walls.moment);
  for (std::size_t b = 0; b < 2; ++b) {
    const Wrench& on_body = splash.solver().wrenches()[b];
    load.add(-on_body.force, -on_body.moment - splash.bodies()[b].position.cross(on_body.force));
  }
  return load;
}

// What the balance lacks at the worst step, over what was added up, and the largest forces seen: of the walls
// and of the bodies.
struct Closure {
  double linear = 0, angular = 0;
  std::array<double, 3> largest{};
};

// Every step: change of the fluid's momentum = dt/2 (load before + load after), since a step is kick, drift,
// kick. The load is stated by walls, bodies and gravity alone.
Closure closure(Splash& splash, int steps) {
  const std::vector<double> masses = splash.scene().masses();
  Closure worst;
  for (int k = 0; k < steps; ++k) {
    const Load before = load_on_fluid(splash, masses);
    const Diagnostics from = splash.solver().diagnostics();
    splash.step();
    const Load after = load_on_fluid(splash, masses);
    const Diagnostics to = splash.solver().diagnostics();
    const double half = 0.5 * splash.dt();
    const Vector3d linear = to.momentum - from.momentum - half * (before.sum.force + after.sum.force);
    const Vector3d angular =
        to.angular_momentum - from.angular_momentum - half * (before.sum.moment + after.sum.moment);
    worst.linear = std::max(worst.linear, linear.norm() / (half * (before.force_scale + after.force_scale)));
    worst.angular =
        std::max(worst.angular, angular.norm() / (half * (before.moment_scale + after.moment_scale)));
    worst.largest[0] = std::max(worst.largest[0], splash.solver().wall_wrench().force.norm());
    for (std::size_t b = 0; b < 2; ++b)
      worst.largest[b + 1] = std::max(worst.largest[b + 1], splash.solver().wrenches()[b].force.norm());
  }
  return worst;
}

// Walls and bodies must have taken part, with that share of the water's weight.
void expect_forces(const Closure& seen, const Splash& splash, double share) {
  const std::vector<double> masses = splash.scene().masses();
  const double weight = 9.81 * std::accumulate(masses.begin(), masses.end(), 0.0);
  for (const double force : seen.largest) EXPECT_GT(force, share * weight);
}

void expect_closed_balance(int dimension, double viscosity, int steps) {
  SCOPED_TRACE(testing::Message() << "dimension " << dimension << ", viscosity " << viscosity);
  Splash splash(dimension, viscosity, 1);
  const Closure worst = closure(splash, steps);
  EXPECT_LT(worst.linear, 1e-10);
  EXPECT_LT(worst.angular, 1e-10);
  expect_forces(worst, splash, 0.05);
  EXPECT_LT(splash.solver().diagnostics().max_compression, 0.3);
}

TEST(Conservation, SplashInThePlane) {
  expect_closed_balance(2, 0.0, 400);
}
TEST(Conservation, ViscousSplashInThePlane) {
  expect_closed_balance(2, 20.0, 400);
}
TEST(Conservation, SplashInSpace) {
  expect_closed_balance(3, 0.0, 300);
}
TEST(Conservation, ViscousSplashInSpace) {
  expect_closed_balance(3, 20.0, 400);
}

// Other formulations: linear momentum of fluid and boundary closes in every one whose forces are pairs or
// whose gradients sum to zero; the angular where the gradient of a linear field is right or radial.
struct Choice {
  std::string name;
  Splash::Choice choose;
  double viscosity;
  bool linear, angular;
};

void PrintTo(const Choice& choice, std::ostream* out) {
  *out << choice.name;
}

Splash::Choice operator_of(Approximation approximation) {
  return [approximation](Formulation& f) { f.approximation = approximation; };
}

// Those that do not close must be seen not to, else the balance sees nothing.
void expect_closed(double rest, bool closes) {
  if (closes) {
    EXPECT_LT(rest, 1e-10);
  } else {
    EXPECT_GT(rest, 1e-8);
  }
}

class ConservationOf : public testing::TestWithParam<Choice> {};

TEST_P(ConservationOf, ASplash) {
  const Choice& choice = GetParam();
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(testing::Message() << "dimension " << dimension);
    Splash splash(dimension, choice.viscosity, 1, choice.choose);
    const Closure worst = closure(splash, dimension == 2 ? 150 : 200);
    expect_forces(worst, splash, 0.005);
    expect_closed(worst.linear, choice.linear);
    expect_closed(worst.angular, choice.angular);
    // Those that do not conserve momentum blow up.
    if (choice.linear) {
      EXPECT_LT(splash.solver().diagnostics().max_compression, 0.5);
    }
    RecordProperty("linear" + std::to_string(dimension), std::to_string(worst.linear));
    RecordProperty("angular" + std::to_string(dimension), std::to_string(worst.angular));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, ConservationOf,
    testing::Values(
        Choice{"FullDerivative", operator_of(Approximation::mls_full_derivative), 0, true, true},
        Choice{"ViscousFullDerivative", operator_of(Approximation::mls_full_derivative), 20, true, true},
        Choice{"Shepard", operator_of(Approximation::shepard), 0, true, false},
        Choice{"Sph", operator_of(Approximation::sph), 0, true, true},
        Choice{"ViscousSph", operator_of(Approximation::sph), 20, true, false},
        Choice{"CorrectedSph", operator_of(Approximation::corrected_sph), 0, true, true},
        Choice{"StressPoints", [](Formulation& f) { f.quadrature = Quadrature::stress_points; }, 0, true,
               true},
        Choice{"ViscousStressPoints", [](Formulation& f) { f.quadrature = Quadrature::stress_points; }, 20,
               true, true},
        Choice{"BackgroundCells", [](Formulation& f) { f.quadrature = Quadrature::background_cells; }, 0,
               true, true},
        Choice{"ViscousBackgroundCells", [](Formulation& f) { f.quadrature = Quadrature::background_cells; },
               20, true, true},
        Choice{"BoundaryForces", [](Formulation& f) { f.boundary = BoundaryTreatment::forces; }, 0, true,
               true},
        Choice{"BoundaryForcesOfALeapFrog",
               [](Formulation& f) {
                 f.boundary = BoundaryTreatment::forces;
                 f.integrator = Integrator::leap_frog;
               },
               0, true, true},
        Choice{"BoundaryForcesThatAlwaysPush",
               [](Formulation& f) {
                 f.boundary = BoundaryTreatment::forces;
                 f.force_on_receding = true;
               },
               0, true, true},
        Choice{"BoundaryForcesOnInterpolatedMotion",
               [](Formulation& f) {
                 f.boundary = BoundaryTreatment::forces;
                 f.interpolated_motion = 1;
               },
               0, true, false},
        Choice{"ViscousBoundaryForces", [](Formulation& f) { f.boundary = BoundaryTreatment::forces; }, 20,
               true, true},
        Choice{"Isobaric",
               [](Formulation& f) {
                 f.approximation = Approximation::sph;
                 f.internal_force = InternalForce::isobaric;
               },
               0, false, false},
        Choice{"Symmetrized", [](Formulation& f) { f.internal_force = InternalForce::symmetrized; }, 0, false,
               false},
        Choice{"Damped", [](Formulation& f) { f.viscous_force = ViscousForce::damped; }, 20, true, false},
        Choice{"LeapFrog", [](Formulation& f) { f.integrator = Integrator::leap_frog; }, 0, true, true},
        Choice{"HalfInterpolated", [](Formulation& f) { f.interpolated_motion = 0.5; }, 0, true, false}),
    [](const auto& test) { return test.param.name; });

// A free patch of water that turns about its centre and drifts, off the origin.
void expect_free_patch_keeps_momentum(int dimension, double viscosity, int cells, int steps) {
  SCOPED_TRACE(testing::Message() << "dimension " << dimension << ", viscosity " << viscosity);
  Scene scene(dimension, 1.0 / cells, 0.0, 7.0);
  scene.setup.liquid.viscosity = viscosity;
  const Vector3d half(0.5, 0.5, dimension == 3 ? 0.5 : 0.0), drift(0.2, -0.1, dimension == 3 ? 0.3 : 0.0);
  const Vector3d rate = dimension == 3 ? Vector3d(0.3, -0.2, 1.0) : Vector3d(0, 0, 1);
  for (const Vector3d& x : fill(BoxShape{half}, {0.1, 0.2, 0}, 1.0 / cells, dimension))
    scene.add_particle(x, drift + rate.cross(x), 0.0);
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const Diagnostics first = solver->diagnostics();
  for (int k = 0; k < steps; ++k) solver->step(solver->largest_step(1.5), {});
  const Diagnostics last = solver->diagnostics();
  const double scale = std::sqrt(2.0 * 1000.0 * first.kinetic);
  EXPECT_LT((last.momentum - first.momentum).norm() / scale, 1e-12);
  EXPECT_LT((last.angular_momentum - first.angular_momentum).norm() / first.angular_momentum.norm(), 1e-12);
  const Snapshot snapshot = solver->snapshot();
  double farthest = 0;  // the patch has really deformed: its corners have drawn out
  for (std::size_t i = 0; i < scene.setup.fluid.position.size(); ++i)
    farthest = std::max(
        farthest,
        (Eigen::Map<const Vector3d>(&snapshot.position[3 * i]) - scene.setup.fluid.position[i]).norm());
  EXPECT_GT(farthest, 0.2);
}

TEST(Conservation, TurningPatchInThePlane) {
  expect_free_patch_keeps_momentum(2, 0.0, 30, 400);
}
TEST(Conservation, ViscousTurningPatchInThePlane) {
  expect_free_patch_keeps_momentum(2, 5.0, 30, 400);
}
TEST(Conservation, TurningPatchInSpace) {
  expect_free_patch_keeps_momentum(3, 0.0, 10, 150);
}
TEST(Conservation, ViscousTurningPatchInSpace) {
  expect_free_patch_keeps_momentum(3, 5.0, 10, 150);
}

}  // namespace
}  // namespace sluice::fluid
