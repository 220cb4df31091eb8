#include "server/geometry.hpp"

#include <algorithm>
#include <limits>

#include "protocol/body_kind.hpp"
#include "protocol/mass_properties.hpp"

namespace sluice::server {

namespace {

std::vector<Eigen::Vector2d> vertices(const Polygon& polygon) {
  std::vector<Eigen::Vector2d> result;
  for (const Point& p : polygon.vertex()) result.emplace_back(p.x(), p.y());
  return result;
}

fluid::MeshShape to_mesh(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  std::vector<fluid::TriangleSurface::Triangle> triangles;
  for (int v = 0; v + 2 < mesh.vertex_size(); v += 3)
    points.emplace_back(mesh.vertex(v), mesh.vertex(v + 1), mesh.vertex(v + 2));
  for (int t = 0; t + 2 < mesh.triangle_size(); t += 3)
    triangles.push_back({mesh.triangle(t), mesh.triangle(t + 1), mesh.triangle(t + 2)});
  return {std::make_shared<fluid::TriangleSurface>(std::move(points), std::move(triangles))};
}

// In the frame that the shape is given in.
template <typename WithShape>
fluid::Shape simple_shape(const WithShape& body) {
  if (body.has_ball()) return fluid::BallShape{body.ball().radius()};
  if (body.has_polygon()) return fluid::PolygonShape{vertices(body.polygon())};
  if (body.has_cylinder()) {
    const Cylinder& cylinder = body.cylinder();
    const int axis = cylinder.axis() == AXIS_UNSPECIFIED ? 2 : cylinder.axis() - X_AXIS;
    return fluid::CylinderShape{cylinder.radius(), cylinder.length() / 2, axis};
  }
  if (body.has_mesh()) return to_mesh(body.mesh());
  return fluid::BoxShape{to_vector(body.box().size()) / 2};
}

fluid::CompoundShape to_compound(const Compound& compound, int dimension) {
  fluid::CompoundShape result;
  for (const Part& part : compound.part()) {
    fluid::PlacedShape placed{simple_shape(part), to_vector(part.position()), Eigen::Quaterniond::Identity()};
    const auto& q = part.orientation();
    if (dimension == 2) placed.orientation = Eigen::AngleAxisd(part.angle(), Eigen::Vector3d::UnitZ());
    if (q.size() == 4) placed.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    result.parts.push_back(std::move(placed));
  }
  return result;
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

fluid::Shape to_shape(const Body& body, int dimension) {
  const Eigen::Vector3d center = protocol::mass_properties(body, dimension).center;
  if (body.has_compound()) {
    fluid::CompoundShape compound = to_compound(body.compound(), dimension);
    for (fluid::PlacedShape& part : compound.parts) part.position -= center;
    return compound;
  }
  fluid::Shape shape = simple_shape(body);
  if (auto* polygon = std::get_if<fluid::PolygonShape>(&shape)) {
    for (Eigen::Vector2d& vertex : polygon->vertices) vertex -= center.head<2>();
    return shape;
  }
  if (center.isZero(0)) return shape;
  return fluid::CompoundShape{{{std::move(shape), -center, Eigen::Quaterniond::Identity()}}};
}

double mass(const Body& body, int dimension) {
  return protocol::mass_properties(body, dimension).mass;
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
  if (!protocol::starts_free(body)) return k;
  k.velocity = to_vector(body.velocity());
  if (dimension == 2 && body.angular_velocity_size() == 1) {
    k.angular_velocity.z() = body.angular_velocity(0);
  } else {
    k.angular_velocity = to_vector(body.angular_velocity());
  }
  return k;
}

bool is_inside_tank(const Scene& scene, const Eigen::Vector3d& x) {
  const Eigen::Vector3d min = to_vector(scene.domain().min()), max = to_vector(scene.domain().max());
  for (Eigen::Index a = 0; a < static_cast<Eigen::Index>(scene.dimension()); ++a)
    if (!(x[a] > min[a] && x[a] < max[a])) return false;
  return true;
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
