#pragma once

#include <cmath>
#include <span>

#include "fluid/force_sweep.hpp"
#include "fluid/model.hpp"
#include "fluid/neighbor_search.hpp"

namespace sluice::fluid {

template <typename Kernel, int Dim>
concept HasLaplacian = requires(const Kernel& kernel, const Vec<Dim>& x) {
  kernel.laplacian(x);
};

// Force of node j on node i by the viscosity PC (17)-(18):
//   f_ij = m_i m_j mu/2 (1/rho_j^2 + 1/rho_i^2) (v_j - v_i) lap W Gamma,
//   Gamma = exp(-2 |v_j - v_i|/c0 rho0^2/(rho_i rho_j) R/r),   R the support radius.
// Deviations: the print weighs v_j and v_i instead of their difference, so that a uniform velocity has a
// force; its exponent has units, made a number here by the references c0, rho0 and R. Pairwise antisymmetric:
// linear momentum is exact, the angular not. lap W is negative below r/R = Dim/(Dim + 3) as in the print:
// near neighbours are driven apart in velocity, and only the sum is a Laplacian. libm's exponential: bits
// differ between machines.
template <int Dim, typename Kernel>
Vec<Dim> damped_force(const Model<Dim, Kernel>& model, const Node<Dim>& i, const Node<Dim>& j) {
  const Vec<Dim> x_ij = i.x - j.x, v_ji = j.v - i.v;
  const double rho0 = model.eos.rest_density(), r = std::sqrt(x_ij.squaredNorm() + model.tiny_r2);
  const double exponent =
      v_ji.norm() / model.eos.sound_speed() * rho0 * rho0 / (i.rho * j.rho) * model.kernel.support() / r;
  const double weight = 0.5 * model.mu * (1.0 / (j.rho * j.rho) + 1.0 / (i.rho * i.rho));
  const double masses = i.rho * i.volume * j.rho * j.volume;
  return masses * weight * std::exp(-2.0 * exponent) * model.kernel.laplacian(x_ij) * v_ji;
}

// On fluid particle i, by fluid and boundary. Cost: one more sweep with an exponential a pair.
template <int Dim, typename Kernel>
Vec<Dim> damped_force(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                      const BoundaryParticles<Dim>& boundary, const NeighborSearch<Dim>& search,
                      std::size_t i) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const std::uint32_t j : search.fluid_near_fluid(i))
    sum += damped_force<Dim>(model, fluid.node[i], fluid.node[j]);
  for (const std::uint32_t w : search.boundary_near_fluid(i))
    sum += damped_force<Dim>(model, fluid.node[i], boundary.node()[w]);
  return sum;
}

// The exact reaction on boundary particle w.
template <int Dim, typename Kernel>
void add_damped_reaction(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                         std::span<const std::uint32_t> neighbors, const Node<Dim>& w, Reaction<Dim>& sum) {
  for (const std::uint32_t i : neighbors) {
    const Vec<Dim> force = damped_force<Dim>(model, fluid.node[i], w);
    sum.force -= force;
    sum.couple -= widen<Dim>(Vec<Dim>(fluid.node[i].x - w.x)).cross(widen<Dim>(force));
  }
}

}  // namespace sluice::fluid
