#include "clients/rigid/convert.hpp"

#include <fmt/format.h>

#include "clients/rigid/convert_joint.hpp"
#include "protocol/mass_properties.hpp"
#include "rigid/polygon.hpp"
#include "rigid/triangulate.hpp"

namespace sluice::clients {
namespace {

// An angular velocity: about z in two dimensions, where it has one entry.
Eigen::Vector3d to_turn(const google::protobuf::RepeatedField<double>& entries, int dimension) {
  if (dimension == 3) return to_vector(entries);
  return {0, 0, entries.empty() ? 0 : entries[0]};
}

rigid::Vertices vertices_of(const Polygon& polygon) {
  rigid::Vertices vertices;
  for (const Point& vertex : polygon.vertex()) vertices.emplace_back(vertex.x(), vertex.y());
  return vertices;
}

// One convex piece about its centroid.
rigid::Placed placed_piece(rigid::Vertices vertices) {
  const Eigen::Vector2d center = rigid::centroid(vertices);
  return {rigid::centred_polygon(std::move(vertices)), {{center.x(), center.y(), 0}, {1, 0, 0, 0}}};
}

std::vector<rigid::Placed> pieces(const Polygon& polygon) {
  rigid::Vertices outline = vertices_of(polygon);
  if (rigid::is_convex(outline)) return {placed_piece(std::move(outline))};
  std::vector<rigid::Placed> parts;
  for (rigid::Vertices& triangle : rigid::triangulate(std::move(outline)))
    parts.push_back(placed_piece(std::move(triangle)));
  return parts;
}

rigid::Mesh to_mesh(const Mesh& mesh) {
  rigid::Mesh result;
  result.convex = mesh.convex_hull();
  for (int v = 0; v + 2 < mesh.vertex_size(); v += 3)
    result.vertices.emplace_back(mesh.vertex(v), mesh.vertex(v + 1), mesh.vertex(v + 2));
  for (int t = 0; t + 2 < mesh.triangle_size(); t += 3)
    result.triangles.push_back({mesh.triangle(t), mesh.triangle(t + 1), mesh.triangle(t + 2)});
  return result;
}

rigid::Cylinder to_cylinder(const Cylinder& cylinder) {
  const int axis = cylinder.axis() == AXIS_UNSPECIFIED ? 2 : cylinder.axis() - X_AXIS;
  return {cylinder.radius(), cylinder.length() / 2, axis};
}

// A shape in the frame that it is given in.
template <typename WithShape>
std::vector<rigid::Placed> pieces_of(const WithShape& body) {
  if (body.has_box()) return {{rigid::Box{to_vector(body.box().size()) / 2}, {}}};
  if (body.has_ball()) return {{rigid::Ball{body.ball().radius()}, {}}};
  if (body.has_polygon()) return pieces(body.polygon());
  if (body.has_cylinder()) return {{to_cylinder(body.cylinder()), {}}};
  if (body.has_mesh()) return {{to_mesh(body.mesh()), {}}};
  throw std::invalid_argument("the body has no shape; give box, ball, polygon, cylinder, mesh or compound");
}

rigid::Pose pose_of(const Part& part, int dimension) {
  rigid::Pose pose{to_vector(part.position()), Eigen::Quaterniond::Identity()};
  const auto& q = part.orientation();
  if (dimension == 2) pose.orientation = rigid::rotation({0, 0, part.angle()});
  if (q.size() == 4) pose.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  return pose;
}

std::vector<rigid::Placed> pieces_of(const Compound& compound, int dimension) {
  std::vector<rigid::Placed> all;
  for (const Part& part : compound.part())
    for (rigid::Placed& piece : pieces_of(part)) {
      piece.pose = rigid::in_world(pose_of(part, dimension), piece.pose);
      all.push_back(std::move(piece));
    }
  return all;
}

rigid::Contact to_contact(const Contact& contact, const rigid::Contact& otherwise) {
  return {contact.has_friction() ? contact.friction() : otherwise.friction,
          contact.has_restitution() ? contact.restitution() : otherwise.restitution};
}

std::vector<rigid::Key> to_keys(const Keyframes& keyframes) {
  std::vector<rigid::Key> keys;
  for (const Keyframe& key : keyframes.key())
    keys.push_back({key.time(), to_vector(key.offset()), key.angle()});
  return keys;
}

rigid::MotionPtr make_kind(const Motion& motion, int dimension) {
  switch (motion.kind_case()) {
    case Motion::kConstant: {
      const ConstantVelocity& constant = motion.constant();
      return rigid::constant_velocity(to_vector(constant.velocity()),
                                      to_turn(constant.angular_velocity(), dimension), constant.start());
    }
    case Motion::kKeyframes:
      return rigid::keyframe_motion(to_keys(motion.keyframes()));
    case Motion::kExpression: {
      const Expression& formulas = motion.expression();
      return rigid::expression_motion({formulas.x(), formulas.y(), formulas.z(), formulas.angle()});
    }
    case Motion::kSinusoid: {
      const Sinusoid& swing = motion.sinusoid();
      return rigid::sinusoid_motion(
          {to_vector(swing.offset()), swing.angle(), swing.frequency(), swing.start(), swing.build_up()});
    }
    case Motion::kRamp: {
      const Ramp& ramp = motion.ramp();
      return rigid::ramp_motion({to_vector(ramp.offset()), ramp.angle(), ramp.start(), ramp.duration()});
    }
    case Motion::KIND_NOT_SET:
      break;
  }
  throw rigid::MotionError("",
                           "the motion has no kind; give constant, keyframes, expression, sinusoid or ramp");
}

rigid::MotionPtr make_motion(const Motion& motion, const Eigen::Vector3d& position, int dimension) {
  rigid::MotionPtr made = make_kind(motion, dimension);
  if (!motion.axis().empty())
    made = rigid::about_axis(std::move(made), to_vector(motion.axis()).normalized());
  if (motion.pivot().empty()) return made;
  return rigid::about_pivot(std::move(made), position - to_vector(motion.pivot()));
}

std::string kind_name(const Motion& motion) {
  const auto* field = motion.GetDescriptor()->FindFieldByNumber(motion.kind_case());
  return field == nullptr ? "" : field->name();
}

rigid::BodySpec to_body(const Body& body, const rigid::Contact& contact, int dimension) {
  rigid::BodySpec spec;
  spec.name = body.name();
  spec.shape = to_shape(body, dimension);
  spec.pose = initial_pose(body, dimension);
  const protocol::MassProperties properties = protocol::mass_properties(body, dimension);
  spec.mass = properties.mass;
  spec.inertia = properties.inertia;
  spec.contact = to_contact(body.contact(), contact);
  spec.velocity = to_vector(body.velocity());
  spec.angular_velocity = to_turn(body.angular_velocity(), dimension);
  for (const int axis : body.locked()) spec.locked[static_cast<std::size_t>(axis - X_AXIS)] = true;
  for (const int axis : body.locked_rotation())
    spec.locked_rotation[static_cast<std::size_t>(axis - X_AXIS)] = true;
  if (!body.has_prescribed()) return spec;
  spec.motion = to_motion(body, dimension);
  for (const int axis : body.free()) spec.free[static_cast<std::size_t>(axis - X_AXIS)] = true;
  for (const int axis : body.free_rotation())
    spec.free_rotation[static_cast<std::size_t>(axis - X_AXIS)] = true;
  if (body.prescribed().has_release()) spec.release = body.prescribed().release();
  return spec;
}

}  // namespace

Eigen::Vector3d to_vector(const google::protobuf::RepeatedField<double>& entries) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int i = 0; i < std::min(entries.size(), 3); ++i) vector[i] = entries[i];
  return vector;
}

rigid::Shape to_shape(const Body& body, int dimension) {
  std::vector<rigid::Placed> parts =
      body.has_compound() ? pieces_of(body.compound(), dimension) : pieces_of(body);
  const Eigen::Vector3d center = protocol::mass_properties(body, dimension).center;
  const bool moved = !body.center_of_mass().empty() || body.has_mesh() || body.has_compound();
  if (parts.size() == 1 && !moved) return std::move(parts.front().shape);  // about its centroid
  for (rigid::Placed& part : parts) part.pose.position -= center;
  return rigid::Compound{std::move(parts)};
}

rigid::Pose initial_pose(const Body& body, int dimension) {
  rigid::Pose pose;
  pose.position = to_vector(body.position());
  const auto& q = body.orientation();
  if (dimension == 2)
    pose.orientation = rigid::rotation({0, 0, body.angle()});
  else if (q.size() == 4)
    pose.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  return pose;
}

rigid::MotionPtr to_motion(const Body& body, int dimension) {
  const Motion& motion = body.prescribed();
  try {
    return make_motion(motion, to_vector(body.position()), dimension);
  } catch (const rigid::MotionError& error) {
    const std::string kind = kind_name(motion);
    throw rigid::MotionError(error.part().empty() ? kind : kind + "." + error.part(), error.what());
  }
}

rigid::Tank to_tank(const Domain& domain, int dimension) {
  rigid::Tank tank;
  tank.min = to_vector(domain.min());
  tank.max = to_vector(domain.max());
  for (int side = 0; side < 2 * dimension; ++side) tank.closed[side] = true;
  for (const int side : domain.open())
    if (side != SIDE_UNSPECIFIED) tank.closed[side - X_MIN] = false;
  return tank;
}

rigid::WorldSpec to_world(const Scene& scene) {
  rigid::WorldSpec spec;
  spec.dimension = static_cast<int>(scene.dimension());
  spec.gravity = to_vector(scene.gravity());
  spec.tank = to_tank(scene.domain(), spec.dimension);
  spec.contact = to_contact(scene.contact(), {});
  for (const Body& body : scene.body()) {
    try {
      spec.bodies.push_back(to_body(body, spec.contact, spec.dimension));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("body '{}': {}", body.name(), error.what()));
    }
  }
  for (const Joint& joint : scene.joint()) spec.joints.push_back(to_joint(joint, scene));
  return spec;
}

}  // namespace sluice::clients
