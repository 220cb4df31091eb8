#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

namespace sluice::fluid {

// Shapes about their own origin, axis-parallel. Lengths in m.
struct BoxShape {
  Eigen::Vector3d half_size;  // z is not read in two dimensions
};
struct BallShape {  // a disc in two dimensions
  double radius;
};
struct PolygonShape {  // simple and counter-clockwise; convex where it is a body's; two dimensions
  std::vector<Eigen::Vector2d> vertices;
};
using Shape = std::variant<BoxShape, BallShape, PolygonShape>;

// Distance [m] of x from the shape's surface, negative inside.
double signed_distance(const Shape& shape, const Eigen::Vector3d& x, int dimension);

// Half the size of the axis-parallel bounding box [m], and its centre.
struct Bounds {
  Eigen::Vector3d min, max;
};
Bounds bounds(const Shape& shape, int dimension);

// Volume [m^3], area [m^2] in two dimensions.
double volume(const Shape& shape, int dimension);

// Smallest width of the shape over all directions [m].
double thickness(const Shape& shape, int dimension);

}  // namespace sluice::fluid
