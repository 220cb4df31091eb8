#pragma once

// Sweep 1 of GalerkinSolver, and the density that follows from it.

#include "fluid/galerkin_liquids.hpp"
#include "fluid/galerkin_solver.hpp"
#include "fluid/gradient_sweep.hpp"
#include "fluid/no_slip.hpp"
#include "fluid/operator_sweep.hpp"
#include "fluid/stress.hpp"

namespace sluice::fluid {

// Sweep 1.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_gradients() {
  const Stopwatch watch(times_.gradients);
  if constexpr (kHasGroups)
    if (by_groups_) group_stages().compute_gradients(boundary_, fluid_);
  if (!by_groups_) compute_single_gradients();
  if (fluid_.has_several_liquids()) separate_liquids();
  // Corrected SPH threw a single particle of a splash out by it; boundary forces hold films off.
  if (Operator<Dim, Kernel>::kIsDefault && !bodies_.empty() && !boundary_forces_.is_used()) find_films();
  if (!boundary_.sticks()) return;
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    fluid_.gradients[i].half_strain +=
        0.5 * sticking_strain<Dim>(model_, fluid_, i, search_.boundary_near_fluid(i), boundary_);
  });
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_single_gradients() {
  if constexpr (!Operator<Dim, Kernel>::kIsDefault) coefficients_.resize(fluid_.size());
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    FirstSweep<Dim, Kernel> sweep(model_, fluid_.node[i]);
    sweep.gather(search_.fluid_near_fluid(i), fluid_.node);
    sweep.gather(search_.boundary_near_fluid(i), boundary_.node());
    const auto gradients = sweep.finish();
    if constexpr (!Operator<Dim, Kernel>::kIsDefault) coefficients_[i] = gradients.coefficients;
    fluid_.fit[i] = gradients.fit;
    fluid_.divergence[i] = gradients.L.trace();
    fluid_.gradients[i].set(gradients.grad_rho, strain_rate<Dim>(gradients.L));
  });
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::find_films() {
  const auto boundary_near = [this](std::size_t i, std::vector<std::uint32_t>& buffer) {
    return by_groups_ ? search_.groups().boundary_near_particle(i, buffer) : search_.boundary_near_fluid(i);
  };
  const auto fluid_near = [this](std::size_t i, const auto& visit) { for_fluid_near(i, visit); };
  films_.find(model_, boundary_, mirror_guard_.planes(), boundary_near, fluid_near, parallel_, fluid_);
}

// CF (70) with the divergence at the new positions, and the density diffusion of the last sweep 2. A particle
// with too few neighbours for a fit is spray: it carries no tension, and its pressure falls to the ambient
// one in the time that sound takes across it, since its own divergence hardly feels it. In a film the
// density rate is what leads to the pressure around it instead (films.hpp). Nor is there tension
// between a particle and a mirror (mirror_guard.hpp).
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::advance_density(std::size_t i, double dt) {
  const double rho0 = model_.eos.rest_density();
  const double acoustic_time = model_.h / model_.eos.sound_speed();
  double& rho = fluid_.node[i].rho;
  rho += dt * (fluid_.density_rate[i] - rho * fluid_.divergence[i]);
  if (rho < rho0 && mirror_guard_.is_film(fluid_.node[i].x)) rho = rho0;
  if (fluid_.fit[i].floored) rho = rho0 + std::max(0.0, rho - rho0) / (1.0 + dt / acoustic_time);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::advance_density(double dt) {
  parallel_.for_each(fluid_.size(), [&](std::size_t i) { advance_density(i, dt); });
}

}  // namespace sluice::fluid
