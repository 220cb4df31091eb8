#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene.pb.h"
#include "server/geometry.hpp"

namespace sluice::server {

// Where a lattice of liquid is cut by a body's curved or slanted surface, moves the particles near it so that
// they fill the room evenly, boundary particles included: along -grad C, C the sum of V W, as in the shifting
// of S. Lind et al., J. Comput. Phys. 231, 2012 (the packing of A. Colagrossi et al., Comput. Phys. Commun.
// 183, 2012). Beyond the liquid's own surface its lattice is continued for the purpose, so that the surface
// stays. Where a body's faces fit the lattice nothing moves. Returns the way that each particle has to go
// [m].
std::vector<Eigen::Vector3d> packing(const Scene& scene, const Region& region,
                                     const std::vector<Eigen::Vector3d>& particles);

}  // namespace sluice::server
