#include "rigid/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "rigid/polygon.hpp"

namespace sluice::rigid {
namespace {

void check_convex(const Vertices& vertices) {
  const std::size_t n = vertices.size();
  if (n < 3) throw std::invalid_argument("a polygon of " + std::to_string(n) + " vertices; give at least 3");
  double turning = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d in = vertices[i] - vertices[(i + n - 1) % n],
                          out = vertices[(i + 1) % n] - vertices[i];
    if (in.norm() == 0)
      throw std::invalid_argument("vertex " + std::to_string(i) + " repeats the one before it");
    if (cross(in, out) < -1e-12 * in.norm() * out.norm())
      throw std::invalid_argument(
          "vertex " + std::to_string(i) +
          " turns to the right; a body must be convex with vertices counter-clockwise");
    turning += std::atan2(cross(in, out), in.dot(out));
  }
  if (std::abs(turning - 2 * std::numbers::pi) > 1e-6)
    throw std::invalid_argument(
        "the polygon winds around more than once or not at all; give a simple outline");
}

double box_volume(const Eigen::Vector3d& size, int dimension) {
  return dimension == 2 ? size.x() * size.y() : size.prod();
}

Solid solid_of(const Box& box, int dimension) {
  const Eigen::Vector3d size = 2 * box.half_size, squared = size.cwiseAbs2();
  const double volume = box_volume(size, dimension);
  const double I_zz = volume * (squared.x() + squared.y()) / 12;
  if (dimension == 2) return {volume, {0, 0, I_zz}};
  return {volume,
          {volume * (squared.y() + squared.z()) / 12, volume * (squared.x() + squared.z()) / 12, I_zz}};
}

Solid solid_of(const Ball& ball, int dimension) {
  const double r2 = ball.radius * ball.radius;
  if (dimension == 2) {
    const double disc = std::numbers::pi * r2;
    return {disc, {0, 0, disc * r2 / 2}};
  }
  const double sphere = 4.0 / 3.0 * std::numbers::pi * r2 * ball.radius;
  return {sphere, Eigen::Vector3d::Constant(0.4 * sphere * r2)};
}

Solid solid_of(const Polygon& polygon, int) {
  return {area(polygon.vertices), {0, 0, polar_moment(polygon.vertices)}};
}

Solid solid_of(const Cylinder& cylinder, int) {
  const double r2 = cylinder.radius * cylinder.radius, length = 2 * cylinder.half_length;
  const double volume = std::numbers::pi * r2 * length;
  Eigen::Vector3d inertia = Eigen::Vector3d::Constant(volume * (3 * r2 + length * length) / 12);
  inertia[cylinder.axis] = volume * r2 / 2;
  return {volume, inertia};
}
Solid solid_of(const Mesh&, int) {
  throw std::logic_error("the mass of a mesh is given, not found here");
}
Solid solid_of(const Compound&, int) {
  throw std::logic_error("the mass of a compound is given, not found here");
}

double radius_of(const Box& box, int dimension) {
  return dimension == 2 ? box.half_size.head<2>().norm() : box.half_size.norm();
}
double radius_of(const Ball& ball, int) {
  return ball.radius;
}
double radius_of(const Polygon& polygon, int) {
  double radius = 0;
  for (const auto& vertex : polygon.vertices) radius = std::max(radius, vertex.norm());
  return radius;
}

double radius_of(const Cylinder& cylinder, int) {
  return std::hypot(cylinder.radius, cylinder.half_length);
}
double radius_of(const Mesh& mesh, int) {
  double radius = 0;
  for (const auto& vertex : mesh.vertices) radius = std::max(radius, vertex.norm());
  return radius;
}
double radius_of(const Compound& compound, int dimension) {
  double radius = 0;
  for (const Placed& part : compound.parts)
    radius = std::max(radius, part.pose.position.norm() + bounding_radius(part.shape, dimension));
  return radius;
}

double surface_of(const Box& box, int dimension) {
  const Eigen::Vector3d size = 2 * box.half_size;
  if (dimension == 2) return 2 * (size.x() + size.y());
  return 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
}
double surface_of(const Ball& ball, int dimension) {
  return (dimension == 2 ? 2 : 4 * ball.radius) * std::numbers::pi * ball.radius;
}
double surface_of(const Polygon& polygon, int) {
  const Vertices& v = polygon.vertices;
  double length = 0;
  for (std::size_t i = 0; i < v.size(); ++i) length += (v[(i + 1) % v.size()] - v[i]).norm();
  return length;
}
double surface_of(const Cylinder& cylinder, int) {
  return 2 * std::numbers::pi * cylinder.radius * (cylinder.radius + 2 * cylinder.half_length);
}
double surface_of(const Mesh& mesh, int) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& x = mesh.vertices[a];
    area += (mesh.vertices[b] - x).cross(mesh.vertices[c] - x).norm() / 2;
  }
  return area;
}
double surface_of(const Compound& compound, int dimension) {
  double sum = 0;
  for (const Placed& part : compound.parts) sum += surface(part.shape, dimension);
  return sum;
}

double thickness_of(const Box& box, int dimension) {
  return 2 * (dimension == 2 ? box.half_size.head<2>().minCoeff() : box.half_size.minCoeff());
}
double thickness_of(const Ball& ball, int) {
  return 2 * ball.radius;
}
// A convex polygon's smallest width is square to one of its edges.
double thickness_of(const Polygon& polygon, int) {
  const Vertices& v = polygon.vertices;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Eigen::Vector2d edge = (v[(i + 1) % v.size()] - v[i]).normalized();
    double width = 0;
    for (const auto& vertex : v) width = std::max(width, cross(edge, vertex - v[i]));
    smallest = std::min(smallest, width);
  }
  return smallest;
}

double thickness_of(const Cylinder& cylinder, int) {
  return 2 * std::min(cylinder.radius, cylinder.half_length);
}
double thickness_of(const Mesh& mesh, int) {
  Eigen::Vector3d low = mesh.vertices.front(), high = low;
  for (const auto& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return (high - low).minCoeff();
}
double thickness_of(const Compound& compound, int dimension) {
  double least = std::numeric_limits<double>::infinity();
  for (const Placed& part : compound.parts)  // polygons are pieces of an outline that may be wide
    if (!std::holds_alternative<Polygon>(part.shape))
      least = std::min(least, thickness(part.shape, dimension));
  return least;
}

}  // namespace

Pose in_world(const Pose& body, const Pose& part) {
  return {body.position + body.orientation * part.position, body.orientation * part.orientation};
}

Eigen::Quaterniond rotation(const Eigen::Vector3d& r) {
  const double angle = r.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, r / angle));
}

Polygon centred_polygon(std::vector<Eigen::Vector2d> vertices) {
  check_convex(vertices);
  const Eigen::Vector2d center = centroid(vertices);
  for (auto& vertex : vertices) vertex -= center;
  return {std::move(vertices)};
}

Solid solid(const Shape& shape, int dimension) {
  return std::visit([&](const auto& s) { return solid_of(s, dimension); }, shape);
}

double bounding_radius(const Shape& shape, int dimension) {
  return std::visit([&](const auto& s) { return radius_of(s, dimension); }, shape);
}

double surface(const Shape& shape, int dimension) {
  return std::visit([&](const auto& s) { return surface_of(s, dimension); }, shape);
}

double thickness(const Shape& shape, int dimension) {
  return std::visit([&](const auto& s) { return thickness_of(s, dimension); }, shape);
}

}  // namespace sluice::rigid
