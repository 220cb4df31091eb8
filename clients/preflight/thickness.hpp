#pragma once

#include "scene.pb.h"

namespace sluice::clients {

// Whether the solver keeps the sides of the body apart where it is thin: of boxes and of convex polygons.
bool has_plate_rule(const Body& body);

// The least thickness [m]: how far it is through the body from a place of its surface, straight inward; of
// convex shapes the smallest width, of a compound that of its thinnest part.
double least_thickness(const Body& body, int dimension);

}  // namespace sluice::clients
