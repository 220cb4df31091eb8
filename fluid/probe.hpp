#pragma once

#include "fluid/solver.hpp"

namespace sluice::fluid {

// What is needed to look into a state between its particles.
struct ProbedFluid {
  const Snapshot& state;
  std::span<const double> particle_mass;  // of every liquid at zero pressure [kg], per metre of depth in 2D
  double smoothing;      // h [m]
  int dimension;
};

// The fluid at x: a moving-least-squares fit of linear functions to the particles in the kernel's support, CF
// (10), of constants where there are too few for that. `wetness` is the share of the support's weight that
// particles hold: about 1 inside, 1/2 at a surface, 0 (and zeros for the rest) without fluid near.
struct PointSample {
  double pressure = 0;                                 // [Pa]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // [m/s]
  double wetness = 0;
};
PointSample sample_point(const ProbedFluid& fluid, const Eigen::Vector3d& x);

// The largest up.x on the line through x along `up` (a unit vector) where the wetness falls through 1/2 [m],
// found to 1e-5 h; not finite without fluid there. Drops smaller than the support do not
// count.
double surface_height(const ProbedFluid& fluid, const Eigen::Vector3d& x, const Eigen::Vector3d& up);

}  // namespace sluice::fluid
