#include "clients/preflight/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "clients/preflight/thickness.hpp"
#include "clients/rigid/convert.hpp"
#include "protocol/mass_properties.hpp"
#include "protocol/scene_check.hpp"
#include "rigid/triangulate.hpp"

namespace sluice::clients {
namespace {

constexpr double kTouching = 1e-3;  // in spacings

Placed placed(rigid::Shape shape, const Eigen::Vector3d& position) {
  return {std::move(shape), {position, {1, 0, 0, 0}}};
}

Placed piece(const rigid::Vertices& convex) {
  const Eigen::Vector2d center = rigid::centroid(convex);
  return placed(rigid::centred_polygon(convex), {center.x(), center.y(), 0});
}

std::vector<Placed> pieces_of(const FluidRegion& region) {
  if (region.has_ball())
    return {placed(rigid::Ball{region.ball().radius()}, to_vector(region.ball().center()))};
  if (region.has_box()) {
    const Eigen::Vector3d min = to_vector(region.box().min()), max = to_vector(region.box().max());
    return {placed(rigid::Box{(max - min) / 2}, (min + max) / 2)};
  }
  rigid::Vertices outline;
  for (const Point& vertex : region.polygon().vertex()) outline.emplace_back(vertex.x(), vertex.y());
  std::vector<Placed> pieces;
  for (const rigid::Vertices& triangle : rigid::triangulate(std::move(outline)))
    pieces.push_back(piece(triangle));
  return pieces;
}

RegionLayout lay_out(const FluidRegion& region, int index, int dimension) {
  RegionLayout result{fmt::format("fluid[{}]", index), pieces_of(region), 0};
  for (const Placed& part : result.pieces) result.volume += rigid::solid(part.shape, dimension).volume;
  return result;
}

rigid::MotionPtr motion_of(const Body& body, const std::string& field, int dimension, Findings& findings) {
  if (!body.has_prescribed()) return nullptr;
  try {
    return to_motion(body, dimension);
  } catch (const rigid::MotionError& error) {
    findings.error(field + ".prescribed." + error.part(),
                   fmt::format("body '{}': {}", body.name(), error.what()));
    return nullptr;
  }
}

std::vector<double> key_times(const Motion& motion) {
  std::vector<double> times;
  for (const Keyframe& key : motion.keyframes().key()) times.push_back(key.time());
  if (motion.has_constant()) times.push_back(motion.constant().start());
  if (motion.has_sinusoid()) times.push_back(motion.sinusoid().start());
  if (motion.has_ramp())
    times.insert(times.end(), {motion.ramp().start(), motion.ramp().start() + motion.ramp().duration()});
  return times;
}

double motion_end(const Body& body, double duration) {
  return body.prescribed().has_release() ? std::min(body.prescribed().release(), duration) : duration;
}

void lay_out(const Body& body, int index, Layout& layout, Findings& findings) {
  const std::string field = fmt::format("body[{}]", index);
  try {
    layout.bodies.push_back({field,
                             body.name(),
                             {to_shape(body, layout.dimension), initial_pose(body, layout.dimension)},
                             motion_of(body, field, layout.dimension, findings),
                             key_times(body.prescribed()),
                             motion_end(body, layout.scene.duration()),
                             body.displaces_fluid(),
                             protocol::moments(body, layout.dimension).volume,
                             least_thickness(body, layout.dimension),
                             least_without_plate_rule(body, layout.dimension)});
  } catch (const std::invalid_argument& error) {
    findings.error(field, fmt::format("body '{}': {}", body.name(), error.what()));
  }
}

}  // namespace

Layout lay_out(const Scene& scene, Findings& findings) {
  Layout layout;
  layout.scene = protocol::with_defaults(scene);
  layout.dimension = static_cast<int>(scene.dimension());
  layout.spacing = scene.spacing();
  layout.tolerance = kTouching * scene.spacing();
  layout.tank = to_tank(layout.scene.domain(), layout.dimension);
  for (int i = 0; i < scene.fluid_size(); ++i)
    layout.regions.push_back(lay_out(scene.fluid(i), i, layout.dimension));
  for (int i = 0; i < scene.body_size(); ++i) lay_out(layout.scene.body(i), i, layout, findings);
  return layout;
}

rigid::Interval extent(const RegionLayout& region, const Eigen::Vector3d& direction, int dimension) {
  rigid::Interval whole{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Placed& part : region.pieces) {
    const rigid::Interval range = rigid::extent(part.shape, part.pose, direction, dimension);
    whole = {std::min(whole.min, range.min), std::max(whole.max, range.max)};
  }
  return whole;
}

double penetration(const std::vector<Placed>& a, const std::vector<Placed>& b, int dimension) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Placed& s : a)
    for (const Placed& t : b)
      deepest = std::max(deepest, rigid::penetration(s.shape, s.pose, t.shape, t.pose, dimension));
  return deepest;
}

std::string side_name(int side) {
  return fmt::format("{}_{}", "xyz"[side / 2], side % 2 == 0 ? "min" : "max");
}

double beyond(const rigid::Interval& range, const rigid::Tank& tank, int side) {
  const int axis = side / 2;
  return side % 2 == 0 ? tank.min[axis] - range.min : range.max - tank.max[axis];
}

}  // namespace sluice::clients
