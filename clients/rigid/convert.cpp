#include "clients/rigid/convert.hpp"

#include <fmt/format.h>

namespace sluice::clients {
namespace {

// An angular velocity: about z in two dimensions, where it has one entry.
Eigen::Vector3d to_turn(const google::protobuf::RepeatedField<double>& entries, int dimension) {
  if (dimension == 3) return to_vector(entries);
  return {0, 0, entries.empty() ? 0 : entries[0]};
}

rigid::Polygon to_polygon(const Polygon& polygon) {
  std::vector<Eigen::Vector2d> vertices;
  for (const Point& vertex : polygon.vertex()) vertices.emplace_back(vertex.x(), vertex.y());
  return rigid::centred_polygon(std::move(vertices));
}

std::vector<rigid::Key> to_keys(const Keyframes& keyframes) {
  std::vector<rigid::Key> keys;
  for (const Keyframe& key : keyframes.key())
    keys.push_back({key.time(), to_vector(key.offset()), key.angle()});
  return keys;
}

rigid::MotionPtr make_motion(const Motion& motion, int dimension) {
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
    case Motion::KIND_NOT_SET:
      break;
  }
  throw rigid::MotionError("", "the motion has no kind; give constant, keyframes or expression");
}

std::string kind_name(const Motion& motion) {
  const auto* field = motion.GetDescriptor()->FindFieldByNumber(motion.kind_case());
  return field == nullptr ? "" : field->name();
}

double mass_of(const Body& body, const rigid::Shape& shape, int dimension) {
  return body.has_mass() ? body.mass() : body.density() * rigid::solid(shape, dimension).volume;
}

rigid::BodySpec to_body(const Body& body, int dimension) {
  rigid::BodySpec spec;
  spec.name = body.name();
  spec.shape = to_shape(body);
  spec.pose = initial_pose(body, dimension);
  spec.mass = mass_of(body, spec.shape, dimension);
  spec.velocity = to_vector(body.velocity());
  spec.angular_velocity = to_turn(body.angular_velocity(), dimension);
  if (body.has_prescribed()) spec.motion = to_motion(body.prescribed(), dimension);
  return spec;
}

}  // namespace

Eigen::Vector3d to_vector(const google::protobuf::RepeatedField<double>& entries) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int i = 0; i < std::min(entries.size(), 3); ++i) vector[i] = entries[i];
  return vector;
}

rigid::Shape to_shape(const Body& body) {
  switch (body.shape_case()) {
    case Body::kBox:
      return rigid::Box{to_vector(body.box().size()) / 2};
    case Body::kBall:
      return rigid::Ball{body.ball().radius()};
    case Body::kPolygon:
      return to_polygon(body.polygon());
    case Body::SHAPE_NOT_SET:
      break;
  }
  throw std::invalid_argument("the body has no shape; give box, ball or polygon");
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

rigid::MotionPtr to_motion(const Motion& motion, int dimension) {
  try {
    return make_motion(motion, dimension);
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
  for (const Body& body : scene.body()) {
    try {
      spec.bodies.push_back(to_body(body, spec.dimension));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("body '{}': {}", body.name(), error.what()));
    }
  }
  return spec;
}

}  // namespace sluice::clients
