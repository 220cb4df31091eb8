#pragma once

#include <tuple>
#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/force_sweep.hpp"
#include "fluid/neighbor_search.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"
#include "fluid/setup.hpp"

namespace sluice::fluid {

// Tension of the free surface as an energy of the particles' places and volumes (README.md, "Surface
// tension"):
//   E = sum_i V_i B/2 (1 - c_i)^2,   c_i = sum_k V_k K(x_ik) over fluid, i itself and boundary.
// c, the cover, is 1 within the liquid and at walls, and less where liquid is missing. On particle i act
//   f_i = -dE/dx_i = sum_k V_i V_k (e'_i + e'_k) F x_ik,   e' = -B (1 - c),   F = -K'(r)/r,
// with e' = 0 at boundary particles, and -dE/dV_i as a pressure in the Galerkin force, since a volume follows
// from the divergence. Linear and angular momentum close to round-off. Cost: two sweeps.
template <int Dim>
class SurfaceTension {
 public:
  // `reach` is the radius of K [m], that of the neighbour lists.
  SurfaceTension(const Setup& setup, double reach);

  [[nodiscard]] bool is_used() const { return stiffness_ > 0.0; }

  // E and the forces at the present places and volumes; -dE/dV goes into the sources of sweep 2.
  void compute(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
               const Parallel& parallel, Particles<Dim>& fluid);
  // Adds the forces f.
  void accelerate(const Parallel& parallel, Particles<Dim>& fluid) const;
  // Adds their reactions on the boundary particles.
  void react(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
             const Parallel& parallel, const Particles<Dim>& fluid,
             std::vector<Reaction<Dim>>& reaction) const;

  [[nodiscard]] double energy() const { return energy_; }  // E [J]
  // [s]; infinite without tension.
  [[nodiscard]] double largest_step() const { return largest_step_; }

  auto state() { return std::tie(energy_); }

 private:
  // K = K(0) (1 - r^2/reach^2)^2 [1/m^Dim], and F [1/m^(Dim+2)].
  struct Weight {
    double value, slope;
  };
  [[nodiscard]] Weight weight(double r2) const;
  [[nodiscard]] double cover(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                             const Particles<Dim>& fluid, std::size_t i) const;
  void differentiate(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                     Particles<Dim>& fluid, std::size_t i);
  [[nodiscard]] double lattice_cover(int rows, double spacing) const;
  [[nodiscard]] double lattice_tension(double spacing) const;

  double reach_, at_zero_ = 1;  // radius of K [m], K(0)
  double stiffness_ = 0;        // B [J/m^Dim]
  double largest_step_, energy_ = 0;
  // Of the present step, by fluid particles:
  std::vector<double> missing_;  // 1 - c, of images too
  std::vector<Vec<Dim>> force_;  // [N]
};

extern template class SurfaceTension<2>;
extern template class SurfaceTension<3>;

}  // namespace sluice::fluid
