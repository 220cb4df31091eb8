#pragma once

// The stages of GalerkinSolver that several liquids need (README.md, "Several liquids").

#include "fluid/galerkin_solver.hpp"
#include "fluid/liquid_interface.hpp"
#include "fluid/stress.hpp"

namespace sluice::fluid {

// After sweep 1, which does not tell liquids apart.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::separate_liquids() {
  if constexpr (kHasGroups) {
    search_.halo().refresh_fits(fluid_);
    parallel_.for_each(fluid_.size(), [&](std::size_t i) { separate_at_interface(i); });
  }
}

// The divergence of a particle near another liquid as the work of its pressure asks for it
// (liquid_interface.hpp); and strain and density gradient by its own liquid alone, since dissipation
// must not take the other's velocity for strain, nor the kink of the pressure for noise.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::separate_at_interface(std::size_t i) {
  thread_local std::vector<std::uint32_t> own, other;
  own.clear();
  other.clear();
  const Node<Dim>& node = fluid_.node[i];
  const double reach2 = model_.kernel.support() * model_.kernel.support();
  for (const std::uint32_t k : search_.fluid_near_fluid(i)) {
    if ((node.x - fluid_.node[k].x).squaredNorm() >= reach2) continue;
    (fluid_.liquid[k] == fluid_.liquid[i] ? own : other).push_back(k);
  }
  fluid_.own[i].is_at_interface = !other.empty();
  if (other.empty()) return;

  double change = 0;
  for (const std::uint32_t k : other)
    change +=
        pressure_bias(fluid_.liquid_of(i), fluid_.liquid_of(k)) *
        (node.v - fluid_.node[k].v).dot(pair_area(model_, fluid_, i, k, Vec<Dim>(node.x - fluid_.node[k].x)));
  fluid_.divergence[i] += change / node.volume;

  GradientSweep<Dim, Kernel> sweep(model_, node);
  sweep.gather(own, fluid_.node);
  const Gradients<Dim> gradients = sweep.finish();
  fluid_.gradients[i].set(gradients.grad_rho, strain_rate<Dim>(gradients.L));
  fluid_.own[i].fit = gradients.fit;
}

// CF (60), after the pressures: of every liquid by itself. Spray has no shear, and where its own particles
// have no fit a liquid has none.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_own_stress() {
  parallel_.for_each(fluid_.size(), [&](std::size_t i) {
    OwnLiquid<Dim>& own = fluid_.own[i];
    const Fit<Dim>& fit = own.is_at_interface ? own.fit : fluid_.fit[i];
    Mat<Dim>& stress = fluid_.stress[i];
    stress.setZero();
    if (!fit.floored)
      stress = viscous_stress<Dim>(fluid_.liquid_of(i).viscosity, fluid_.gradients[i].strain());
    const Vec<Dim> s = fluid_.node[i].volume * (stress * fit.g);
    const Mat<Dim> S = fluid_.node[i].volume * (stress * fit.G);
    own.s.setZero();
    own.S.setZero();
    (own.is_at_interface ? own.s : fluid_.source[i].s) += s;
    (own.is_at_interface ? own.S : fluid_.source[i].S) += S;
  });
}

// Sweep 2.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::compute_liquid_forces() {
  if constexpr (kHasGroups)
    parallel_.for_each(fluid_.size(), [&](std::size_t i) {
      LiquidForceSweep<Dim, Kernel> sweep(model_, fluid_, i);
      sweep.gather_fluid(search_.fluid_near_fluid(i));
      sweep.gather_boundary(search_.boundary_near_fluid(i), boundary_);
      fluid_.acceleration[i] = model_.gravity + sweep.force() / fluid_.mass[i];
      mirror_guard_.accelerate(i, fluid_);
      fluid_.density_rate[i] = sweep.density_rate();
    });
}

}  // namespace sluice::fluid
