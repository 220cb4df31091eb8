#pragma once

#include <vector>

#include "rigid/polygon.hpp"

namespace sluice::rigid {

// A simple polygon, counter-clockwise, as triangles, by clipping ears (G. H. Meisters, "Polygons have ears",
// Amer. Math. Monthly 82 (1975) 648). Cost n^3.
std::vector<Vertices> triangulate(Vertices vertices);

}  // namespace sluice::rigid
