#include "protocol/scene_check.hpp"

#include <gmock/gmock.h>

#include "scene_text.hpp"

namespace sluice::protocol {
namespace {

using testing::HasSubstr;

// A line of kScene replaced, and the whole output that this must give.
struct Fault {
  const char* name;
  int line;
  const char* text;
  const char* error;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.text;
}

class SceneFault : public testing::TestWithParam<Fault> {};

TEST_P(SceneFault, IsReportedWithItsPlace) {
  EXPECT_EQ(errors_of(with_line(GetParam().line, GetParam().text)),
            std::string("a.scene") + GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    Run, SceneFault,
    testing::Values(
        Fault{"ControlInName", 1, R"(name: "a\nb")",
              ":1:1: name: needs at most 200 characters and none of control"},
        Fault{"Dimension", 2, "dimension: 4", ":2:1: dimension: 4 is neither 2 nor 3; give one of them"},
        Fault{"NoDimension", 2, "", ": dimension: 0 is neither 2 nor 3; give one of them"},
        Fault{"ZeroSpacing", 3, "spacing: 0",
              ":3:1: spacing: 0 m is not positive; give the distance between particles"},
        Fault{"NoSpacing", 3, "", ": spacing: 0 m is not positive; give the distance between particles"},
        Fault{"NegativeSpacing", 3, "spacing: -0.01",
              ":3:1: spacing: -0.01 m is not positive; give the distance between particles"},
        Fault{"NanSpacing", 3, "spacing: nan", ":3:1: spacing: nan is not a finite number"},
        Fault{"InfiniteSpacing", 3, "  spacing: inf", ":3:3: spacing: inf is not a finite number"},
        Fault{"OverflowingNumber", 3, "spacing: 1e999", ":3:1: spacing: inf is not a finite number"},
        Fault{"NoDuration", 4, "", ": duration: 0 s is not positive; give the time to simulate"},
        Fault{"LongDuration", 4, "duration: 1e10", ":4:1: duration: 10000000000 s is beyond 1000000000 s"},
        Fault{"LargeNumber", 4, "duration: 1 gravity: [0, 1e13]",
              ":4:13: gravity[1]: 10000000000000 is beyond 1000000000000; all quantities are in SI units"},
        Fault{"Gravity", 4, "duration: 1 gravity: [0, 0, -9.81]",
              ":4:13: gravity: 3 entries, but the acceleration of gravity needs 2 in 2 dimensions"},
        Fault{"NanInList", 4, "duration: 1 gravity: 0 gravity: nan",
              ":4:24: gravity[1]: nan is not a finite number"},
        Fault{"Rate", 4, "duration: 1 output { rate: -1 }",
              ":4:22: output.rate: -1 frames per second is not positive; leave it out for 100 frames over "
              "the run"},
        Fault{"HighRate", 4, "duration: 100 output { rate: 2e5 }",
              ":4:24: output.rate: 200000 frames per second over 100 s; at most 1000000 per second and "
              "10000000 in all"},
        Fault{"NoParticles", 4, "duration: 1 output { particles_every: 0 }",
              ":4:22: output.particles_every: 0 is not positive; leave it out for particles in every output"},
        Fault{"NoSuchField", 4, "duration: 1 output { field: [VELOCITY, 7] }",
              ":4:22: output.field[1]: 7 is none; give POSITION, VELOCITY, DENSITY, PRESSURE or LIQUID"},
        Fault{"NoSuchPrecision", 4, "duration: 1 output { precision: 5 }",
              ":4:22: output.precision: 5 is none; give FLOAT32 or FLOAT64"},
        Fault{"FlatRegion", 4, "duration: 1 output { region { min: [0, 1] max: [1, 1] } }",
              ":4:43: output.region.max[1]: 1 m is not above min[1], 1 m; give two opposite corners"},
        Fault{"HalfRegion", 4, "duration: 1 output { region { min: [0, 1] } }",
              ":4:22: output.region.max: is missing; give the upper corner with 2 entries"},
        Fault{"Smoothing", 4, "duration: 1 formulation { smoothing: 0.5 }",
              ":4:27: formulation.smoothing: 0.5 is outside 1 to 4; leave it out for the default"},
        Fault{"Courant", 4, "duration: 1 formulation { courant: 2 }",
              ":4:27: formulation.courant: 2 is outside 0.001 to 1; leave it out for the default"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Formulation, SceneFault,
    testing::Values(
        Fault{"NoKernel", 4, "duration: 1 formulation { kernel: 9 }",
              ":4:27: formulation.kernel: 9 is none; give WENDLAND, CUBIC_SPLINE, TENSOR_SPLINE or "
              "SINC_SQUARED"},
        Fault{"NoMass", 4, "duration: 1 formulation { mass: 3 }",
              ":4:27: formulation.mass: 3 is none; give PHYSICAL or LUMPED"},
        Fault{
            "SphKernel", 4, "duration: 1 formulation { approximation: SPH kernel: CUBIC_SPLINE }",
            ":4:27: formulation.approximation: other ones than MLS are built with the kernel WENDLAND only; "
            "leave kernel out"},
        Fault{"SphWeights", 4, "duration: 1 formulation { approximation: SPH weights: KERNEL_ALONE }",
              ":4:46: formulation.weights: KERNEL_ALONE belongs to the fit of MLS, MLS_FULL_DERIVATIVE or "
              "SHEPARD; SPH has no fit"},
        Fault{"SphTension", 4, "duration: 1 formulation { approximation: SPH tension_control: true }",
              ":4:46: formulation.tension_control: takes the pressure relative to the particle's own in the "
              "gradients of MLS; leave approximation out"},
        Fault{"WeightlessSpreading", 4, "duration: 1 gravity: [0, 0] formulation { spreading: 0.02 }",
              ":4:43: formulation.spreading: acts on crowds that gravity pulls down; leave it out"},
        Fault{"SphSymmetrized", 4,
              "duration: 1 formulation { approximation: SPH internal_force: SYMMETRIZED }",
              ":4:46: formulation.internal_force: SYMMETRIZED is built for MLS, to compare with; SPH is "
              "symmetrized as it is"},
        Fault{"MlsIsobaric", 4, "duration: 1 formulation { internal_force: ISOBARIC }",
              ":4:27: formulation.internal_force: ISOBARIC is a sum over kernel gradients; set approximation "
              "to "
              "SPH"},
        Fault{"IsobaricScale", 4, "duration: 1 formulation { isobaric_scale: 0.2 }",
              ":4:27: formulation.isobaric_scale: belongs to internal_force ISOBARIC; set that or leave this "
              "out"},
        Fault{
            "DampedInviscid", 5, "liquid { max_speed: 1 } formulation { viscous_force: DAMPED }",
            ":5:39: formulation.viscous_force: DAMPED without viscosity does nothing; set liquid.viscosity"},
        Fault{"SphPoints", 4, "duration: 1 formulation { approximation: SPH quadrature: STRESS_POINTS }",
              ":4:46: formulation.quadrature: other ones than NODAL are built for MLS with the kernel "
              "WENDLAND and "
              "the internal force GALERKIN; leave approximation, kernel and internal_force out"},
        Fault{"LumpedCells", 4, "duration: 1 formulation { quadrature: BACKGROUND_CELLS mass: LUMPED }",
              ":4:27: formulation.quadrature: BACKGROUND_CELLS takes its weights from the particles' volumes "
              "and "
              "is built for their own masses; leave weights and mass out"},
        Fault{"PressureOfLayers", 4, "duration: 1 formulation { boundary_pressure: 100 }",
              ":4:27: formulation.boundary_pressure: belongs to boundary FORCES; set that or leave this out"},
        Fault{"NoBoundaryPressure", 4, "duration: 1 formulation { boundary: FORCES boundary_pressure: 0 }",
              ":4:44: formulation.boundary_pressure: 0 Pa is not positive; leave it out for the default"},
        Fault{
            "SphForces", 4, "duration: 1 formulation { boundary: FORCES approximation: SPH }",
            ":4:44: formulation.approximation: boundary FORCES are handed on by the shape functions of MLS; "
            "leave one of them out"},
        Fault{
            "PredictedForces", 4,
            "duration: 1 formulation { boundary: FORCES integrator: PREDICTOR_CORRECTOR }",
            ":4:44: formulation.integrator: boundary FORCES ask for the velocities of the middle of a step; "
            "take KICK_DRIFT_KICK or LEAP_FROG"},
        Fault{"TenseForces", 5, "liquid { surface_tension: 0.07 } formulation { boundary: FORCES }",
              ":5:10: liquid.surface_tension: counts walls as liquid, and boundary FORCES have no volume; "
              "leave "
              "one of them out"},
        Fault{
            "StickyForces", 6, "domain { max: [1, 0.5] surface: NO_SLIP } formulation { boundary: FORCES }",
            ":6:24: domain.surface: boundary FORCES act across surfaces only, and liquid slides along them; "
            "leave this out"},
        Fault{"ForcesWithOpenings", 5,
              "opening { name: 'out' side: X_MAX outflow { } } formulation { boundary: FORCES }",
              ":5:1: opening[0]: is built in walls of LAYERS; leave formulation.boundary out"},
        Fault{"Beta", 4, "duration: 1 formulation { multistep_beta2: 1.1 }",
              ":4:27: formulation.multistep_beta2: belongs to integrator MULTISTEP; set that or leave this "
              "out"},
        Fault{"SphMass", 4, "duration: 1 formulation { approximation: SPH mass: LUMPED }",
              ":4:46: formulation.mass: LUMPED needs shape functions whose sum is one, CF (57); set "
              "approximation to MLS, MLS_FULL_DERIVATIVE or SHEPARD"},
        Fault{
            "SphMotion", 4, "duration: 1 formulation { approximation: SPH interpolated_motion: 1 }",
            ":4:46: formulation.interpolated_motion: needs shape functions whose sum is one, else a uniform "
            "velocity is not kept; set approximation to MLS, MLS_FULL_DERIVATIVE or SHEPARD"},
        Fault{"Parameters", 4, "duration: 1 formulation { initial_parameters: true }",
              ":4:27: formulation.initial_parameters: makes sense where particles move with the interpolated "
              "velocity; set interpolated_motion"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Liquid, SceneFault,
    testing::Values(Fault{"Density", 5, "liquid { density: 0 }",
                          ":5:10: liquid.density: 0 kg/m^3 is not positive; leave it out for water, 1000"},
                    Fault{"Viscosity", 5, "liquid { viscosity: -1 }",
                          ":5:10: liquid.viscosity: -1 Pa s is negative; give 0 or more"},
                    Fault{"SoundBelowSpeed", 5, "liquid { sound_speed: 5 max_speed: 10 }",
                          ":5:10: liquid.sound_speed: 5 m/s is below max_speed, 10 m/s; ten times max_speed "
                          "keeps the density within 1 %"},
                    Fault{"NoSpeed", 5, "gravity: [0, 0]",
                          ": liquid.max_speed: follows neither from gravity nor from an initial speed; give "
                          "the largest speed expected [m/s]"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Domain, SceneFault,
    testing::Values(
        Fault{"Missing", 6, "", ": domain.max: is missing; give the tank's upper corner with 2 entries"},
        Fault{"Entries", 6, "domain { max: [1] }",
              ":6:10: domain.max: 1 entries, but the tank's upper corner needs 2 in 2 dimensions"},
        Fault{"UpsideDown", 6, "domain { min: [0, 0.5] max: [1, 0.5] }",
              ":6:24: domain.max[1]: 0.5 m is not a spacing above the lower corner at 0.5 m; give a larger "
              "tank"},
        Fault{"SideOfThreeDimensions", 6, "domain { max: [1, 0.5] open: Y_MAX\n open: Z_MAX }",
              ":7:2: domain.open[1]: Z_MAX does not exist in two dimensions; remove it"},
        Fault{"SideTwice", 6, "domain { max: [1, 0.5] open: Y_MAX open: Y_MAX }",
              ":6:36: domain.open[1]: Y_MAX is given twice; remove one"},
        Fault{"NoSide", 6, "domain { max: [1, 0.5] open: 77 }",
              ":6:24: domain.open[0]: 77 is not a side; give X_MIN, X_MAX, Y_MIN, Y_MAX, Z_MIN or Z_MAX"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Fluid, SceneFault,
    testing::Values(
        Fault{"Missing", 7, "",
              ": fluid: is missing; give at least one region, e.g. fluid { box { min: [0, 0] max: [1, 0.5] } "
              "}"},
        Fault{"NoShape", 7, "fluid { }", ":7:1: fluid[0]: has no shape; give box, ball or polygon"},
        Fault{"Entries", 7, "fluid { box { min: [0, 0, 0] max: [0.3, 0.3] } }",
              ":7:15: fluid[0].box.min: 3 entries, but the box's lower corner needs 2 in 2 dimensions"},
        Fault{"Inverted", 7, "fluid { box { min: [0.3, 0] max: [0, 0.3] } }",
              ":7:29: fluid[0].box.max[0]: 0 m is not above the lower corner at 0.3 m"},
        Fault{"Radius", 7, "fluid { ball { center: [0.2, 0.2] } }",
              ":7:9: fluid[0].ball.radius: 0 m is not positive; give the ball's radius"},
        Fault{"Formula", 7, "fluid { box { max: [0.3, 0.3] min: [0, 0] } pressure: '1 + *x' }",
              ":7:45: fluid[0].pressure: formula '1 + *x', position 5, token '*': Unexpected operator \"*\" "
              "found at position 4 (known are x, y, z, pi and functions such as sin, sqrt, exp, min)"},
        Fault{"FormulaOfTime", 7, "fluid { box { max: [0.3, 0.3] min: [0, 0] } displacement { y: '0.1*t' } }",
              ":7:60: fluid[0].displacement.y: formula '0.1*t', position 5, token 't': Unexpected token "
              "\"t\" found at position 4. (known are x, y, z, pi and functions such as sin, sqrt, exp, min)"},
        Fault{"FormulaAssigns", 7, "fluid { box { max: [0.3, 0.3] min: [0, 0] } pressure: 'x = 2' }",
              ":7:45: fluid[0].pressure: formula 'x = 2' assigns to a coordinate; write == to compare"},
        Fault{"FormulaOfTwoValues", 7, "fluid { box { max: [0.3, 0.3] min: [0, 0] } pressure: '1, 2' }",
              ":7:45: fluid[0].pressure: formula '1, 2' has 2 values; give one"},
        Fault{"FieldOfThreeDimensions", 7,
              "fluid { box { max: [0.3, 0.3] min: [0, 0] } displacement { z: '0' } }",
              ":7:60: fluid[0].displacement.z: does not exist in two dimensions; remove it"},
        Fault{"FieldWithoutFormula", 7, "fluid { box { max: [0.3, 0.3] min: [0, 0] } displacement { } }",
              ":7:45: fluid[0].displacement: has no formula; give x, y or z, e.g. x: \"0.1*sin(pi*x)\""},
        Fault{"FieldWithoutSpeed", 7,
              "fluid { box { max: [0.3, 0.3] min: [0, 0] } velocity_field { x: 'y' } }",
              ":7:45: fluid[0].velocity_field: needs liquid.max_speed: give the largest speed expected in "
              "the flow [m/s]"},
        Fault{"TwoPressures", 7,
              "fluid { box { max: [0.3, 0.3] min: [0, 0] } pressure: '1' hydrostatic: true }",
              ":7:45: fluid[0].pressure: stands beside hydrostatic: true; give one of them"},
        Fault{"FewVertices", 7, "fluid { polygon { vertex { x: 1 } } }",
              ":7:9: fluid[0].polygon: has 1 vertices; give at least 3"},
        Fault{"Clockwise", 7, "fluid { polygon { vertex { } vertex { y: 1 } vertex { x: 1 } } }",
              ":7:9: fluid[0].polygon: runs clockwise; give the vertices counter-clockwise"},
        Fault{"InLine", 7, "fluid { polygon { vertex { } vertex { x: 1 y: 1 } vertex { x: 2 y: 2 } } }",
              ":7:9: fluid[0].polygon: has no area; give vertices that are not all in line"},
        Fault{"Crossing", 7,
              "fluid { polygon { vertex { } vertex { x: 4 } vertex { x: 4 y: 4 } vertex { x: 2 y: -1 } } }",
              ":7:46: fluid[0].polygon.vertex[2]: the side from here meets the side from vertex[0]; sides "
              "must not cross or touch"},
        Fault{"TwiceTheSameVertex", 7,
              "fluid { polygon { vertex { } vertex { x: 1 } vertex { x: 1 } vertex { y: 1 } } }",
              ":7:30: fluid[0].polygon.vertex[1]: equals the next, (1, 0); remove one"},
        Fault{"Velocity", 7, "fluid { velocity: 1 box { min: [0, 0] max: [0.3, 0.3] } }",
              ":7:9: fluid[0].velocity: 1 entries, but the initial velocity needs 2 in 2 dimensions"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Body, SceneFault,
    testing::Values(
        Fault{"NoName", 9, "",
              ":8:1: body[0].name: \"\" is not 1 to 64 letters, digits, _ or -; name the body"},
        Fault{"NameWithSlash", 9, "  name: \"a/b\"",
              ":9:3: body[0].name: \"a/b\" is not 1 to 64 letters, digits, _ or -; name the body"},
        Fault{"NameOfDots", 9, "  name: \"..\"",
              ":9:3: body[0].name: \"..\" is not 1 to 64 letters, digits, _ or -; name the body"},
        Fault{"ReservedName", 9, "  name: \"energy\"",
              ":9:3: body[0].name: \"energy\" is the name of a record of every run; choose another"},
        Fault{"SameName", 15, "  name: \"gate\"",
              ":15:3: body[1].name: \"gate\" is the name of body[0] too; names must differ"},
        Fault{"OwnerWithSlash", 9, "  name: \"gate\" owner: \"a/b\"",
              ":9:16: body[0].owner: \"a/b\" is not 1 to 64 letters, digits, _ or -; choose such a name"},
        Fault{"JointOfTwoOwners", 12,
              "  density: 500 owner: \"crane\" } joint { body: \"gate\" to: \"ball\" fixed { }",
              ":12:33: joint[0]: joins bodies of two owners, \"crane\" and \"\"; who moves one of them does "
              "not "
              "know the other"},
        Fault{
            "OwnerOfIteratedSteps", 12,
            "  density: 500 owner: \"crane\" } coupling { scheme: IMPLICIT steps_per_exchange: 4",
            ":12:61: coupling.steps_per_exchange: 4 steps are repeated together, but the owner of body[0] is "
            "answered after each; give 1"},
        Fault{"NoShape", 10, "",
              ":8:1: body[0]: has no shape; give box, ball, polygon, cylinder, mesh or compound"},
        Fault{"Size", 10, "  box { size: [0.1, 0] }",
              ":10:9: body[0].box.size[1]: 0 m is not positive; give the length of the edge"},
        Fault{"SizeEntries", 10, "  box { size: [0.1, 0.1, 0.1] }",
              ":10:9: body[0].box.size: 3 entries, but the box's edge lengths needs 2 in 2 dimensions"},
        Fault{"Position", 11, "  position: 0.5",
              ":11:3: body[0].position: 1 entries, but the position of the centre of mass needs 2 in 2 "
              "dimensions"},
        Fault{"NoPosition", 11, "",
              ":8:1: body[0].position: is missing; give the position of the centre of mass with 2 entries"},
        Fault{"FreeWithoutMass", 12, "",
              ":8:1: body[0]: is free and has neither density nor mass; give one, or a prescribed motion"},
        Fault{"Mass", 12, "  mass: 0", ":12:3: body[0].mass: 0 kg/m is not positive; give the body's mass"},
        Fault{"MassTwice", 12, "  mass: 1 density: 1",
              ":12:3: body[0].mass: density is given too; leave one of them out"},
        Fault{"Orientation", 12, "  mass: 1 orientation: [1, 0, 0, 0]",
              ":12:11: body[0].orientation: is for three dimensions; give angle [rad]"},
        Fault{"Velocity", 12, "  mass: 1 velocity: [1, 0, 0]",
              ":12:11: body[0].velocity: 3 entries, but the initial velocity needs 2 in 2 dimensions"},
        Fault{"AngularVelocity", 12, "  mass: 1 angular_velocity: [1, 0, 0]",
              ":12:11: body[0].angular_velocity: 3 entries, but the initial angular velocity needs 1 in 2 "
              "dimensions"},
        Fault{
            "VelocityOfPrescribed", 16, "  ball { radius: 0.05 } velocity: [0, 1]",
            ":16:25: body[1].velocity: is for free bodies; the motion of this one is prescribed, remove it"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Motion, SceneFault,
    testing::Values(
        Fault{
            "NoKind", 12, "  prescribed { }",
            ":12:3: body[0].prescribed: has no kind; give constant, keyframes, expression, sinusoid or ramp"},
        Fault{"Start", 12, "  prescribed { constant { velocity: [0, 1] start: -1 } }",
              ":12:44: body[0].prescribed.constant.start: -1 s is negative; give 0 or more"},
        Fault{"ConstantVelocity", 12, "  prescribed { constant { velocity: 1 } }",
              ":12:27: body[0].prescribed.constant.velocity: 1 entries, but the velocity needs 2 in 2 "
              "dimensions"},
        Fault{"NoKeys", 12, "  prescribed { keyframes { } }",
              ":12:16: body[0].prescribed.keyframes: has no key; give at least one time with its offset"},
        Fault{"EarlyKey", 12, "  prescribed { keyframes { key { time: -1 } } }",
              ":12:34: body[0].prescribed.keyframes.key[0].time: -1 s is negative; give 0 or more"},
        Fault{"KeysOutOfOrder", 19, "    key { time: 0 } } }",
              ":19:11: body[1].prescribed.keyframes.key[1].time: 0 s is not after the key before, 0 s; times "
              "must increase"},
        Fault{"KeyOffset", 19, "    key { time: 1 offset: 1 } } }",
              ":19:19: body[1].prescribed.keyframes.key[1].offset: 1 entries, but the offset needs 2 in 2 "
              "dimensions"},
        Fault{"NoFormula", 12, "  prescribed { expression { } }",
              ":12:16: body[0].prescribed.expression: has no formula; give x, y, z or angle, e.g. x: "
              "\"0.02*sin(2*pi*t)\""},
        Fault{"FormulaOfThreeDimensions", 12, "  prescribed { expression { z: \"t\" } }",
              ":12:29: body[0].prescribed.expression.z: does not exist in two dimensions; remove it"}),
    [](const auto& test) { return test.param.name; });

// The same scene in three dimensions.
const std::string kSolid = R"(dimension: 3
spacing: 0.1
duration: 1
domain { max: [1, 1, 1] }
fluid { box { min: [0, 0, 0] max: [1, 1, 0.5] } }
body {
  name: "ball"
  ball { radius: 0.1 }
  position: [0.5, 0.5, 0.8]
  density: 500
)";

TEST(SceneFault3D, ScenesWithoutFaultPass) {
  EXPECT_EQ(errors_of(kScene), "");
  EXPECT_EQ(errors_of(kSolid + "orientation: [1, 0, 0, 0] angular_velocity: [0, 0, 1] }"), "");
}

TEST(SceneFault3D, FieldsOfTwoDimensionsAreRefused) {
  EXPECT_EQ(
      errors_of(kSolid + "angle: 1 }"),
      "a.scene:11:1: body[0].angle: is for two dimensions; give orientation, a unit quaternion w x y z");
  EXPECT_THAT(
      errors_of(kSolid + "}\nfluid { polygon { } }"),
      HasSubstr(
          "a.scene:12:9: fluid[1].polygon: polygons exist in two dimensions only; use a box or a ball"));
}

TEST(SceneFault3D, RotationsMustBeRotations) {
  EXPECT_EQ(errors_of(kSolid + "orientation: [1, 1, 0, 0] }"),
            "a.scene:11:1: body[0].orientation: has length 1.4142135623730951; a rotation is a quaternion of "
            "length 1 within 1e-06");
  EXPECT_EQ(errors_of(kSolid + "orientation: [1, 0, 0] }"),
            "a.scene:11:1: body[0].orientation: 3 entries; a quaternion w x y z has 4");
  EXPECT_EQ(errors_of(kSolid + "angular_velocity: 1 }"),
            "a.scene:11:1: body[0].angular_velocity: 1 entries, but the initial angular velocity needs 3 in "
            "3 dimensions");
}

TEST(SceneCounts, BeyondAnyIntegerAreRefused) {
  EXPECT_THAT(errors_of(kScene, {"spacing=1e-9"}),
              HasSubstr("spacing: 1e-09 m makes about 9e+16 fluid particles, at most 1e+08 are supported"));
  EXPECT_THAT(errors_of(kScene, {"domain.max=[1e9, 1e9]"}), HasSubstr("lattice sites in the domain"));
  EXPECT_THAT(errors_of(kScene, {"body[1].ball.radius=1e10"}), HasSubstr("particles in bodies"));
}

TEST(SceneCounts, ListsAreCapped) {
  std::string text = kScene;
  for (int i = 0; i < 1000; ++i) text += "body { }\n";
  EXPECT_THAT(errors_of(text), HasSubstr("body: 1002 entries, at most 1000 are supported"));
}

TEST(SceneCounts, SceneMustFitIntoAMessage) {
  std::string text = kScene;
  for (int i = 0; i < 9500; ++i) text += "fluid { box { min: [0, 0] max: [1, 1] } velocity: [1, 1] }\n";
  EXPECT_THAT(errors_of(text), HasSubstr("bytes as a message, at most 524288 are sent"));
}

TEST(SceneCheck, ShippedScenesPass) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SLUICE_SOURCE "/clients/scenes")) {
    if (entry.path().extension() != ".scene") continue;
    EXPECT_NO_THROW(SceneFile::load(entry.path())) << entry.path();
    ++scenes;
  }
  EXPECT_GT(scenes, 0);
}

}  // namespace
}  // namespace sluice::protocol
