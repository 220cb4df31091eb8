#include "fluid/equation_of_state.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace sluice::fluid {
namespace {

constexpr double kRho0 = 998.0, kC0 = 23.0;

TEST(EquationOfState, IsTheSeventhPower) {
  const EquationOfState eos(kRho0, kC0);
  EXPECT_EQ(eos.pressure(kRho0), 0.0);
  EXPECT_DOUBLE_EQ(eos.kappa(), kRho0 * kC0 * kC0 / 7.0);
  for (const double x : {0.7, 0.99, 1.001, 1.1, 1.5})
    EXPECT_NEAR(eos.pressure(x * kRho0), eos.kappa() * (std::pow(x, 7.0) - 1.0), 1e-12 * eos.kappa());
}

TEST(EquationOfState, SoundSpeedIsTheSlopeAtRest) {
  const EquationOfState eos(kRho0, kC0);
  const double e = 1e-5 * kRho0;
  const double slope = (eos.pressure(kRho0 + e) - eos.pressure(kRho0 - e)) / (2.0 * e);
  EXPECT_NEAR(slope / (kC0 * kC0), 1.0, 1e-8);
}

// Any liquid: density and pressure invert each other.
RC_GTEST_PROP(EquationOfState, DensityInvertsPressure, ()) {
  const double rho0 = *rc::gen::inRange(1, 20'000) * 1.0;
  const double c0 = *rc::gen::inRange(1, 200'000) * 0.01;
  const double x = *rc::gen::inRange(700, 1'500) * 1e-3;
  const EquationOfState eos(rho0, c0);
  RC_ASSERT(std::abs(eos.density(eos.pressure(x * rho0)) / (x * rho0) - 1.0) < 1e-13);
}

// Simpson's rule for the integral of p / rho^2 from rho0.
double stored_work(const EquationOfState& eos, double rho) {
  const int n = 2000;
  const double step = (rho - eos.rest_density()) / n;
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double at = eos.rest_density() + k * step;
    sum += (k == 0 || k == n ? 1.0 : (k % 2 ? 4.0 : 2.0)) * eos.pressure(at) / (at * at);
  }
  return sum * step / 3.0;
}

TEST(EquationOfState, ElasticEnergyIsTheWorkOfCompression) {
  const EquationOfState eos(kRho0, kC0);
  EXPECT_NEAR(eos.elastic_energy(kRho0), 0.0, 1e-13 * kC0 * kC0);
  for (const double x : {0.8, 0.95, 0.99, 1.01, 1.05, 1.3})
    EXPECT_NEAR(eos.elastic_energy(x * kRho0) / stored_work(eos, x * kRho0), 1.0, 1e-9) << "x = " << x;
}

TEST(EquationOfState, HydrostaticColumnIsInBalance) {
  const EquationOfState eos(kRho0, kC0);
  const double g = 9.81, height = 2.0, e = 1e-4;
  EXPECT_EQ(eos.hydrostatic_density(0.0), kRho0);
  const auto rho = [&](double z) { return eos.hydrostatic_density(g * (height - z)); };
  for (double z = 0.1; z < 1.95; z += 0.1) {
    const double slope = (eos.pressure(rho(z + e)) - eos.pressure(rho(z - e))) / (2.0 * e);
    EXPECT_NEAR(slope / (-rho(z) * g), 1.0, 1e-7) << "z = " << z;
  }
}

}  // namespace
}  // namespace sluice::fluid
