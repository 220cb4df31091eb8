#include "server/geometry.hpp"

#include <algorithm>
#include <limits>

namespace sluice::server {

namespace {

std::vector<Eigen::Vector2d> vertices(const Polygon& polygon) {
  std::vector<Eigen::Vector2d> result;
  for (const Point& p : polygon.vertex()) result.emplace_back(p.x(), p.y());
  return result;
}

// Centre of a polygon's area.
Eigen::Vector2d centroid(const std::vector<Eigen::Vector2d>& vertex) {
  double twice_area = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  // Relative to the first vertex, which keeps digits for a polygon far from the origin.
  for (std::size_t i = 1; i + 1 < vertex.size(); ++i) {
    const Eigen::Vector2d a = vertex[i] - vertex[0], b = vertex[i + 1] - vertex[0];
    const double cross = a.x() * b.y() - a.y() * b.x();
    twice_area += cross;
    moment += cross * (a + b);
  }
  return vertex[0] + moment / (3 * twice_area);
}

}  // namespace

Eigen::Vector3d to_vector(const google::protobuf::RepeatedField<double>& entries) {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  for (int i = 0; i < std::min(entries.size(), 3); ++i) v[i] = entries[i];
  return v;
}

Region to_region(const FluidRegion& region) {
  switch (region.shape_case()) {
    case FluidRegion::kBall:
      return {fluid::BallShape{region.ball().radius()}, to_vector(region.ball().center())};
    case FluidRegion::kPolygon:
      return {fluid::PolygonShape{vertices(region.polygon())}, Eigen::Vector3d::Zero()};
    default: {
      const Eigen::Vector3d min = to_vector(region.box().min()), max = to_vector(region.box().max());
      return {fluid::BoxShape{(max - min) / 2}, (min + max) / 2};
    }
  }
}

fluid::Shape to_shape(const Body& body) {
  switch (body.shape_case()) {
    case Body::kBall:
      return fluid::BallShape{body.ball().radius()};
    case Body::kPolygon: {
      std::vector<Eigen::Vector2d> vertex = vertices(body.polygon());
      const Eigen::Vector2d center = centroid(vertex);
      for (Eigen::Vector2d& v : vertex) v -= center;
      return fluid::PolygonShape{std::move(vertex)};
    }
    default:
      return fluid::BoxShape{to_vector(body.box().size()) / 2};
  }
}

double mass(const Body& body, int dimension) {
  return body.has_mass() ? body.mass() : body.density() * fluid::volume(to_shape(body), dimension);
}

fluid::Kinematics initial_kinematics(const Body& body, int dimension) {
  fluid::Kinematics k;
  k.position = to_vector(body.position());
  if (dimension == 2) {
    k.orientation = Eigen::AngleAxisd(body.angle(), Eigen::Vector3d::UnitZ());
  } else if (body.orientation_size() == 4) {
    const auto& q = body.orientation();
    k.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  }
  if (body.has_prescribed()) return k;
  k.velocity = to_vector(body.velocity());
  if (dimension == 2 && body.angular_velocity_size() == 1) {
    k.angular_velocity.z() = body.angular_velocity(0);
  } else {
    k.angular_velocity = to_vector(body.angular_velocity());
  }
  return k;
}

double distance(const fluid::Shape& shape, const fluid::Kinematics& pose, const Eigen::Vector3d& x,
                int dimension) {
  return fluid::signed_distance(shape, pose.orientation.conjugate() * (x - pose.position), dimension);
}

double support(const fluid::Shape& shape, const Eigen::Vector3d& direction) {
  if (const auto* box = std::get_if<fluid::BoxShape>(&shape)) return direction.cwiseAbs().dot(box->half_size);
  if (const auto* ball = std::get_if<fluid::BallShape>(&shape)) return direction.norm() * ball->radius;
  double largest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& v : std::get<fluid::PolygonShape>(shape).vertices) {
    largest = std::max(largest, direction.head<2>().dot(v));
  }
  return largest;
}

}  // namespace sluice::server
