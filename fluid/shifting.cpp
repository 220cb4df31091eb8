#include "fluid/shifting.hpp"

namespace sluice::fluid {

namespace {

// A particle is at the surface where there is little around it (on a calm surface m0 = 0.76, one row below
// 0.99) and that on one side (there |g| dx is 1.7 and 0.06). In torn fluid inside, one of the two may be so,
// not both.
template <int Dim>
bool is_at_surface(const Model<Dim>& model, const Fit<Dim>& fit) {
  return fit.m0 < 0.85 && fit.g.norm() * model.spacing > 0.5;
}

// sum_j V_j grad W(x_ij) = -sum_j V_j F x_ij
template <int Dim>
Vec<Dim> concentration_gradient(const Model<Dim>& model, const Vec<Dim>& x,
                                std::span<const std::uint32_t> neighbors,
                                const std::vector<Node<Dim>>& node) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const std::uint32_t j : neighbors) {
    const Vec<Dim> x_ij = x - node[j].x;
    sum -= node[j].volume * model.kernel.value_and_slope(x_ij.squaredNorm()).f * x_ij;
  }
  return sum;
}

}  // namespace

template <int Dim>
void Shifting<Dim>::compute(const Model<Dim>& model, const Particles<Dim>& fluid,
                            const BoundaryParticles<Dim>& boundary, const NeighborSearch<Dim>& search,
                            const Parallel& parallel) {
  at_surface_.resize(fluid.node.size());
  parallel.for_each(at_surface_.size(),
                    [&](std::size_t i) { at_surface_[i] = is_at_surface(model, fluid.fit[i]); });
  velocity_.assign(fluid.size(), Vec<Dim>::Zero());
  parallel.for_each(fluid.size(), [&](std::size_t i) {
    if (at_surface_[i]) return;
    const auto neighbors = search.fluid_near_fluid(i);
    for (const std::uint32_t j : neighbors)
      if (at_surface_[j]) return;
    const Vec<Dim>& x = fluid.node[i].x;
    const Vec<Dim> crowding =
        concentration_gradient<Dim>(model, x, neighbors, fluid.node) +
        concentration_gradient<Dim>(model, x, search.boundary_near_fluid(i), boundary.node());
    velocity_[i] = -strength_ * model.h * model.h * fluid.source[i].strain.norm() * crowding;
  });
}

template <int Dim>
void Shifting<Dim>::apply(double dt, Particles<Dim>& fluid, const Parallel& parallel) const {
  parallel.for_each(velocity_.size(), [&](std::size_t i) {
    const Vec<Dim> way = dt * velocity_[i];
    fluid.node[i].x += way;
    fluid.node[i].v += fluid.L[i] * way;
    fluid.node[i].rho += fluid.source[i].grad_rho.dot(way);
  });
}

template class Shifting<2>;
template class Shifting<3>;

}  // namespace sluice::fluid
