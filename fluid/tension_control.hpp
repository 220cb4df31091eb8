#pragma once

#include <algorithm>
#include <span>

#include "fluid/boundary.hpp"
#include "fluid/free_surface.hpp"
#include "fluid/model.hpp"

namespace sluice::fluid {

// Force of a uniform unit pressure on particle i, over its volume: zero on a lattice; else it drives the
// arrangement, to order under pressure and to clumps and voids under tension.
//   U_i = sum_k V_k W_ik (g_k + G_k x_ik), over the fluid and i itself
template <int Dim, typename Kernel>
Vec<Dim> disorder(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                  std::span<const std::uint32_t> neighbors, std::size_t i) {
  const Vec<Dim>& x = fluid.node[i].x;
  Vec<Dim> sum = model.kernel.at_zero() * fluid.node[i].volume * fluid.fit[i].g;
  for (const std::uint32_t k : neighbors) {
    const Vec<Dim> x_ik = x - fluid.node[k].x;
    const double VW = fluid.node[k].volume * model.kernel.value(x_ik);
    sum += VW * (fluid.fit[k].g + fluid.fit[k].G * x_ik);
  }
  return sum;
}

template <int Dim, typename Kernel>
bool sees_boundary(const Model<Dim, Kernel>& model, const Vec<Dim>& x,
                   std::span<const std::uint32_t> neighbors, const BoundaryParticles<Dim>& boundary) {
  const double support2 = model.kernel.support() * model.kernel.support();
  return std::any_of(neighbors.begin(), neighbors.end(),
                     [&](std::uint32_t w) { return (boundary.node()[w].x - x).squaredNorm() < support2; });
}

// Under tension, away from the free surface and from boundaries, the pressure of a particle is taken relative
// to its own,
//   -V_i sum_k W_ik V_k (p_k - p_i) (g_k + G_k x_ik),
// so that uniform tension has no force on the arrangement (P. Sun, A. Colagrossi, S. Marrone, M. Antuono,
// A. Zhang, Comput. Phys. Commun. 224, 2018). Nothing is clamped: density and volume are untouched. The term
// is not pairwise: momentum inside the fluid closes only to the order of the disorder times the tension; that
// between fluid and bodies stays exact. Particles under
// pressure cost nothing. Returns the additional force on particle i.
template <int Dim, typename Kernel>
Vec<Dim> tension_correction(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                            const BoundaryParticles<Dim>& boundary, const NeighborSearch<Dim>& search,
                            const FreeSurface<Dim>& surface, std::size_t i) {
  const double p = fluid.pressure[i];
  if (p >= 0.0 || !surface.is_deep(i, search)) return Vec<Dim>::Zero();
  if (sees_boundary<Dim>(model, fluid.node[i].x, search.boundary_near_fluid(i), boundary))
    return Vec<Dim>::Zero();
  return -p * fluid.node[i].volume * disorder<Dim>(model, fluid, search.fluid_near_fluid(i), i);
}

}  // namespace sluice::fluid
