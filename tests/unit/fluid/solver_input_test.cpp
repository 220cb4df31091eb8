#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

struct Refusal {
  std::string name;                   // of the test
  std::function<void(Setup&)> spoil;  // makes a good setup bad
  std::string quantity, value;        // that the message must name
};

void PrintTo(const Refusal& refusal, std::ostream* out) {
  *out << refusal.name;
}

Setup good_setup() {
  Scene scene(2, 0.1, 9.81, 30.0);
  scene.add_still_water({0, 0, 0}, {1, 1, 0});
  scene.add_tank({0, 0, 0}, {1, 2, 0});
  return scene.setup;
}

class SolverInput : public testing::TestWithParam<Refusal> {};

TEST(SolverInput, AGoodSetupIsTaken) {
  EXPECT_NE(make_solver(good_setup()), nullptr);
}

TEST_P(SolverInput, IsRefusedByNameAndValue) {
  fluid::Setup setup = good_setup();
  GetParam().spoil(setup);
  try {
    make_solver(setup);
    FAIL() << "taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().quantity));
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().value));
  }
}

const double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Each, SolverInput,
    testing::Values(
        Refusal{"Dimension", [](Setup& s) { s.dimension = 4; }, "dimension", "4"},
        Refusal{"SpacingZero", [](Setup& s) { s.spacing = 0; }, "spacing", "0"},
        Refusal{"SpacingNegative", [](Setup& s) { s.spacing = -0.5; }, "spacing", "-0.5"},
        Refusal{"SpacingNan", [](Setup& s) { s.spacing = kNan; }, "spacing", "nan"},
        Refusal{"Threads", [](Setup& s) { s.threads = 0; }, "threads", "0"},
        Refusal{"Density", [](Setup& s) { s.liquid.density = -1000; }, "density", "-1000"},
        Refusal{"SoundSpeed", [](Setup& s) { s.liquid.sound_speed = 0; }, "speed of sound", "0"},
        Refusal{"Viscosity", [](Setup& s) { s.liquid.viscosity = -0.25; }, "viscosity", "-0.25"},
        Refusal{"TinyViscosity", [](Setup& s) { s.liquid.viscosity = -8.9e-7; }, "viscosity", "-8.9e-07"},
        Refusal{"Smoothing", [](Setup& s) { s.formulation.smoothing = 0.75; }, "smoothing", "0.75"},
        Refusal{"Courant", [](Setup& s) { s.formulation.courant = 1.5; }, "courant", "1.5"},
        Refusal{"CourantZero", [](Setup& s) { s.formulation.courant = 0; }, "courant", "0"},
        Refusal{"FloorOne", [](Setup& s) { s.formulation.moment_floor = 1; }, "moment_floor", "1"},
        Refusal{"FloorZero", [](Setup& s) { s.formulation.moment_floor = 0; }, "moment_floor", "0"},
        Refusal{"SphKernel",
                [](Setup& s) {
                  s.formulation.approximation = Approximation::sph;
                  s.formulation.kernel = KernelKind::cubic_spline;
                },
                "kernel", "1"},
        Refusal{"IsobaricMls", [](Setup& s) { s.formulation.internal_force = InternalForce::isobaric; },
                "approximation", "plain SPH"},
        Refusal{"LumpedSph",
                [](Setup& s) {
                  s.formulation.approximation = Approximation::corrected_sph;
                  s.formulation.mass = Mass::lumped;
                },
                "approximation", "sum is one"},
        Refusal{"InterpolatedTwice", [](Setup& s) { s.formulation.interpolated_motion = 2; },
                "interpolated_motion", "2"},
        Refusal{"ParametersWithoutMotion", [](Setup& s) { s.formulation.initial_parameters = true; },
                "interpolated_motion", "0"},
        Refusal{"DampedInviscid", [](Setup& s) { s.formulation.viscous_force = ViscousForce::damped; },
                "viscosity", "0"},
        Refusal{"PointsOfSph",
                [](Setup& s) {
                  s.formulation.approximation = Approximation::shepard;
                  s.formulation.quadrature = Quadrature::stress_points;
                },
                "quadrature", "1"},
        Refusal{"CellsOfLumped",
                [](Setup& s) {
                  s.formulation.mass = Mass::lumped;
                  s.formulation.quadrature = Quadrature::background_cells;
                },
                "quadrature", "background cells, 2"},
        Refusal{"BoundaryPressure", [](Setup& s) { s.formulation.boundary_pressure = -3; },
                "boundary_pressure [Pa]", "-3"},
        Refusal{"ForcesOfSph",
                [](Setup& s) {
                  s.formulation.boundary = BoundaryTreatment::forces;
                  s.formulation.approximation = Approximation::sph;
                },
                "boundary is 1", "default formulation"},
        Refusal{"ForcesWithTension",
                [](Setup& s) {
                  s.formulation.boundary = BoundaryTreatment::forces;
                  s.liquid.surface_tension = 0.07;
                },
                "boundary is 1", "one liquid without surface tension"},
        Refusal{"ForcesAtMirrors",
                [](Setup& s) {
                  s.formulation.boundary = BoundaryTreatment::forces;
                  s.mirrors.at[0] = true;
                },
                "boundary is 1", "mirrors"},
        Refusal{"ForcesThatStick",
                [](Setup& s) {
                  s.formulation.boundary = BoundaryTreatment::forces;
                  s.liquid.viscosity = 1;
                  s.walls.no_slip = true;
                },
                "boundary is 1", "along which liquid slides"},
        Refusal{"ForcesOfAPlate",
                [](Setup& s) {
                  s.formulation.boundary = BoundaryTreatment::forces;
                  s.bodies.push_back(sample_body(BoxShape{{0.05, 0.3, 0}}, s.spacing, 0.29, 2));
                },
                "boundary is 1", "thick bodies"},
        Refusal{"NoFluid",
                [](Setup& s) {
                  s.fluid = FluidParticles{{}, {}, {}, 0.01};
                },
                "number of fluid particles", "0"},
        Refusal{"VelocityMissing", [](Setup& s) { s.fluid.velocity.pop_back(); }, "velocity", "100"},
        Refusal{"PressureMissing", [](Setup& s) { s.fluid.pressure.pop_back(); }, "pressure", "100"},
        Refusal{"ParticleVolume", [](Setup& s) { s.fluid.volume = -0.5; }, "volume", "-0.5"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace sluice::fluid
