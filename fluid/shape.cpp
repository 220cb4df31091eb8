#include "fluid/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice::fluid {

namespace {

double distance_to(const BoxShape& box, const Eigen::Vector3d& x, int dimension) {
  const Eigen::VectorXd q = (x.cwiseAbs() - box.half_size).head(dimension);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

double distance_to(const BallShape& ball, const Eigen::Vector3d& x, int dimension) {
  return x.head(dimension).norm() - ball.radius;
}

Eigen::Vector2d outward_normal(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()).normalized();
}

double distance_to_segment(const Eigen::Vector2d& x, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (x - (a + t * (b - a))).norm();
}

// Whether a ray from p along +x leaves through the edge a-b: an odd number of edges means inside.
bool ray_crosses(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  return p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

double distance_to(const PolygonShape& polygon, const Eigen::Vector3d& x, int) {
  const Eigen::Vector2d p = x.head<2>();
  bool inside = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.vertices.size(); ++k) {
    const Eigen::Vector2d& a = polygon.vertices[k];
    const Eigen::Vector2d& b = polygon.vertices[(k + 1) % polygon.vertices.size()];
    inside = inside != ray_crosses(p, a, b);
    nearest = std::min(nearest, distance_to_segment(p, a, b));
  }
  return inside ? -nearest : nearest;
}

double distance_to(const CylinderShape& cylinder, const Eigen::Vector3d& x, int) {
  const double along = x[cylinder.axis], across = std::sqrt(std::max(0.0, x.squaredNorm() - along * along));
  const Eigen::Vector2d q(across - cylinder.radius, std::abs(along) - cylinder.half_length);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

double distance_to(const MeshShape& mesh, const Eigen::Vector3d& x, int) {
  return mesh.surface->nearest(x).signed_distance;
}

double distance_to(const CompoundShape& compound, const Eigen::Vector3d& x, int dimension) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const PlacedShape& part : compound.parts)
    nearest = std::min(nearest, signed_distance(part.shape, part.to_local(x), dimension));
  return nearest;
}

double thickness_of(const BoxShape& box, int dimension) {
  return 2.0 * box.half_size.head(dimension).minCoeff();
}
double thickness_of(const BallShape& ball, int) {
  return 2.0 * ball.radius;
}

// The smallest width of a convex polygon is attained perpendicular to one of its edges.
double thickness_of(const PolygonShape& polygon, int) {
  if (!is_convex(polygon)) return std::numeric_limits<double>::infinity();
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.vertices.size(); ++k) {
    const Eigen::Vector2d& a = polygon.vertices[k];
    const Eigen::Vector2d normal = outward_normal(a, polygon.vertices[(k + 1) % polygon.vertices.size()]);
    double width = 0;
    for (const Eigen::Vector2d& v : polygon.vertices) width = std::max(width, -normal.dot(v - a));
    smallest = std::min(smallest, width);
  }
  return smallest;
}

template <typename Other>
double thickness_of(const Other&, int) {
  return std::numeric_limits<double>::infinity();
}

double volume_of(const BoxShape& box, int dimension) {
  return (2.0 * box.half_size).head(dimension).prod();
}
double volume_of(const BallShape& ball, int dimension) {
  const double disc = M_PI * ball.radius * ball.radius;
  return dimension == 2 ? disc : 4.0 / 3.0 * disc * ball.radius;
}
double volume_of(const PolygonShape& polygon, int) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.vertices.size(); ++k) {
    const Eigen::Vector2d& a = polygon.vertices[k];
    const Eigen::Vector2d& b = polygon.vertices[(k + 1) % polygon.vertices.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double volume_of(const CylinderShape& cylinder, int) {
  return M_PI * cylinder.radius * cylinder.radius * 2 * cylinder.half_length;
}
double volume_of(const MeshShape& mesh, int) {
  return mesh.surface->volume();
}
double volume_of(const CompoundShape& compound, int dimension) {
  double sum = 0;
  for (const PlacedShape& part : compound.parts) sum += volume(part.shape, dimension);
  return sum;
}

Bounds bounds_of(const BoxShape& box, int) {
  return {-box.half_size, box.half_size};
}
Bounds bounds_of(const BallShape& ball, int) {
  return {Eigen::Vector3d::Constant(-ball.radius), Eigen::Vector3d::Constant(ball.radius)};
}
Bounds bounds_of(const PolygonShape& polygon, int) {
  Bounds b{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  b.min.head<2>() = b.max.head<2>() = polygon.vertices.front();
  for (const Eigen::Vector2d& v : polygon.vertices) {
    b.min.head<2>() = b.min.head<2>().cwiseMin(v);
    b.max.head<2>() = b.max.head<2>().cwiseMax(v);
  }
  return b;
}

Bounds bounds_of(const CylinderShape& cylinder, int) {
  Eigen::Vector3d half = Eigen::Vector3d::Constant(cylinder.radius);
  half[cylinder.axis] = cylinder.half_length;
  return {-half, half};
}
Bounds bounds_of(const MeshShape& mesh, int) {
  Bounds b{mesh.surface->vertices().front(), mesh.surface->vertices().front()};
  for (const Eigen::Vector3d& v : mesh.surface->vertices()) b = {b.min.cwiseMin(v), b.max.cwiseMax(v)};
  return b;
}
// Of the parts' own boxes, turned: not the smallest.
Bounds bounds_of(const CompoundShape& compound, int dimension) {
  Eigen::AlignedBox3d whole;
  for (const PlacedShape& part : compound.parts) {
    const Bounds own = bounds(part.shape, dimension);
    for (int corner = 0; corner < 8; ++corner) {
      Eigen::Vector3d x = own.min;
      for (int a = 0; a < 3; ++a)
        if ((corner >> a) % 2 == 1) x[a] = own.max[a];
      whole.extend(part.position + part.orientation * x);
    }
  }
  return {whole.min(), whole.max()};
}

}  // namespace

bool is_convex(const PolygonShape& polygon) {
  const auto& v = polygon.vertices;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Eigen::Vector2d in = v[k] - v[(k + v.size() - 1) % v.size()], out = v[(k + 1) % v.size()] - v[k];
    if (in.x() * out.y() - in.y() * out.x() < -1e-12 * in.norm() * out.norm()) return false;
  }
  return true;
}

double signed_distance(const Shape& shape, const Eigen::Vector3d& x, int dimension) {
  return std::visit([&](const auto& s) { return distance_to(s, x, dimension); }, shape);
}

Bounds bounds(const Shape& shape, int dimension) {
  Bounds b = std::visit([&](const auto& s) { return bounds_of(s, dimension); }, shape);
  if (dimension == 2) b.min.z() = b.max.z() = 0.0;
  return b;
}

double volume(const Shape& shape, int dimension) {
  return std::visit([&](const auto& s) { return volume_of(s, dimension); }, shape);
}

double thickness(const Shape& shape, int dimension) {
  return std::visit([&](const auto& s) { return thickness_of(s, dimension); }, shape);
}

}  // namespace sluice::fluid
