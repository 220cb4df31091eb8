#pragma once

// From densities to accelerations: stress, boundary, sweep 2, and the volumes of the next step.

#include "fluid/damped_viscosity.hpp"
#include "fluid/galerkin_boundary.hpp"
#include "fluid/galerkin_liquids.hpp"
#include "fluid/galerkin_solver.hpp"
#include "fluid/lumped_mass.hpp"
#include "fluid/operator_sweep.hpp"
#include "fluid/stress.hpp"
#include "fluid/stress_points.hpp"
#include "fluid/symmetrized_force.hpp"
#include "fluid/tension_control.hpp"

namespace sluice::fluid {

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::evaluate_forces() {
  compute_stress();
  compute_actions();
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::evaluate() {
  evaluate_forces();
  take_reactions();
  update_volumes();
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_actions() {
  extrapolate_to_boundary();
  return_forces();
  if (tension_control_ || shifting_.is_used()) surface_.detect(model_, fluid_, parallel_);
  compute_forces();
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::take_reactions() {
  collect_wrenches();
  if (shifting_.is_used()) shifting_.compute(model_, fluid_, boundary_, search_, surface_, parallel_);
}

// V_k of the quadrature. Node::volume weighs the neighbours in the moments, CF (11), and is the same then;
// with weights CF (12) that stays what it was at the start.
template <int Dim, typename Kernel>
double GalerkinSolver<Dim, Kernel>::quadrature_volume(std::size_t i) const {
  const Node<Dim>& node = fluid_.node[i];
  return weights_ == Weights::kernel ? fluid_.mass[i] / node.rho : node.volume;
}

// CF (64), and what sweep 2 takes of the stress. The volumes stay those of sweep 1, so that sum grad N = 0
// holds for the forces too.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::set_stress(std::size_t i) {
  fluid_.pressure[i] = model_.eos.pressure(fluid_.node[i].rho);
  if (fluid_.source.empty())
    fluid_.gradients[i].V_sigma = -quadrature_volume(i) * fluid_.pressure[i];
  else
    set_source(i);
}

// CF (60).
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::set_source(std::size_t i) {
  using Rule = Operator<Dim, Kernel>;
  if constexpr (Rule::kIsDefault)
    if (fluid_.stress.empty())
      return fluid::set_source<Dim>(-quadrature_volume(i) * fluid_.pressure[i], fluid_.fit[i],
                                    fluid_.source[i]);
  Mat<Dim> sigma = -fluid_.pressure[i] * Mat<Dim>::Identity();
  if constexpr (Rule::kIsIsobaric) sigma.setZero();
  if (!fluid_.stress.empty() && !fluid_.has_several_liquids()) {
    // Where G is not the exact inverse, a shear stress would exert a moment: spray has none.
    fluid_.stress[i] = fluid_.fit[i].floored ? Mat<Dim>::Zero()
                                             : viscous_stress<Dim>(model_.mu, fluid_.gradients[i].strain());
    sigma += fluid_.stress[i];
  }
  if constexpr (Rule::kIsDefault)
    fluid::set_source<Dim>(quadrature_volume(i), sigma, fluid_.fit[i], fluid_.source[i]);
  else if constexpr (Rule::kHasPoints)
    Rule::set_source(model_.eos, quadrature_volume(i), sigma, coefficients_[i], fluid_, i);
  else
    Rule::set_source(quadrature_volume(i), sigma, coefficients_[i], fluid_, i);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_stress() {
  parallel_.for_each(fluid_.size(), [&](std::size_t i) { set_stress(i); });
  complete_stress();
}

// What several liquids, the surface and the images add.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::complete_stress() {
  if (fluid_.has_several_liquids() && !fluid_.stress.empty()) compute_own_stress();
  if (surface_tension_.is_used()) surface_tension_.compute(search_, boundary_, parallel_, fluid_);
  if (background_cells_.is_used()) background_cells_.compute(search_, boundary_, parallel_, fluid_);
  search_.halo().refresh_sources(fluid_, parallel_);
}

// Sweep 2.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_forces() {
  const Stopwatch watch(times_.forces);
  if constexpr (kHasGroups)
    if (by_groups_) group_stages().compute_forces(boundary_, mirror_guard_, fluid_);
  if (!by_groups_) compute_single_forces();
  if (tension_control_) relieve_tension();
  if (surface_tension_.is_used()) surface_tension_.accelerate(parallel_, fluid_);
  if (background_cells_.is_used()) background_cells_.accelerate(parallel_, fluid_);
  if (boundary_forces_.is_used()) boundary_forces_.accelerate(search_, boundary_, parallel_, fluid_);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_single_forces() {
  if (fluid_.has_several_liquids()) return compute_liquid_forces();
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    ForceSweep<Dim, Kernel> sweep(model_, fluid_, i);
    sweep.gather_fluid(search_.fluid_near_fluid(i));
    sweep.gather_boundary(search_.boundary_near_fluid(i), boundary_);
    Vec<Dim> force = sweep.force();
    if (is_symmetrized_ || is_damped_) force += further_force(i);
    fluid_.acceleration[i] = model_.gravity + force / inertia(i);
    mirror_guard_.accelerate(i, fluid_);
    fluid_.density_rate[i] = sweep.density_rate();
  });
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::relieve_tension() {
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    const Vec<Dim> force = tension_correction(model_, fluid_, boundary_, search_, surface_, i);
    if (!force.isZero(0.0)) fluid_.acceleration[i] += force / inertia(i);
  });
}

// Of the formulations that have sweeps of their own.
template <int Dim, typename Kernel>
Vec<Dim> GalerkinSolver<Dim, Kernel>::further_force(std::size_t i) const {
  Vec<Dim> force = Vec<Dim>::Zero();
  if constexpr (Operator<Dim, Kernel>::kIsDefault)
    if (is_symmetrized_) force += symmetrized_extra<Dim>(model_, fluid_, boundary_, search_, i);
  if constexpr (HasLaplacian<Kernel, Dim>)
    if (is_damped_) force += damped_force<Dim>(model_, fluid_, boundary_, search_, i);
  return force;
}

// What the force on a particle is divided by [kg].
template <int Dim, typename Kernel>
double GalerkinSolver<Dim, Kernel>::inertia(std::size_t i) const {
  if constexpr (Operator<Dim, Kernel>::kHasSumOne)
    if (has_lumped_mass_) return lumped_mass<Dim>(model_, fluid_, boundary_, search_, i);
  return fluid_.mass[i];
}

// V = m/rho, for the next step: until here sweep 2 needed the volumes of sweep 1.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::update_volume(std::size_t i) {
  if (weights_ == Weights::kernel_and_volume)
    fluid_.node[i].volume = fluid_.mass[i] / (fluid_.node[i].rho * fluid_.relative_density(i));
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::update_volumes() {
  parallel_.for_each(fluid_.size(), [&](std::size_t i) { update_volume(i); });
  update_boundary_volumes();
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::update_boundary_volumes() {
  for_active_boundary([&](std::size_t w) {
    boundary_.node()[w].volume = boundary_.sampled_volume(w) * boundary_.dilation[w];
  });
}

}  // namespace sluice::fluid
