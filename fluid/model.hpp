#pragma once

#include "fluid/approximation.hpp"
#include "fluid/equation_of_state.hpp"
#include "fluid/kernel.hpp"
#include "fluid/lattice.hpp"
#include "fluid/setup.hpp"

namespace sluice::fluid {

// Reach of the penetration guard (force_sweep.hpp) over dx; on a lattice no fluid is nearer to a boundary
// particle than 1. The way between four of them in space is wider than that between two in the plane: with
// 3/4 fluid at 0.09 c0 came through, here at 0.29 c0, in the plane at 0.35 c0.
template <int Dim>
inline constexpr double kGuardRange = Dim == 2 ? 0.75 : 0.85;

// The constants of a run, derived once from the setup.
template <int Dim, typename Kernel = WendlandC2<Dim>>
struct Model {
  explicit Model(const Setup& setup)
      : spacing(setup.spacing),
        h(setup.formulation.smoothing * setup.spacing),
        kernel(h),
        eos(setup.liquid.density, setup.liquid.sound_speed),
        gravity(narrow<Dim>(setup.gravity)),
        mu(setup.liquid.viscosity),
        density_diffusion(2.0 * setup.formulation.density_diffusion * h * setup.liquid.sound_speed),
        artificial_viscosity(setup.formulation.artificial_viscosity * h * setup.liquid.sound_speed *
                                 setup.liquid.density +
                             2.0 * (Dim + 2) * setup.liquid.viscosity),
        lattice_moment(fluid::lattice_moment<Dim>(kernel, setup.spacing)),
        lattice_sum(fluid::lattice_sum<Dim>(kernel, setup.spacing)),
        lattice_slope(fluid::lattice_slope<Dim>(kernel, setup.spacing)),
        moment_floor(setup.formulation.moment_floor * lattice_moment),
        slope_floor(setup.formulation.moment_floor * lattice_slope),
        tiny_r2(1e-4 * h * h),
        guard_range(setup.formulation.boundary == BoundaryTreatment::layers ? kGuardRange<Dim> * setup.spacing
                                                                            : 0.0),
        guard_stiffness(setup.liquid.density * setup.fluid.volume * setup.liquid.sound_speed *
                        setup.liquid.sound_speed / (setup.spacing * setup.spacing)),
        first_volume(setup.fluid.volume),
        boundary_G(Operator<Dim, Kernel>::lattice_G(lattice_moment, lattice_slope)),
        extra_reach(Operator<Dim, Kernel>::extra_reach(setup.spacing)),
        points(stress_points<Dim>(setup.spacing)),
        isobaric_scale(setup.formulation.isobaric_scale) {}

  double spacing;  // dx [m]
  double h;        // smoothing length [m]
  Kernel kernel;
  EquationOfState eos;
  Vec<Dim> gravity;             // [m/s^2]
  double mu;                    // [Pa s]
  double density_diffusion;     // 2 delta h c0 [m^2/s]
  double artificial_viscosity;  // alpha h c0 rho0 [Pa s]
  double lattice_moment;        // eigenvalue of C on the undisturbed lattice [m^2]
  double lattice_sum;           // of V W on the undisturbed lattice [-]
  double lattice_slope;         // the same of the sum of V F x (x) x [-]
  double moment_floor;          // [m^2]
  double slope_floor;           // [-]
  double tiny_r2;               // (h/100)^2 [m^2], keeps coincident particles from a division by zero
  double guard_range;           // of the penetration guard [m], 0 with boundary forces; see force_sweep.hpp
  double guard_stiffness;       // m c0^2 / dx^2 [N/m]
  double first_volume;          // of every fluid particle [m^Dim]
  double boundary_G;            // G of boundary particles, the lattice's, times identity [1/m^2]
  double extra_reach;           // beyond the support at which particles act on each other [m]
  std::array<Vec<Dim>, Particles<Dim>::kPoints> points;  // stress points of a particle, from it [m]
  double isobaric_scale;                                 // delta of PC (15)
};

}  // namespace sluice::fluid
