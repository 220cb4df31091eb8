#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <variant>
#include <vector>

namespace sluice::rigid {

// Shapes about their own origin, which is their centroid but for meshes and compounds. Lengths in m.
struct Box {
  Eigen::Vector3d half_size;  // z is not read in two dimensions
};
struct Ball {  // a disc in two dimensions
  double radius;
};
struct Polygon {  // convex, counter-clockwise, two dimensions only; make it with centred_polygon
  std::vector<Eigen::Vector2d> vertices;
};
struct Cylinder {  // three dimensions only
  double radius, half_length;
  int axis = 2;  // that it is along
};
struct Mesh {  // a closed surface, triangles counter-clockwise from outside; three dimensions only
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool convex = false;
};
struct Placed;
struct Compound {  // parts that may touch
  std::vector<Placed> parts;
};
using Shape = std::variant<Box, Ball, Polygon, Cylinder, Mesh, Compound>;

// Where a shape's origin stands in the world.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

struct Placed {
  Shape shape;
  Pose pose;
};

// Where a part stands in the world whose pose is given in the frame of a body.
Pose in_world(const Pose& body, const Pose& part);

// Rotation by |r| [rad] about r.
Eigen::Quaterniond rotation(const Eigen::Vector3d& r);

// The vertices moved so that their centroid is the origin. Throws std::invalid_argument naming the vertex
// unless they bound a convex polygon counter-clockwise; collinear vertices are allowed.
Polygon centred_polygon(std::vector<Eigen::Vector2d> vertices);

// Of shapes that are neither mesh nor compound. A homogeneous body of density 1: volume [m^3] and principal
// moments of inertia about the centroid [m^5]. In two dimensions per metre of depth, area [m^2] and (0, 0,
// I_zz) [m^4].
struct Solid {
  double volume;
  Eigen::Vector3d inertia;
};
Solid solid(const Shape& shape, int dimension);

// Distance of the farthest point from the centroid [m].
double bounding_radius(const Shape& shape, int dimension);

// Area of the surface [m^2], length of the outline in two dimensions [m]; parts of a compound one by one.
double surface(const Shape& shape, int dimension);

// Smallest width over all directions [m]; of a compound that of its narrowest part but polygons, of a
// mesh along the axes.
double thickness(const Shape& shape, int dimension);

}  // namespace sluice::rigid
