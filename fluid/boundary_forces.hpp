#pragma once

#include <vector>

#include "fluid/boundary.hpp"
#include "fluid/force_sweep.hpp"
#include "fluid/kernel.hpp"
#include "fluid/neighbor_search.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"
#include "fluid/setup.hpp"

namespace sluice::fluid {

// Boundary forces: walls and bodies are one layer of particles k on their surface, dx/3 apart, with normals
// n_k. Fluid particles j nearer than r0 = 0.7 h to any of them are pushed by, CF (95) and (111)-(113),
//   F_j = sum_k f1 f2,   f2 = A/r ((r0/r)^4 - (r0/r)^2) n_k,   r = |x_j - x_k|,
//   f1 = 1 where (v-hat_j - v_k).n_k < 0, else 0,
// and the fluid's shape functions hand that on, CF (94) and (98):  f_i = sum_j F_j N_i(x_j).
// Nothing else of the boundary is seen: the fit at a wall is that of a free surface, whose missing stress
// these forces replace.
//
// - A is left open by the paper. Here it follows from a pressure p: the forces of a plane surface on a
//   particle half a spacing from it, as on the lattice, are p dx^(Dim-1). p is by default the stagnation
//   pressure of the fastest flow, rho0/2 (c0/10)^2, since c0 is ten times the largest speed; where gravity
//   makes the flow that is the pressure at the floor, rho0 g H. With rho0 c0^2 the first row would meet 200
//   times the pressure that it stands under, and be shot off.
// - v-hat is of the velocities with all other accelerations of the step, as in the paper's list of stages, so
//   that the power of a wall at rest, F_j.v-hat_j, is never positive but for the error of the step.
// - The weight of a particle stays its own, as everywhere in this solver, while CF (98) hands it on too: with
//   masses CF (58) a falling drop would be sheared, the row at its surface having 1.24 of its weight.
// - sum_i N_i = 1, so the reaction on k is -sum_j F_jk to round-off. What a floored fit (spray) leaves of
//   sum_i x_i N_i(x_j) - x_j is taken over into its moment.
// f2 is held below r0/6 (boundary_forces.cpp). A tank at rest fails (README.md, "Boundary forces").
// Cost: a fit at every particle near the boundary and a pass over all pairs, twice the time of a step by
// default. The particles have no volume and go through the sweeps like any boundary, with no effect.
template <int Dim>
class BoundaryForces {
 public:
  explicit BoundaryForces(const Setup& setup);

  [[nodiscard]] bool is_used() const { return strength_ > 0.0; }

  // Length of the step at whose end the forces are [s]; 0 at the start.
  void begin_step(double dt) { dt_ = dt; }
  // Adds their accelerations to all others.
  void accelerate(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                  const Parallel& parallel, Particles<Dim>& fluid);
  // Adds their reactions on the boundary particles.
  void react(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
             const Parallel& parallel, const Particles<Dim>& fluid,
             std::vector<Reaction<Dim>>& reaction) const;

 private:
  // Of a fluid particle j near the boundary: its shape functions N_i(x_j) = V_i W (a + g.x_ij), and what
  // they make of velocities and places.
  struct Pushed {
    bool is_near = false;
    double a = 0;
    Vec<Dim> g = Vec<Dim>::Zero();
    Vec<Dim> velocity = Vec<Dim>::Zero();  // v-hat_j [m/s]
    Vec<Dim> offset = Vec<Dim>::Zero();    // sum_i x_i N_i(x_j) - x_j [m]
    Vec<Dim> force = Vec<Dim>::Zero();     // F_j [N]
  };

  [[nodiscard]] static Vec<Dim> place(const BoundaryParticles<Dim>& boundary, std::size_t k);
  [[nodiscard]] double magnitude(double r2) const;
  [[nodiscard]] Vec<Dim> force(const Vec<Dim>& x_j, const Pushed& j, const BoundaryParticles<Dim>& boundary,
                               std::size_t k) const;
  [[nodiscard]] bool is_near(const Vec<Dim>& x, std::span<const std::uint32_t> near,
                             const BoundaryParticles<Dim>& boundary) const;
  [[nodiscard]] Pushed pushed(const NeighborSearch<Dim>& search, const BoundaryParticles<Dim>& boundary,
                              const Particles<Dim>& fluid, std::size_t j) const;
  [[nodiscard]] Vec<Dim> handed_on(const NeighborSearch<Dim>& search, const Particles<Dim>& fluid,
                                   std::size_t i) const;

  WendlandC2<Dim> kernel_;
  double floor_ = 0;     // of the fit's moments [m^2]
  double range_;         // r0 [m]
  double strength_ = 0;  // A [J]; 0: not used
  bool on_receding_;     // without f1
  double dt_ = 0;        // [s]
  // Of the present step, by fluid particles and images:
  std::vector<Vec<Dim>> predicted_;  // velocity with all other accelerations of the step [m/s]
  std::vector<Pushed> pushed_;
};

extern template class BoundaryForces<2>;
extern template class BoundaryForces<3>;

}  // namespace sluice::fluid
