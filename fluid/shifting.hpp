#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/free_surface.hpp"
#include "fluid/model.hpp"

namespace sluice::fluid {

// sum_j V_j grad W(x_ij) = -sum_j V_j F x_ij
template <int Dim, typename Kernel>
Vec<Dim> concentration_gradient(const Model<Dim, Kernel>& model, const Vec<Dim>& x,
                                std::span<const std::uint32_t> neighbors,
                                const std::vector<Node<Dim>>& node) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const std::uint32_t j : neighbors) {
    const Vec<Dim> x_ij = x - node[j].x;
    sum -= node[j].volume * model.kernel.value_and_slope(x_ij).f * x_ij;
  }
  return sum;
}

// Particle shifting: particles drift from where they crowd to where they are sparse, with the velocity
//   -S h^2 |d| sum_j V_j grad W(x_ij),      |d| the norm of the strain rate,
// (S. Lind, R. Xu, P. Stansby, B. Rogers, J. Comput. Phys. 231, 2012, Fick's law; scaled with the strain
// rate, which tears the arrangement, so that rest and rigid motion have none). Density is carried along with
// its gradient; particles keep their velocity, and so the fluid its momentum. Fluid that has a surface
// particle in its support drifts along the surface only, which does not move by it; spray not at all. Costs
// one more sweep.
template <int Dim>
class Shifting {
 public:
  // `strength` is S; 0 switches it off.
  explicit Shifting(double strength) : strength_(strength) {}

  [[nodiscard]] bool is_used() const { return strength_ > 0.0; }

  // The drift velocities for the next step, from the present arrangement.
  template <typename Kernel>
  void compute(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
               const BoundaryParticles<Dim>& boundary, const NeighborSearch<Dim>& search,
               const FreeSurface<Dim>& surface, const Parallel& parallel);
  // Moves the particles by dt [s].
  void apply(double dt, Particles<Dim>& fluid, const Parallel& parallel) const;

  auto state() { return std::tie(velocity_); }

 private:
  double strength_;
  std::vector<Vec<Dim>> velocity_;  // [m/s]
};

template <int Dim>
template <typename Kernel>
void Shifting<Dim>::compute(const Model<Dim, Kernel>& model, const Particles<Dim>& fluid,
                            const BoundaryParticles<Dim>& boundary, const NeighborSearch<Dim>& search,
                            const FreeSurface<Dim>& surface, const Parallel& parallel) {
  velocity_.assign(fluid.size(), Vec<Dim>::Zero());
  parallel.for_each(fluid.size(), [&](std::size_t i) {
    if (fluid.is_buffer(i) || fluid.fit[i].floored) return;
    const auto neighbors = search.fluid_near_fluid(i);
    const Vec<Dim>& x = fluid.node[i].x;
    const Vec<Dim> crowding =
        concentration_gradient<Dim>(model, x, neighbors, fluid.node) +
        concentration_gradient<Dim>(model, x, search.boundary_near_fluid(i), boundary.node());
    const Vec<Dim> normal = surface.normal(i, fluid, search);
    velocity_[i] = -strength_ * model.h * model.h * fluid.gradients[i].strain().norm() *
                   (crowding - crowding.dot(normal) * normal);
  });
}

template <int Dim>
void Shifting<Dim>::apply(double dt, Particles<Dim>& fluid, const Parallel& parallel) const {
  parallel.for_each(velocity_.size(), [&](std::size_t i) {
    const Vec<Dim> way = dt * velocity_[i];
    fluid.node[i].x += way;
    fluid.node[i].rho += fluid.gradients[i].grad_rho().dot(way);
  });
}

}  // namespace sluice::fluid
