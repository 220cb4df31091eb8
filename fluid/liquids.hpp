#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "fluid/setup.hpp"

namespace sluice::fluid {

// Of one liquid of several, in terms of the reference, Setup::liquid. Their stiffness rho0 c0^2 is the same,
// so that one equation of state holds for all if densities are taken over that at zero pressure.
struct LiquidConstants {
  double relative_density = 1;  // rho0 over the reference's
  double viscosity = 0;         // mu [Pa s]
  // Coefficient of the pairwise viscosity, alpha h c0 rho0 + 2 (Dim + 2) mu, and of that with other liquids,
  // which is the latter term [Pa s]; of the density diffusion, 2 delta h c0 [m^2/s].
  double pair_viscosity = 0, friction = 0;
  double density_diffusion = 0;
};

// Empty with one liquid.
inline std::vector<LiquidConstants> liquid_constants(const Setup& setup) {
  const Formulation& f = setup.formulation;
  const double h = f.smoothing * setup.spacing;
  std::vector<LiquidConstants> all;
  for (const Liquid& liquid : setup.liquids) {
    const double friction = 2.0 * (setup.dimension + 2) * liquid.viscosity;
    all.push_back(
        {.relative_density = liquid.density / setup.liquid.density,
         .viscosity = liquid.viscosity,
         .pair_viscosity = f.artificial_viscosity * h * liquid.sound_speed * liquid.density + friction,
         .friction = friction,
         .density_diffusion = 2.0 * f.density_diffusion * h * liquid.sound_speed});
  }
  return all;
}

// Between particles of two liquids the mean of the pressures weighs each with the other's density, as the
// pressure between them does that accelerates both alike:
//   p_ik = (rho_k p_i + rho_i p_k)/(rho_i + rho_k) = (p_i + p_k)/2 + theta (p_i - p_k)/2
// (X. Hu, N. Adams, J. Comput. Phys. 213, 2006). This is theta.
inline double pressure_bias(const LiquidConstants& i, const LiquidConstants& k) {
  return (k.relative_density - i.relative_density) / (k.relative_density + i.relative_density);
}

// Of the friction coefficients: the harmonic mean, so that the heavier liquid's does not drag the lighter
// one; zero if one is.
inline double mean_friction(const LiquidConstants& i, const LiquidConstants& k) {
  const double sum = i.friction + k.friction;
  return sum > 0.0 ? 2.0 * i.friction * k.friction / sum : 0.0;
}

}  // namespace sluice::fluid
