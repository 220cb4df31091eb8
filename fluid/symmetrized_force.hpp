#pragma once

#include "fluid/force_sweep.hpp"
#include "fluid/tension_control.hpp"

namespace sluice::fluid {

// What CF (105) has more than CF (43) at particle i:
//   -V_i sigma_i sum_k V_k W_ik (g_k + G_k x_ik),   over fluid and boundary; see `disorder`.
// With moving least squares it is not pairwise antisymmetric, CF (107), so momentum is not conserved: a
// comparator. Cost: one more sweep.
template <int Dim, typename Kernel>
Vec<Dim> symmetrized_extra(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                           const BoundaryParticles<Dim>& boundary, const NeighborSearch<Dim>& search,
                           std::size_t i) {
  const Node<Dim>& node = fluid.node[i];
  Vec<Dim> sum = disorder<Dim>(model, fluid, search.fluid_near_fluid(i), i);
  for (const std::uint32_t w : search.boundary_near_fluid(i)) {
    const Vec<Dim> x_iw = node.x - boundary.node()[w].x;
    sum += boundary.sampled_volume(w) * model.kernel.value(x_iw) * model.boundary_G * x_iw;
  }
  Vec<Dim> force = node.volume * fluid.pressure[i] * sum;
  if (!fluid.stress.empty()) force -= node.volume * (fluid.stress[i] * sum);
  return force;
}

// The same at boundary particle w, as a node with the stress given to it, and the opposite of what it has
// more as a quadrature point.
template <int Dim, typename Kernel>
void add_symmetrized_reaction(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                              std::span<const std::uint32_t> neighbors, std::size_t w,
                              const BoundaryParticles<Dim>& boundary, Reaction<Dim>& sum) {
  const Node<Dim>& node = boundary.node()[w];
  for (const std::uint32_t i : neighbors) {
    const Vec<Dim> x_iw = fluid.node[i].x - node.x;
    const double W = model.kernel.value(x_iw), V_i = fluid.node[i].volume;
    const Vec<Dim> gradient = V_i * W * (fluid.fit[i].g - fluid.fit[i].G * x_iw);
    const Vec<Dim> lattice = V_i * boundary.sampled_volume(w) * W * model.boundary_G * x_iw;
    sum.force += node.volume * boundary.pressure[w] * gradient - fluid.pressure[i] * lattice;
    if (fluid.stress.empty()) continue;
    sum.force -= node.volume * (boundary.stress[w] * gradient) - fluid.stress[i] * lattice;
  }
}

}  // namespace sluice::fluid
