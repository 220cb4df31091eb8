#pragma once

#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/free_surface.hpp"
#include "fluid/model.hpp"

namespace sluice::fluid {

// Particle shifting: particles drift from where they crowd to where they are sparse, with the velocity
//   -S h^2 |d| sum_j V_j grad W(x_ij),      |d| the norm of the strain rate,
// (S. Lind, R. Xu, P. Stansby, B. Rogers, J. Comput. Phys. 231, 2012, Fick's law; scaled with the strain
// rate, which tears the arrangement, so that rest and rigid motion have none). Velocity and density are
// carried along with their gradients. Fluid that has a surface particle in its support is not shifted: the
// free surface never moves by it. Costs one more sweep.
template <int Dim>
class Shifting {
 public:
  // `strength` is S; 0 switches it off.
  explicit Shifting(double strength) : strength_(strength) {}

  [[nodiscard]] bool is_used() const { return strength_ > 0.0; }

  // The drift velocities for the next step, from the present arrangement.
  void compute(const Model<Dim>& model, const Particles<Dim>& fluid, const BoundaryParticles<Dim>& boundary,
               const NeighborSearch<Dim>& search, const FreeSurface<Dim>& surface, const Parallel& parallel);
  // Moves the particles by dt [s].
  void apply(double dt, Particles<Dim>& fluid, const Parallel& parallel) const;

 private:
  double strength_;
  std::vector<Vec<Dim>> velocity_;  // [m/s]
};

extern template class Shifting<2>;
extern template class Shifting<3>;

}  // namespace sluice::fluid
