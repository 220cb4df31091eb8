#pragma once

#include <array>

#include "fluid/setup.hpp"
#include "fluid/shape.hpp"

namespace sluice::fluid {

// Lattice of spacing dx whose points stand at half spacings from the lower corner of the shape's bounds
// (moved to `center`), as far as they are inside the shape. Positions [m].
std::vector<Eigen::Vector3d> fill(const Shape& shape, const Eigen::Vector3d& center, double spacing,
                                  int dimension);

// Volume of one lattice particle so that box regions hold exactly their mass [m^3], [m^2] in 2D.
double particle_volume(double spacing, int dimension);

// Layers of boundary particles that fill a support.
int layer_count(double support, double spacing);

// Wall layers outside the box min..max, `support` [m] deep. closed[2 a] and closed[2 a + 1] say whether the
// lower and upper side of axis a has a wall.
Boundary sample_walls(const Eigen::Vector3d& min, const Eigen::Vector3d& max,
                      const std::array<bool, 6>& closed, double spacing, double support, int dimension);

// Layers inward from the shape's surface, `support` [m] deep, in the body's frame. A shape thinner than two
// supports gets layers of its own for every face (thin-plate rule); a ball never does.
Boundary sample_body(const Shape& shape, double spacing, double support, int dimension);

}  // namespace sluice::fluid
