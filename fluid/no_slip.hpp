#pragma once

#include <span>

#include "fluid/boundary.hpp"
#include "fluid/model.hpp"
#include "fluid/particles.hpp"
#include "fluid/stress.hpp"

namespace sluice::fluid {

// What no-slip surfaces near fluid particle i add to its strain rate [1/s]: the boundary particles' sticking
// velocities in the gradient CF (62), without a trace. The divergence sees the sliding mirror image only: a
// velocity that is reversed along the surface has, beside disordered particles, a divergence of its own,
// which changes the pressure and brings energy in.
template <int Dim, typename Kernel>
Mat<Dim> sticking_strain(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid, std::size_t i,
                         std::span<const std::uint32_t> neighbors, const BoundaryParticles<Dim>& boundary) {
  const Fit<Dim>& fit = fluid.fit[i];
  Mat<Dim> L = Mat<Dim>::Zero();
  for (const std::uint32_t w : neighbors) {
    if (!boundary.no_slip(w)) continue;
    const Node<Dim>& node = boundary.node()[w];
    const Vec<Dim> x_wi = node.x - fluid.node[i].x;
    const double VW = node.volume * model.kernel.value(x_wi);
    L += VW * boundary.sticking[w] * (fit.g + fit.G * x_wi).transpose();
  }
  const Mat<Dim> d = strain_rate<Dim>(L);
  return d - d.trace() / Dim * Mat<Dim>::Identity();
}

}  // namespace sluice::fluid
