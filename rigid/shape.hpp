#pragma once

#include <Eigen/Geometry>
#include <variant>
#include <vector>

namespace sluice::rigid {

// Shapes about their own origin, which is their centroid. Lengths in m.
struct Box {
  Eigen::Vector3d half_size;  // z is not read in two dimensions
};
struct Ball {  // a disc in two dimensions
  double radius;
};
struct Polygon {  // convex, counter-clockwise, two dimensions only; make it with centred_polygon
  std::vector<Eigen::Vector2d> vertices;
};
using Shape = std::variant<Box, Ball, Polygon>;

// Where a shape stands in the world.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // of the centroid [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

// Rotation by |r| [rad] about r.
Eigen::Quaterniond rotation(const Eigen::Vector3d& r);

// The vertices moved so that their centroid is the origin. Throws std::invalid_argument naming the vertex
// unless they bound a convex polygon counter-clockwise; collinear vertices are allowed.
Polygon centred_polygon(std::vector<Eigen::Vector2d> vertices);

// A homogeneous body of density 1: volume [m^3] and principal moments of inertia about the centroid [m^5].
// In two dimensions per metre of depth, area [m^2] and (0, 0, I_zz) [m^4].
struct Solid {
  double volume;
  Eigen::Vector3d inertia;
};
Solid solid(const Shape& shape, int dimension);

// Distance of the farthest point from the centroid [m].
double bounding_radius(const Shape& shape, int dimension);

// Smallest width over all directions [m].
double thickness(const Shape& shape, int dimension);

}  // namespace sluice::rigid
