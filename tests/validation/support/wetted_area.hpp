#pragma once

#include <span>

namespace sluice::validation {

// Area [m^2] that the free surface encloses in the plane: where the sum of V W over the particles is above
// 1/2, by the cells of a raster a quarter of a spacing wide. On a straight surface of a lattice the sum is
// 1/2 where the lattice's cells end. `position` has three entries a particle [m], `volume` one [m^2].
double wetted_area(std::span<const double> position, std::span<const double> volume, double spacing);

}  // namespace sluice::validation
