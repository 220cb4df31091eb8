#pragma once

#include <cmath>

namespace sluice::fluid {

// CF (64): p = kappa ((rho/rho0)^7 - 1) with kappa = rho0 c0^2 / 7, so that dp/drho = c0^2 at rho0.
// The power is written as products: libm's pow differs between processors.
class EquationOfState {
 public:
  EquationOfState(double rest_density, double sound_speed)
      : rho0_(rest_density), c0_(sound_speed), kappa_(rest_density * sound_speed * sound_speed / 7.0) {}

  [[nodiscard]] double rest_density() const { return rho0_; }
  [[nodiscard]] double sound_speed() const { return c0_; }
  [[nodiscard]] double kappa() const { return kappa_; }

  // [Pa] from [kg/m^3]
  [[nodiscard]] double pressure(double rho) const {
    const double x = rho / rho0_;
    const double x3 = x * x * x;
    return kappa_ * (x3 * x3 * x - 1.0);
  }

  // The inverse, CF (65). Used at the start only.
  [[nodiscard]] double density(double p) const { return rho0_ * std::pow(1.0 + p / kappa_, 1.0 / 7.0); }

  // Density of the liquid at rest under a column of potential `head` = g (H - z) [J/kg]: from dp = rho g dz,
  //   7 kappa / (6 rho0) ((rho/rho0)^6 - 1) = head.
  // CF (65) has the pressure of an incompressible column instead, with which the start is not quite at rest.
  [[nodiscard]] double hydrostatic_density(double head) const {
    return rho0_ * std::pow(1.0 + 6.0 * rho0_ * head / (7.0 * kappa_), 1.0 / 6.0);
  }

  // The head at which that density has the pressure p [J/kg].
  [[nodiscard]] double head(double p) const {
    return 7.0 * kappa_ / (6.0 * rho0_) * (std::pow(1.0 + p / kappa_, 6.0 / 7.0) - 1.0);
  }

  // Work stored per mass [J/kg] between rho0 and rho: the integral of p/rho^2 drho.
  [[nodiscard]] double elastic_energy(double rho) const {
    const double x = rho / rho0_;
    const double x3 = x * x * x;
    return kappa_ / rho0_ * (x3 * x3 / 6.0 + 1.0 / x - 7.0 / 6.0);
  }

 private:
  double rho0_, c0_, kappa_;
};

}  // namespace sluice::fluid
