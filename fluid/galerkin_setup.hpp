#pragma once

// How GalerkinSolver is made from a Setup, and the step that it allows.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fluid/galerkin_solver.hpp"

namespace sluice::fluid {

namespace stages {

// Neighbour lists reach this share of the support beyond it: the optimum between longer lists and rarer
// rebuilds was flat between 0.1 and 0.2 in a developed dam break.
inline constexpr double kSkin = 0.1;

// Whether the sweeps go by groups of particles (group_stages.hpp) and not by single ones.
template <int Dim, typename Kernel>
bool goes_by_groups(const Setup& setup) {
  const Formulation& formulation = setup.formulation;
  return GalerkinSolver<Dim, Kernel>::kHasGroups && formulation.internal_force == InternalForce::galerkin &&
         formulation.viscous_force == ViscousForce::stress && formulation.mass == Mass::physical &&
         formulation.interpolated_motion == 0.0 && !formulation.initial_parameters && setup.liquids.empty();
}

template <int Dim, typename Kernel>
SearchPlan search_plan(const Setup& setup) {
  const bool groups = goes_by_groups<Dim, Kernel>(setup);
  const bool singles = !groups || setup.formulation.shifting > 0.0 || setup.formulation.tension_control ||
                       setup.liquid.surface_tension > 0.0 ||
                       setup.formulation.boundary == BoundaryTreatment::forces ||
                       setup.formulation.quadrature == Quadrature::background_cells;
  return {.singles = singles,
          .wall_singles = singles || setup.has_viscous_stress(),
          .groups = groups,
          .cell = group_edge<Dim>(setup.spacing)};
}

// How far the neighbour lists must reach [m].
template <int Dim, typename Kernel>
double reach(const Setup& setup, const Model<Dim, Kernel>& model) {
  return model.kernel.support() + model.extra_reach +
         BackgroundCells<Dim>::extra_reach(setup.formulation, setup.spacing);
}

// Whether pressure is all the stress that there is, in sweeps that can do with that.
template <int Dim, typename Kernel>
bool is_isotropic(const Setup& setup) {
  return goes_by_groups<Dim, Kernel>(setup) && !setup.has_viscous_stress() &&
         setup.liquid.surface_tension == 0.0 && setup.formulation.quadrature == Quadrature::nodal &&
         setup.openings.empty();
}

template <int Dim>
Particles<Dim> make_particles(const Setup& setup, const EquationOfState& eos, bool isotropic) {
  const FluidParticles& given = setup.fluid;
  const std::size_t n = given.position.size();
  Particles<Dim> fluid;
  fluid.mass.resize(n);
  fluid.node.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double rho = eos.density(given.pressure[i]);
    fluid.mass[i] = rho * given.volume;
    fluid.node[i] = {narrow<Dim>(given.position[i]), narrow<Dim>(given.velocity[i]), given.volume, rho};
  }
  fluid.liquid = given.liquid;
  fluid.liquids = liquid_constants(setup);
  if (fluid.has_several_liquids()) {
    fluid.own.resize(n);
    for (std::size_t i = 0; i < n; ++i) fluid.mass[i] *= fluid.relative_density(i);
  }
  fluid.id.resize(n);
  std::iota(fluid.id.begin(), fluid.id.end(), 0u);
  fluid.acceleration.assign(n, Vec<Dim>::Zero());
  fluid.density_rate.assign(n, 0.0);
  fluid.pressure.assign(n, 0.0);
  fluid.divergence.assign(n, 0.0);
  // An empty array is one that is not in use, and a tank may start without liquid.
  const std::size_t in_use = std::max<std::size_t>(n, 1);
  if (setup.has_viscous_stress()) fluid.stress.assign(in_use, Mat<Dim>::Zero());
  // Room for fits, gradients and sources comes with that for images, in the first search.
  if (!isotropic) fluid.source.resize(1);
  if (setup.formulation.approximation == Approximation::mls_full_derivative)
    fluid.slope_source.resize(in_use);
  if (setup.formulation.quadrature == Quadrature::stress_points)
    fluid.point_source.resize(Particles<Dim>::kPoints * n);
  return fluid;
}

template <int Dim, typename Kernel>
std::vector<LaggedAcceleration> make_lagged(const Setup& setup, const Model<Dim, Kernel>& model) {
  std::vector<LaggedAcceleration> lagged;
  for (const Boundary& body : setup.bodies)
    lagged.emplace_back(body.free_mass > 0.0, model.h / model.eos.sound_speed());
  return lagged;
}

}  // namespace stages

template <int Dim, typename Kernel>
GalerkinSolver<Dim, Kernel>::GalerkinSolver(const Setup& setup)
    : model_(setup),
      parallel_(setup.threads),
      fluid_(stages::make_particles<Dim>(setup, model_.eos, stages::is_isotropic<Dim, Kernel>(setup))),
      images_(setup),
      boundary_(setup, images_.with_images(setup.bodies)),
      search_(stages::reach(setup, model_), stages::kSkin * model_.kernel.support(), setup.period,
              stages::search_plan<Dim, Kernel>(setup), setup.mirrors),
      openings_(setup, model_.kernel.support() + model_.extra_reach, stages::kSkin * model_.kernel.support()),
      by_groups_(stages::goes_by_groups<Dim, Kernel>(setup)),
      period_(setup.period),
      mirror_guard_(setup.mirrors, model_),
      shifting_(setup.formulation.shifting),
      crowding_(setup.formulation.spreading, setup.gravity.norm(), model_),
      surface_tension_(setup, model_.kernel.support()),
      boundary_forces_(setup),
      background_cells_(setup),
      bodies_(setup.bodies.size()),
      lagged_(stages::make_lagged(setup, model_)),
      wrench_(setup.bodies.size() + 1),
      measure_wall_force_(setup.measure_wall_force),
      weights_(setup.formulation.weights),
      tension_control_(setup.formulation.tension_control),
      is_symmetrized_(setup.formulation.internal_force == InternalForce::symmetrized),
      is_damped_(setup.formulation.viscous_force == ViscousForce::damped),
      has_lumped_mass_(setup.formulation.mass == Mass::lumped),
      integrator_(setup.formulation.integrator),
      multistep_beta1_(setup.formulation.multistep_beta1),
      multistep_beta2_(setup.formulation.multistep_beta2),
      interpolated_motion_(setup.formulation.interpolated_motion),
      initial_parameters_(setup.formulation.initial_parameters),
      courant_(setup.formulation.courant),
      body_step_(setup.limit_step_by_bodies ? largest_body_step(setup)
                                            : std::numeric_limits<double>::infinity()) {}

template <int Dim, typename Kernel>
double GalerkinSolver<Dim, Kernel>::largest_step(double max_speed) const {
  double sound_speed = model_.eos.sound_speed();
  double viscosity = model_.artificial_viscosity / model_.eos.rest_density();  // kinematic
  for (const LiquidConstants& liquid : fluid_.liquids) {
    sound_speed = std::max(sound_speed, model_.eos.sound_speed() / std::sqrt(liquid.relative_density));
    // The mean friction is up to twice the smaller one.
    viscosity = std::max(viscosity, (liquid.pair_viscosity + liquid.friction) /
                                        (liquid.relative_density * model_.eos.rest_density()));
  }
  const double acoustic = model_.h / (sound_speed + max_speed);
  const double viscous = model_.h * model_.h / (viscosity + 1e-300);
  return std::min({courant_ * std::min(acoustic, viscous), body_step_, surface_tension_.largest_step()});
}

}  // namespace sluice::fluid
