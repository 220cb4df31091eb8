#pragma once

#include "scene.pb.h"

namespace sluice::clients {

// The least thickness [m]: how far it is through the body from a place of its surface, straight inward; of
// convex shapes the smallest width, of a compound that of its thinnest part.
double least_thickness(const Body& body, int dimension);

// The same of what the solver does not keep the sides apart of where it is thin: all but boxes and convex
// polygons. Infinite where there is nothing else.
double least_without_plate_rule(const Body& body, int dimension);

}  // namespace sluice::clients
