#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <variant>
#include <vector>

#include "fluid/triangle_surface.hpp"

namespace sluice::fluid {

// Shapes about their own origin. Lengths in m.
struct BoxShape {
  Eigen::Vector3d half_size;  // z is not read in two dimensions
};
struct BallShape {  // a disc in two dimensions
  double radius;
};
struct PolygonShape {  // simple and counter-clockwise; two dimensions
  std::vector<Eigen::Vector2d> vertices;
};
struct CylinderShape {  // three dimensions
  double radius, half_length;
  int axis;
};
struct MeshShape {  // three dimensions
  std::shared_ptr<const TriangleSurface> surface;
};
struct PlacedShape;
struct CompoundShape {  // parts that touch or are apart
  std::vector<PlacedShape> parts;
};
using Shape = std::variant<BoxShape, BallShape, PolygonShape, CylinderShape, MeshShape, CompoundShape>;

struct PlacedShape {
  Shape shape;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               // of its origin [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // from its frame

  [[nodiscard]] Eigen::Vector3d to_local(const Eigen::Vector3d& x) const {
    return orientation.conjugate() * (x - position);
  }
};

// No corner turns to the right.
bool is_convex(const PolygonShape& polygon);

// Distance [m] of x from the shape's surface, negative inside; inside a compound, of the part's surface.
double signed_distance(const Shape& shape, const Eigen::Vector3d& x, int dimension);

// Half the size of the axis-parallel bounding box [m], and its centre.
struct Bounds {
  Eigen::Vector3d min, max;
};
Bounds bounds(const Shape& shape, int dimension);

// Volume [m^3], area [m^2] in two dimensions.
double volume(const Shape& shape, int dimension);

// Smallest width of the shape over all directions [m]; infinite of shapes that the thin-plate rule does not
// know: not convex, round, or of several parts.
double thickness(const Shape& shape, int dimension);

}  // namespace sluice::fluid
