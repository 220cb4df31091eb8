#include "rigid/overlap.hpp"

#include "rigid/bullet_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice::rigid {
namespace {

using Axes = std::vector<Eigen::Vector3d>;

Eigen::Vector3d in_plane(const Eigen::Vector2d& v) {
  return {v.x(), v.y(), 0};
}

Eigen::Vector3d half_size(const Box& box, int dimension) {
  return dimension == 2 ? in_plane(box.half_size.head<2>()) : box.half_size;
}

// Normals of the shape's faces (edges in two dimensions), world frame.
Axes face_normals(const Shape& shape, const Pose& pose, int dimension) {
  Axes normals;
  if (std::holds_alternative<Box>(shape)) {
    for (int axis = 0; axis < dimension; ++axis)
      normals.push_back(pose.orientation * Eigen::Vector3d::Unit(axis));
  } else if (const auto* polygon = std::get_if<Polygon>(&shape)) {
    const auto& v = polygon->vertices;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Eigen::Vector2d edge = (v[(i + 1) % v.size()] - v[i]).normalized();
      normals.push_back(pose.orientation * Eigen::Vector3d(edge.y(), -edge.x(), 0));
    }
  }
  return normals;
}

Eigen::Vector3d nearest_on_segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& x) {
  const Eigen::Vector3d edge = b - a;
  return a + std::clamp((x - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0) * edge;
}

// The point of the shape's surface (or inside) nearest to x, in the shape's frame. Of a ball, its centre.
Eigen::Vector3d nearest_point(const Ball&, const Eigen::Vector3d&, int) {
  return Eigen::Vector3d::Zero();
}
Eigen::Vector3d nearest_point(const Box& box, const Eigen::Vector3d& x, int dimension) {
  const Eigen::Vector3d half = half_size(box, dimension);
  return x.cwiseMax(-half).cwiseMin(half);
}
Eigen::Vector3d nearest_point(const Polygon& polygon, const Eigen::Vector3d& x, int) {
  const auto& v = polygon.vertices;
  Eigen::Vector3d nearest = in_plane(v.front());
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Eigen::Vector3d point = nearest_on_segment(in_plane(v[i]), in_plane(v[(i + 1) % v.size()]), x);
    if ((point - x).norm() < (nearest - x).norm()) nearest = point;
  }
  return nearest;
}

// Of the others the library is asked (bullet_overlap.hpp).
template <typename Other>
Eigen::Vector3d nearest_point(const Other&, const Eigen::Vector3d&, int) {
  return Eigen::Vector3d::Zero();
}

// The only axes that can separate a ball from a convex shape, besides that shape's face normals.
Axes ball_axis(const Pose& ball, const Shape& other, const Pose& pose, int dimension) {
  const Eigen::Vector3d local = pose.orientation.conjugate() * (ball.position - pose.position);
  const Eigen::Vector3d nearest =
      std::visit([&](const auto& s) { return nearest_point(s, local, dimension); }, other);
  const Eigen::Vector3d axis = pose.orientation * (local - nearest);
  if (axis.norm() > 0) return {axis.normalized()};
  if (std::holds_alternative<Ball>(other)) return {Eigen::Vector3d::UnitX()};
  return {};
}

Axes edge_crosses(const Axes& a, const Axes& b) {
  Axes axes;
  for (const auto& u : a)
    for (const auto& v : b) {
      const Eigen::Vector3d axis = u.cross(v);
      if (axis.norm() > 1e-9) axes.push_back(axis.normalized());
    }
  return axes;
}

void append(Axes& axes, const Axes& more) {
  axes.insert(axes.end(), more.begin(), more.end());
}

Interval joined(const Interval& a, const Interval& b) {
  return {std::min(a.min, b.min), std::max(a.max, b.max)};
}

constexpr Interval kNothing{std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};

// Half the width of the shape in a direction of its own frame, of shapes that are as far to either side.
double half_width(const Box& box, const Eigen::Vector3d& local, int dimension) {
  return half_size(box, dimension).dot(local.cwiseAbs());
}
double half_width(const Ball& ball, const Eigen::Vector3d&, int) {
  return ball.radius;
}
double half_width(const Cylinder& cylinder, const Eigen::Vector3d& local, int) {
  const double along = std::abs(local[cylinder.axis]);
  return cylinder.half_length * along + cylinder.radius * std::sqrt(std::max(0.0, 1 - along * along));
}

template <typename Symmetric>
Interval extent_of(const Symmetric& shape, const Eigen::Vector3d& local, int dimension) {
  const double half = half_width(shape, local, dimension);
  return {-half, half};
}
Interval extent_of(const Polygon& polygon, const Eigen::Vector3d& local, int) {
  Interval range = kNothing;
  for (const auto& vertex : polygon.vertices) {
    const double at = local.head<2>().dot(vertex);
    range = joined(range, {at, at});
  }
  return range;
}
Interval extent_of(const Mesh& mesh, const Eigen::Vector3d& local, int) {
  Interval range = kNothing;
  for (const auto& vertex : mesh.vertices) {
    const double at = local.dot(vertex);
    range = joined(range, {at, at});
  }
  return range;
}
Interval extent_of(const Compound& compound, const Eigen::Vector3d& local, int dimension) {
  Interval range = kNothing;
  for (const Placed& part : compound.parts)
    range = joined(range, extent(part.shape, part.pose, local, dimension));
  return range;
}

// Separating axes are known of shapes with few faces and of balls.
bool has_axes(const Shape& shape) {
  return !std::holds_alternative<Cylinder>(shape) && !std::holds_alternative<Mesh>(shape);
}

double by_axes(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, int dimension) {
  const Axes normals_a = face_normals(a, pose_a, dimension), normals_b = face_normals(b, pose_b, dimension);
  Axes axes = normals_a;
  append(axes, normals_b);
  if (dimension == 3) append(axes, edge_crosses(normals_a, normals_b));
  if (std::holds_alternative<Ball>(a)) append(axes, ball_axis(pose_a, b, pose_b, dimension));
  if (std::holds_alternative<Ball>(b)) append(axes, ball_axis(pose_b, a, pose_a, dimension));

  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& axis : axes) {
    const Interval on_a = extent(a, pose_a, axis, dimension), on_b = extent(b, pose_b, axis, dimension);
    smallest = std::min(smallest, std::min(on_a.max - on_b.min, on_b.max - on_a.min));
  }
  return smallest;
}

// Along the world's axes alone: an upper bound of the penetration.
double by_bounds(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, int dimension) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < dimension; ++axis) {
    const Eigen::Vector3d direction = Eigen::Vector3d::Unit(axis);
    const Interval on_a = extent(a, pose_a, direction, dimension),
                   on_b = extent(b, pose_b, direction, dimension);
    smallest = std::min(smallest, std::min(on_a.max - on_b.min, on_b.max - on_a.min));
  }
  return smallest;
}

}  // namespace

Interval extent(const Shape& shape, const Pose& pose, const Eigen::Vector3d& direction, int dimension) {
  const double center = pose.position.dot(direction);
  const Eigen::Vector3d local = pose.orientation.conjugate() * direction;
  const Interval own = std::visit([&](const auto& s) { return extent_of(s, local, dimension); }, shape);
  return {center + own.min, center + own.max};
}

double penetration(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, int dimension) {
  if (const auto* compound = std::get_if<Compound>(&a)) {
    double deepest = -std::numeric_limits<double>::infinity();
    for (const Placed& part : compound->parts)
      deepest = std::max(deepest, penetration(part.shape, in_world(pose_a, part.pose), b, pose_b, dimension));
    return deepest;
  }
  if (std::holds_alternative<Compound>(b)) return penetration(b, pose_b, a, pose_a, dimension);
  if (has_axes(a) && has_axes(b)) return by_axes(a, pose_a, b, pose_b, dimension);
  const double bound = by_bounds(a, pose_a, b, pose_b, dimension);
  return bound <= 0 ? bound : bullet_penetration({a, pose_a}, {b, pose_b});
}

}  // namespace sluice::rigid
