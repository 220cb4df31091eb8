#include "fluid/shifting.hpp"

namespace sluice::fluid {

namespace {

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
                            const FreeSurface<Dim>& surface, const Parallel& parallel) {
  velocity_.assign(fluid.size(), Vec<Dim>::Zero());
  parallel.for_each(fluid.size(), [&](std::size_t i) {
    if (!surface.is_deep(i, search)) return;
    const auto neighbors = search.fluid_near_fluid(i);
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
