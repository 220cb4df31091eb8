#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/equation_of_state.hpp"
#include "fluid/force_sweep.hpp"
#include "fluid/kernel.hpp"
#include "fluid/neighbor_search.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"
#include "fluid/setup.hpp"

namespace sluice::fluid {

// Quadrature in the cells of a fixed grid of edge dx, CF (46) and fig. 1, instead of at the particles: 2^Dim
// points q in every cell, a quarter of its edge from its middle along every axis.
//   f_i = -sum_q W_q sigma_q grad N_i(x_q),   grad N_i(x_q) = V_i W (g_q + G_q x_iq),
// with the fit at x_q over fluid and boundary. Density and viscous stress are interpolated to the points by
// that fit, CF (49). Boundary particles stay quadrature points themselves.
//
// - The paper takes Gauss's rule, and does not say how cells that liquid fills in part are
//   weighed. Here every particle spreads its volume over the points within dx of it along
//   every axis, by the product of 1 - |x|/dx: the weights' sum and centre are those of the
//   particles' volumes, wherever the surface is, and all alike within the undisturbed
//   lattice.
// - Where the fit at a point is floored (spray), density is the mean of what is near, and there is no shear.
// - Linear and angular momentum close to round-off, since g = -G m1/m0 and G shares C's eigenvectors.
// - The paper calls it unsuited to Lagrangian flow, where the liquid's domain changes: a comparator.
// Cost: 2^Dim fits and as many times the pairs a particle; lists that reach sqrt(Dim) dx farther. In the
// plane sixteen times the default's time.
template <int Dim>
class BackgroundCells {
 public:
  explicit BackgroundCells(const Setup& setup);

  // How much farther than the support the neighbour lists must reach [m].
  static double extra_reach(const Formulation& formulation, double spacing);

  [[nodiscard]] bool is_used() const { return is_used_; }

  // Forces at the present places, volumes, densities and viscous stresses. Takes the place of CF (43): the
  // sources of sweep 2 are emptied, which leaves it the dissipation and what the boundary does.
  void compute(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
               const Parallel& parallel, Particles<Dim>& fluid);
  // Adds the forces.
  void accelerate(const Parallel& parallel, Particles<Dim>& fluid) const;
  // Adds their reactions on the boundary particles.
  void react(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
             const Parallel& parallel, const Particles<Dim>& fluid,
             std::vector<Reaction<Dim>>& reaction) const;

 private:
  // A point with weight. Its owner is one of the particles that gave it some: what is near the point is near
  // the owner.
  struct Point {
    Vec<Dim> x = Vec<Dim>::Zero();  // beside the owner, also where that is across a periodic side [m]
    double weight = 0;              // W_q [m^Dim]
    std::uint32_t owner = 0;
    Vec<Dim> s = Vec<Dim>::Zero();  // W_q sigma_q g_q
    Mat<Dim> S = Mat<Dim>::Zero();  // W_q sigma_q G_q
  };
  using Index = Eigen::Matrix<std::int64_t, Dim, 1>;

  void spread_volumes(const Particles<Dim>& fluid);
  void give(const Index& point, const Vec<Dim>& x, double volume, std::uint32_t particle);
  [[nodiscard]] std::uint64_t key(const Index& point) const;
  void sort_by_owner(std::size_t particles);
  void find_stress(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                   const Particles<Dim>& fluid, Point& q) const;
  [[nodiscard]] Mat<Dim> shear(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                               const Particles<Dim>& fluid, const Fit<Dim>& f, const Point& q) const;
  [[nodiscard]] Vec<Dim> flux(std::size_t owner, const Vec<Dim>& x) const;
  [[nodiscard]] Vec<Dim> flux_of(const NeighborSearch<Dim>& search, const Particles<Dim>& fluid,
                                 std::size_t k, const Vec<Dim>& x) const;

  bool is_used_;
  WendlandC2<Dim> kernel_;
  EquationOfState eos_;
  double floor_;            // of the fit's moments [m^2]
  Vec<Dim> origin_, edge_;  // of the points [m]
  Index count_;             // of points in a period; 0 where there is none
  // Of the present step:
  std::unordered_map<std::uint64_t, std::uint32_t> number_;  // of a point by its place in the grid
  std::vector<Point> point_;                                 // by owners
  std::vector<std::uint32_t> first_;                         // of each particle's points, and the end
  std::vector<Vec<Dim>> force_;                              // [N]
};

extern template class BackgroundCells<2>;
extern template class BackgroundCells<3>;

}  // namespace sluice::fluid
