#include "fluid/state_bytes.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/splash.hpp"

namespace sluice::fluid {
namespace {

// All that a run shows of a solver, so that a forgotten part of the state is seen.
std::vector<double> everything(const Solver& solver) {
  const Diagnostics sums = solver.diagnostics();
  std::vector<double> all{sums.kinetic, sums.potential, sums.elastic, sums.boundary_work,
                          sums.max_compression};
  std::vector<Wrench> wrenches(solver.wrenches().begin(), solver.wrenches().end());
  wrenches.push_back(solver.wall_wrench());
  for (const WrenchParts& part : solver.wrench_parts()) wrenches.push_back(part.viscous);
  for (const Wrench& w : wrenches) {
    all.insert(all.end(), w.force.begin(), w.force.end());
    all.insert(all.end(), w.moment.begin(), w.moment.end());
  }
  const Snapshot state = solver.snapshot();
  for (const auto* values : {&state.position, &state.velocity, &state.density, &state.pressure})
    all.insert(all.end(), values->begin(), values->end());
  return all;
}

std::vector<std::byte> state_of(Solver& solver) {
  std::vector<std::byte> bytes(3);  // whatever was there before
  solver.write_state(bytes);
  return bytes;
}

// Half way one solver's state is read by another that was made anew and never started; both go on.
void expect_exact(int dimension, double viscosity, const Splash::Choice& choose, int steps = 40) {
  Splash whole(dimension, viscosity, 1, choose), resumed(dimension, viscosity, 2, choose);
  for (int k = 0; k < steps; ++k) whole.step();
  resumed.go_on(whole.time(), state_of(whole.solver()));
  ASSERT_EQ(everything(whole.solver()), everything(resumed.solver()));
  for (int k = 0; k < steps; ++k) {
    whole.step();
    resumed.step();
    ASSERT_EQ(everything(whole.solver()), everything(resumed.solver())) << "step " << k;
  }
}

void as_given(Formulation&) {}

TEST(StateBytes, GoOnToTheLastBitInThePlane) {
  expect_exact(2, 0, as_given);
}

TEST(StateBytes, GoOnToTheLastBitInSpace) {
  expect_exact(3, 5, as_given, 12);
}

TEST(StateBytes, HoldWhatEveryFormulationKeeps) {
  struct Case {
    const char* name;
    double viscosity;
    Splash::Choice choose;
  };
  const Case cases[] = {
      {"viscous", 20, as_given},
      {"multistep and shifting", 0,
       [](Formulation& f) {
         f.integrator = Integrator::multistep;
         f.shifting = 4;
         f.courant = 0.2;
       }},
      {"predictor and corrector", 0, [](Formulation& f) { f.integrator = Integrator::predictor_corrector; }},
      {"leap-frog", 0, [](Formulation& f) { f.integrator = Integrator::leap_frog; }},
      {"interpolated motion", 0, [](Formulation& f) { f.interpolated_motion = 0.5; }},
      {"spreading", 0, [](Formulation& f) { f.spreading = 0.05; }},
      {"tension control", 0, [](Formulation& f) { f.tension_control = true; }},
      {"symmetrized", 0, [](Formulation& f) { f.internal_force = InternalForce::symmetrized; }},
      {"lumped mass", 0, [](Formulation& f) { f.mass = Mass::lumped; }},
      {"weights", 0, [](Formulation& f) { f.weights = Weights::kernel; }},
      {"damped", 20, [](Formulation& f) { f.viscous_force = ViscousForce::damped; }},
      {"full derivative", 0, [](Formulation& f) { f.approximation = Approximation::mls_full_derivative; }},
      {"Shepard", 0, [](Formulation& f) { f.approximation = Approximation::shepard; }},
      {"SPH", 0, [](Formulation& f) { f.approximation = Approximation::sph; }},
      {"corrected SPH", 0, [](Formulation& f) { f.approximation = Approximation::corrected_sph; }},
      {"stress points", 0, [](Formulation& f) { f.quadrature = Quadrature::stress_points; }},
      {"background cells", 20, [](Formulation& f) { f.quadrature = Quadrature::background_cells; }},
      {"boundary forces", 20, [](Formulation& f) { f.boundary = BoundaryTreatment::forces; }},
      {"cubic spline", 0, [](Formulation& f) { f.kernel = KernelKind::cubic_spline; }},
  };
  for (const Case& each : cases) {
    SCOPED_TRACE(each.name);
    expect_exact(2, each.viscosity, each.choose, 15);
  }
}

// After read_state as after restore: the copies in memory are the new solver's own.
TEST(StateBytes, RollBackAfterwards) {
  Splash whole(2, 0, 1), resumed(2, 0, 1);
  for (int k = 0; k < 10; ++k) whole.step();
  resumed.go_on(whole.time(), state_of(whole.solver()));
  resumed.solver().save();
  const double time = resumed.time();
  resumed.step();
  resumed.solver().restore();
  resumed.set_time(time);
  whole.step();
  resumed.step();
  EXPECT_EQ(everything(whole.solver()), everything(resumed.solver()));
}

TEST(StateBytes, AreRefusedWhereTheyDoNotFit) {
  Splash plane(2, 0, 1), space(3, 0, 1);
  std::vector<std::byte> bytes = state_of(plane.solver());
  EXPECT_THROW(space.solver().read_state(bytes), std::invalid_argument);
  bytes.push_back(std::byte{0});
  EXPECT_THROW(plane.solver().read_state(bytes), std::invalid_argument);
  for (const std::size_t length : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 2}) {
    Splash other(2, 0, 1);
    EXPECT_THROW(other.solver().read_state(std::span(bytes).first(length)), std::invalid_argument) << length;
  }
}

}  // namespace
}  // namespace sluice::fluid
