#pragma once

#include "fluid/sampling.hpp"

namespace sluice::fluid {

// The parts of sample_body: layers inward from the surface of one kind of shape, in the shape's frame. Depths
// are (l + 1/2) dx of layer l.

// Whether it is thinner than two supports, and a box or a convex polygon.
bool needs_plate_rule(const Shape& shape, double support, int dimension);
// By the thin-plate rule, on its own.
Boundary sample_plate(const Shape& shape, double spacing, double support, int dimension);
// Without the rule; compounds use it where they need it.
Boundary sample_thick(const Shape& shape, double spacing, double support, int dimension);

// A polygon that is not convex: every edge has layers, a corner that points inward has arcs between those of
// its edges. A point that is nearer to another edge than to its own is left out.
Boundary sample_outline(const PolygonShape& polygon, double spacing, int layers);

// Rings about the axis, slice by slice; the slices near the ends go on to the axis.
Boundary sample_cylinder(const CylinderShape& cylinder, double spacing, int layers);

// Points spread evenly over the surfaces of equal depth of a mesh: as many as the layer's volume holds,
// pushed apart along it.
Boundary sample_mesh(const MeshShape& mesh, double spacing, int layers);

// Every part's own layers, without those inside another part that is thick. Where the nearest surface of a
// thick part's own particle is one that another part covers, the nearest that is not takes its place. Parts
// that need the thin-plate rule are plates (plate_sampling.hpp).
Boundary sample_compound(const CompoundShape& compound, double spacing, double support, int dimension);

// In the frame in which the part is placed.
Boundary placed(Boundary boundary, const PlacedShape& place);

}  // namespace sluice::fluid
