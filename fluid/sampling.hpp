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

// The sides of a tank, the box min..max. Of axis a they are number 2 a (lower) and 2 a + 1 (upper).
struct Tank {
  Eigen::Vector3d min, max;  // [m]
  std::array<bool, 6> closed{true, true, true, true, true, true};
  std::array<bool, 3> periodic{false, false, false};  // then neither side of the axis is a wall
  std::array<bool, 6> mirrored{};  // these sides have no layers: the fluid sees its image there
  std::array<Eigen::Vector3d, 6> velocity = zeros();  // of a wall along itself, a conveyor belt [m/s]
  bool no_slip = false;
  std::vector<Opening> openings = {};  // where there is no wall; the other walls go on beyond

  static std::array<Eigen::Vector3d, 6> zeros();
};

// Wall layers outside the tank, `support` [m] deep; they go on beyond periodic and mirrored sides.
Boundary sample_walls(const Tank& tank, double spacing, double support, int dimension);

// For boundary forces (boundary_forces.hpp): particles half their edge behind the surface, whose nearest
// points of the surface are as far apart as CF section 6 has it. In an edge of the tank there is none.
double surface_spacing(double spacing);
// Walls go on `beyond` [m] past periodic sides.
Boundary sample_wall_surface(const Tank& tank, double spacing, double beyond, int dimension);
Boundary sample_body_surface(const Shape& shape, double spacing, int dimension);

// Layers inward from the shape's surface, `support` [m] deep, in the body's frame. A shape thinner than two
// supports gets layers of its own for every face (thin-plate rule) if it is a box or a convex polygon.
Boundary sample_body(const Shape& shape, double spacing, double support, int dimension);

}  // namespace sluice::fluid
