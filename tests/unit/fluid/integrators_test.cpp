#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fluid/multistep.hpp"
#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

// Error of PC (26)-(27) on u'' = -u after one period with that many steps, started from the exact past.
double oscillator_error(int steps, double beta1, double beta2) {
  const double dt = 2.0 * std::numbers::pi / steps;
  double u = 1, v = 0, a1 = -std::cos(dt), a2 = -std::cos(2 * dt);
  for (int k = 0; k < steps; ++k) {
    const double a0 = -u, D = multistep_difference(a0, a1, a2);
    u += dt * multistep_mean_velocity(v, a0, D, beta2, dt);
    v = multistep_velocity(v, a0, D, beta1, dt);
    a2 = a1;
    a1 = a0;
  }
  return std::hypot(u - 1, v);
}

double oscillator_order(double beta1, double beta2) {
  return std::log2(oscillator_error(800, beta1, beta2) / oscillator_error(1600, beta1, beta2));
}

TEST(Multistep, IsOfSecondOrderWithBothParametersOne) {
  EXPECT_NEAR(oscillator_order(1, 1), 2.0, 0.1);
}

TEST(Multistep, IsOfFirstOrderWithThePapersParameters) {
  EXPECT_NEAR(oscillator_order(0.7586, 1.101), 1.0, 0.1);
}

TEST(Multistep, AConstantAccelerationHasNoDifference) {
  EXPECT_EQ(multistep_difference(-9.81, -9.81, -9.81), 0.0);
}

class IntegratorOf : public testing::TestWithParam<Integrator> {};

// A block far from everything: positions and velocities of free fall, to round-off.
TEST_P(IntegratorOf, FreeFallIsExact) {
  for (const int dimension : {2, 3}) {
    Scene scene(dimension, 0.1, 9.81, 20.0);
    scene.setup.formulation.integrator = GetParam();
    const Vector3d start(0.3, 0.2, dimension == 3 ? 0.1 : 0.0);
    scene.add_block({0, 0, 0}, {1, 1, dimension == 3 ? 1.0 : 0.0}, start);
    const auto solver = make_solver(scene.setup);
    solver->start({});
    const double dt = solver->largest_step(5.0);
    constexpr int kSteps = 60;
    for (int k = 0; k < kSteps; ++k) solver->step(dt, {});
    const Snapshot s = solver->snapshot();
    const double t = kSteps * dt;
    for (std::size_t i = 0; i < scene.setup.fluid.position.size(); ++i) {
      const Vector3d x = scene.setup.fluid.position[i] + t * start + 0.5 * t * t * scene.setup.gravity;
      const Vector3d v = start + t * scene.setup.gravity;
      EXPECT_LT((Eigen::Map<const Vector3d>(&s.position[3 * i]) - x).norm(), 1e-10);
      EXPECT_LT((Eigen::Map<const Vector3d>(&s.velocity[3 * i]) - v).norm(), 1e-9);
    }
  }
}

// Velocities of a standing sound wave in a periodic box after a quarter of its period with that many steps,
// without dissipation, which no integrator takes at the same time as the rest.
std::vector<double> sound_wave(Integrator integrator, int steps) {
  constexpr int kCells = 16;
  Scene scene(2, 1.0 / kCells, 0.0, 10.0);
  scene.setup.gravity.setZero();
  scene.setup.period.length = {1, 1, 0};
  scene.setup.formulation.integrator = integrator;
  scene.setup.formulation.artificial_viscosity = 0;
  scene.setup.formulation.density_diffusion = 0;
  for (int b = 0; b < kCells; ++b)
    for (int a = 0; a < kCells; ++a) {
      const Vector3d x = (Vector3d(a + 0.5, b + 0.5, 0)) / kCells;
      scene.add_particle(x, {0.3 * std::sin(2 * std::numbers::pi * x.x()), 0, 0}, 0.0);
    }
  const auto solver = make_solver(scene.setup);
  solver->start({});
  for (int k = 0; k < steps; ++k) solver->step(0.025 / steps, {});
  const Snapshot s = solver->snapshot();
  std::vector<double> state = s.velocity;
  state.insert(state.end(), s.position.begin(), s.position.end());
  for (const double rho : s.density) state.push_back(rho / 1000.0);
  return state;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

// Order from the differences between three step lengths. First order is what the volumes and the divergence
// of the end of the step leave; only the predictor - corrector has all in the middle.
TEST_P(IntegratorOf, ConvergesWithTheStep) {
  const auto coarse = sound_wave(GetParam(), 80), middle = sound_wave(GetParam(), 160),
             fine = sound_wave(GetParam(), 320);
  const double order = std::log2(distance(coarse, middle) / distance(middle, fine));
  RecordProperty("order", std::to_string(order));
  EXPECT_GT(order, GetParam() == Integrator::predictor_corrector ? 1.8 : 0.9);
}

std::string name_of(const testing::TestParamInfo<Integrator>& test) {
  switch (test.param) {
    case Integrator::leap_frog:
      return "LeapFrog";
    case Integrator::predictor_corrector:
      return "PredictorCorrector";
    case Integrator::multistep:
      return "Multistep";
    default:
      return "KickDriftKick";
  }
}

INSTANTIATE_TEST_SUITE_P(Each, IntegratorOf,
                         testing::Values(Integrator::kick_drift_kick, Integrator::leap_frog,
                                         Integrator::predictor_corrector, Integrator::multistep),
                         name_of);

}  // namespace
}  // namespace sluice::fluid
