#include "server/simulation.hpp"

#include <gtest/gtest.h>

#include "scene_text.hpp"

namespace sluice::testing {
namespace {

TEST(Setup, TakesOverLiquidAndFormulation) {
  const fluid::Setup setup = server::to_setup(
      tank_with("liquid { density: 800 viscosity: 0.01 } fluid { box { min: [0, 0] max: [1, 1] } } "
                "formulation { smoothing: 1.6 density_diffusion: 0.2 artificial_viscosity: 0.03 "
                "moment_floor: 0.25 courant: 0.3 }"),
      3);
  EXPECT_EQ(setup.dimension, 2);
  EXPECT_EQ(setup.spacing, 0.1);
  EXPECT_EQ(setup.gravity, Eigen::Vector3d(0, -9.81, 0));
  EXPECT_EQ(setup.liquid.density, 800);
  EXPECT_EQ(setup.liquid.viscosity, 0.01);
  EXPECT_EQ(setup.liquid.sound_speed, 40);  // ten times max_speed
  EXPECT_EQ(setup.formulation.smoothing, 1.6);
  EXPECT_EQ(setup.formulation.density_diffusion, 0.2);
  EXPECT_EQ(setup.formulation.artificial_viscosity, 0.03);
  EXPECT_EQ(setup.formulation.moment_floor, 0.25);
  EXPECT_EQ(setup.formulation.courant, 0.3);
  EXPECT_EQ(setup.threads, 3);
}

TEST(Setup, TakesOverOpenings) {
  const fluid::Setup setup = server::to_setup(
      tank_with("fluid { box { min: [0, 0] max: [1, 1] } } "
                "opening { name: 'in' side: X_MIN min: 0.2 max: 0.7 inflow { speed: 't*y' level: '1+t' } } "
                "opening { name: 'out' side: X_MAX outflow { pressure: '5*x' } }"),
      1);
  ASSERT_EQ(setup.openings.size(), 2u);
  const fluid::Opening &in = setup.openings[0], &out = setup.openings[1];
  EXPECT_TRUE(in.inflow);
  EXPECT_EQ(in.side, 0);
  EXPECT_EQ(in.min, Eigen::Vector3d(0, 0.2, 0));
  EXPECT_EQ(in.max, Eigen::Vector3d(0, 0.7, 0));
  EXPECT_EQ(in.speed(3, {0, 0.5, 0}), 1.5);
  EXPECT_EQ(in.level(3), 4);
  EXPECT_FALSE(in.pressure);
  EXPECT_FALSE(out.inflow);
  EXPECT_EQ(out.side, 1);
  EXPECT_EQ(out.min, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(out.max, Eigen::Vector3d(1, 2, 0));
  EXPECT_EQ(out.pressure(0, {2, 0, 0}), 10);
  EXPECT_FALSE(out.level);
  EXPECT_EQ(setup.mirrors.at, (std::array<bool, 6>{})) << "a side with an opening is no mirror";
}

TEST(Setup, TakesOverTheChoicesOfTheFormulation) {
  const auto formulation = [](const std::string& text) {
    return server::to_setup(tank_with("liquid { viscosity: 1 } fluid { box { min: [0, 0] max: [1, 1] } } "
                                      "formulation { " +
                                      text + " }"),
                            1)
        .formulation;
  };
  const fluid::Formulation sph = formulation(
      "approximation: SPH internal_force: ISOBARIC isobaric_scale: 0.2 viscous_force: DAMPED "
      "integrator: MULTISTEP multistep_beta1: 0.7 multistep_beta2: 1.1");
  EXPECT_EQ(sph.approximation, fluid::Approximation::sph);
  EXPECT_EQ(sph.internal_force, fluid::InternalForce::isobaric);
  EXPECT_EQ(sph.isobaric_scale, 0.2);
  EXPECT_EQ(sph.viscous_force, fluid::ViscousForce::damped);
  EXPECT_EQ(sph.integrator, fluid::Integrator::multistep);
  EXPECT_EQ(sph.multistep_beta1, 0.7);
  EXPECT_EQ(sph.multistep_beta2, 1.1);
  const fluid::Formulation lumped = formulation(
      "approximation: SHEPARD mass: LUMPED interpolated_motion: 0.5 initial_parameters: true "
      "integrator: LEAP_FROG");
  EXPECT_EQ(lumped.approximation, fluid::Approximation::shepard);
  EXPECT_EQ(lumped.mass, fluid::Mass::lumped);
  EXPECT_EQ(lumped.interpolated_motion, 0.5);
  EXPECT_TRUE(lumped.initial_parameters);
  EXPECT_EQ(lumped.integrator, fluid::Integrator::leap_frog);
  EXPECT_EQ(formulation("approximation: MLS_FULL_DERIVATIVE").approximation,
            fluid::Approximation::mls_full_derivative);
  EXPECT_EQ(formulation("approximation: CORRECTED_SPH").approximation, fluid::Approximation::corrected_sph);
  EXPECT_EQ(formulation("internal_force: SYMMETRIZED").internal_force, fluid::InternalForce::symmetrized);
  EXPECT_EQ(formulation("quadrature: STRESS_POINTS").quadrature, fluid::Quadrature::stress_points);
  EXPECT_EQ(formulation("quadrature: BACKGROUND_CELLS").quadrature, fluid::Quadrature::background_cells);
  EXPECT_EQ(formulation("").boundary, fluid::BoundaryTreatment::layers);
  const fluid::Formulation forces =
      formulation("boundary: FORCES boundary_pressure: 5000 force_on_receding: true");
  EXPECT_EQ(forces.boundary, fluid::BoundaryTreatment::forces);
  EXPECT_EQ(forces.boundary_pressure, 5000);
  EXPECT_TRUE(forces.force_on_receding);
  EXPECT_EQ(formulation("integrator: PREDICTOR_CORRECTOR").integrator,
            fluid::Integrator::predictor_corrector);
}

// A third of the spacing, 0.1 m, apart on all four sides, none of which is a mirror.
TEST(Setup, HasOneLayerOfBoundaryForces) {
  const std::string forces = "fluid { box { min: [0, 0] max: [0.4, 1] } } formulation { boundary: FORCES } ";
  const auto body = [](const std::string& width) {
    return "body { name: 'block' box { size: [" + width + ", 0.4] } position: [0.7, 1.5] density: 500 }";
  };
  const fluid::Setup setup = server::to_setup(tank_with(forces + body("0.4")), 1);
  EXPECT_EQ(setup.mirrors.at, (std::array<bool, 6>{}));
  EXPECT_EQ(setup.walls.position.size(), 2u * (30 + 60));
  ASSERT_EQ(setup.bodies.size(), 1u);
  EXPECT_EQ(setup.bodies[0].position.size(), 4u * 11);
  EXPECT_GT(setup.bodies[0].free_mass, 0);
  EXPECT_THROW(server::to_setup(tank_with(forces + body("0.28")), 1), protocol::InputError)
      << "thinner than the support, 0.29 m";
}

TEST(Setup, HasWallsAtClosedSidesOnly) {
  const fluid::Setup setup = server::to_setup(
      tank_with("domain { open: [Y_MAX, X_MIN] } fluid { box { min: [0, 0] max: [1, 1] } }"), 1);
  bool left = false, right = false, below = false, above = false;
  for (const Eigen::Vector3d& x : setup.walls.position) {
    left |= x.x() < 0;
    right |= x.x() > 1;
    below |= x.y() < 0;
    above |= x.y() > 2;
  }
  EXPECT_FALSE(left);
  EXPECT_TRUE(right);
  EXPECT_TRUE(below);
  EXPECT_FALSE(above);
}

TEST(Setup, SamplesEveryBodyAboutItsCentreOfMass) {
  const fluid::Setup setup = server::to_setup(
      tank_with("fluid { box { min: [0, 0] max: [1, 0.5] } } "
                "body { name: 'a' ball { radius: 0.2 } position: [0.5, 1] density: 500 } "
                "body { name: 'b' polygon { vertex { x: 10 y: 10 } vertex { x: 10.6 y: 10 } vertex "
                "{ x: 10 y: 10.6 } } "
                "position: [0.5, 1.6] density: 500 }"),
      1);
  ASSERT_EQ(setup.bodies.size(), 2u);
  for (const fluid::Boundary& body : setup.bodies) {
    ASSERT_FALSE(body.position.empty());
    for (const Eigen::Vector3d& x : body.position) EXPECT_LT(x.norm(), 0.6);
  }
}

TEST(Simulation, IsLockedToTheRigidProcessByAFreeBodyOnly) {
  const std::string water = "fluid { box { min: [0, 0] max: [1, 0.5] } } ";
  const std::string gate =
      "body { name: 'gate' box { size: [0.4, 0.4] } position: [0.5, 1] prescribed { constant { velocity: [0, "
      "0.1] } } } ";
  const std::string ball = "body { name: 'ball' ball { radius: 0.2 } position: [0.5, 1.6] density: 500 } ";
  EXPECT_FALSE(server::make_simulation(tank_with(water), 1).has_free_body());
  EXPECT_FALSE(server::make_simulation(tank_with(water + gate), 1).has_free_body());
  EXPECT_TRUE(server::make_simulation(tank_with(water + gate + ball), 1).has_free_body());
}

TEST(Simulation, StepsWithinTheSolversLimitAndHitsEveryOutput) {
  const server::Simulation simulation =
      server::make_simulation(tank_with("fluid { box { min: [0, 0] max: [1, 0.5] } } output { rate: 7 }"), 1);
  const protocol::StepClock& clock = simulation.clock;
  const double largest = simulation.solver->largest_step(4);
  for (std::uint64_t step = 1; step <= clock.steps(); ++step) {
    EXPECT_LE(protocol::seconds(clock.duration(step)), largest);
  }
  EXPECT_NEAR(protocol::seconds(clock.time(clock.steps())), 1, 1e-8);
  EXPECT_EQ(clock.steps() / clock.steps_per_interval(), 7u);
}

TEST(Simulation, RefusesStepsThatAreTooShort) {
  EXPECT_THROW(server::make_simulation(
                   tank_with("liquid { sound_speed: 1e6 } fluid { box { min: [0, 0] max: [1, 0.5] } }"), 1),
               protocol::InputError);
}

}  // namespace
}  // namespace sluice::testing
