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

}  // namespace

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

double thickness(const Shape& shape, int dimension) {
  return std::visit([&](const auto& s) { return thickness_of(s, dimension); }, shape);
}

}  // namespace sluice::rigid
