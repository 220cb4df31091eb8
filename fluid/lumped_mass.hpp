#pragma once

#include <algorithm>

#include "fluid/boundary.hpp"
#include "fluid/model.hpp"
#include "fluid/neighbor_search.hpp"

namespace sluice::fluid {

// Smallest lumped mass over the particle's own: where few particles extrapolate, N_i may be negative.
inline constexpr double kLeastLumpedMass = 0.1;

// The lumped mass of the Galerkin form at particle i, CF (56) with nodal quadrature, [kg]:
//   M_i = sum_k m_k N_i(x_k),   N_i(x_k) = V_i W (a_k + b_k.x_ik),
// over the fluid, i itself and the boundary, whose particles have the lattice's shape functions and the mass
// of the fluid they stand in for, so that a lattice beside a wall has the physical masses. The sum over all i
// is the mass of the fluid, CF (57), where there is no boundary. M_i changes as particles move, so sum m_i
// v_i is conserved only as far as it does not. Deviation: M_i is kept above a tenth of m_i. Cost: one more
// sweep.
template <int Dim, typename Kernel>
double lumped_mass(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                   const BoundaryParticles<Dim>& boundary, const NeighborSearch<Dim>& search, std::size_t i) {
  using Rule = Operator<Dim, Kernel>;
  const Node<Dim>& node = fluid.node[i];
  double sum = fluid.mass[i] * model.kernel.at_zero() * Rule::shape_function(fluid.fit[i]).a;
  for (const std::uint32_t k : search.fluid_near_fluid(i)) {
    const Vec<Dim> x_ik = node.x - fluid.node[k].x;
    const ShapeFunction<Dim> N = Rule::shape_function(fluid.fit[k]);
    sum += fluid.mass[search.halo().particle(k, fluid)] * model.kernel.value(x_ik) * (N.a + N.b.dot(x_ik));
  }
  for (const std::uint32_t w : search.boundary_near_fluid(i)) {
    const Node<Dim>& wall = boundary.node()[w];
    sum += wall.rho * wall.volume * model.kernel.value(Vec<Dim>(node.x - wall.x)) / model.lattice_sum;
  }
  return std::max(node.volume * sum, kLeastLumpedMass * fluid.mass[i]);
}

}  // namespace sluice::fluid
