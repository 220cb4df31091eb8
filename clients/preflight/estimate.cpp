#include <algorithm>
#include <cmath>

#include "clients/preflight/checks.hpp"
#include "protocol/liquids.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::clients {
namespace {

// Of all processes together: what they need without particles, and per particle (state twice because it is
// sorted, neighbour lists, a frame on its way to the recorder). Measured to a factor of two.
constexpr double kBaseBytes = 60e6, kFluidBytes = 700, kBoundaryBytes = 200;
// Particle steps a second of one thread in two and three dimensions.
constexpr double kSpeed2 = 1.5e6, kSpeed3 = 0.2e6;
// Several liquids go particle by particle.
constexpr double kSeveralLiquids = 3;

// In space, the box around a body that is no box or ball itself: asking for every point takes too long.
Placed simple(const Placed& body, int dimension) {
  if (dimension == 2 || std::holds_alternative<rigid::Box>(body.shape) ||
      std::holds_alternative<rigid::Ball>(body.shape))
    return body;
  Eigen::Vector3d low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const rigid::Interval range = rigid::extent(body.shape, body.pose, Eigen::Vector3d::Unit(axis), 3);
    low[axis] = range.min;
    high[axis] = range.max;
  }
  return {rigid::Box{(high - low) / 2}, {(low + high) / 2, Eigen::Quaterniond::Identity()}};
}

// Share of the body that stands in liquid, from points on a grid over its bounds.
double submerged_share(const BodyLayout& body, const Layout& layout) {
  constexpr int kGrid = 12;
  const Placed placed = simple(body.placed, layout.dimension);
  const double radius = rigid::bounding_radius(placed.shape, layout.dimension);
  int inside = 0, wet = 0;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j)
      for (int k = 0; k < (layout.dimension == 3 ? kGrid : 1); ++k) {
        const auto at = [&](int n) { return radius * ((2.0 * n + 1) / kGrid - 1); };
        Eigen::Vector3d x = placed.pose.position + Eigen::Vector3d(at(i), at(j), 0);
        if (layout.dimension == 3) x.z() += at(k);
        const std::vector<Placed> point{{rigid::Ball{0}, {x, Eigen::Quaterniond::Identity()}}};
        if (penetration({placed}, point, layout.dimension) <= 0) continue;
        ++inside;
        for (const RegionLayout& region : layout.regions)
          if (penetration(region.pieces, point, layout.dimension) > 0) {
            ++wet;
            break;
          }
      }
  return inside == 0 ? 0 : static_cast<double>(wet) / inside;
}

double fluid_volume(const Layout& layout) {
  double volume = 0;
  for (const RegionLayout& region : layout.regions) volume += region.volume;
  for (const BodyLayout& body : layout.bodies)
    if (body.displaces_fluid) volume -= submerged_share(body, layout) * body.volume;
  return std::max(volume, 0.0);
}

double wall_particles(const Layout& layout, double layers) {
  double inside = 1, outside = 1;
  for (int axis = 0; axis < layout.dimension; ++axis) {
    const double across = (layout.tank.max[axis] - layout.tank.min[axis]) / layout.spacing;
    inside *= across;
    outside *= across + layers * (layout.tank.closed[2 * axis] + layout.tank.closed[2 * axis + 1]);
  }
  return outside - inside;
}

// Buffers behind the openings, as deep as two supports (fluid/openings.hpp); they stand in no frame. An
// inflow's may be dry in part.
double buffer_particles(const Layout& layout, double support) {
  double particles = 0;
  for (const Opening& opening : layout.scene.opening()) {
    double cells = std::ceil(2 * support / layout.spacing);
    for (int entry = 0; entry < opening.min_size(); ++entry)
      cells *= (opening.max(entry) - opening.min(entry)) / layout.spacing;
    particles += cells;
  }
  return particles;
}

// Layers below the surface; of a thick body no more than fill it, of a thin one each face has its own.
double body_volume_in_particles(const BodyLayout& body, const Layout& layout, double support) {
  const rigid::Shape& shape = body.placed.shape;
  const double layers = rigid::surface(shape, layout.dimension) * support;
  const bool thin =
      rigid::thickness(shape, layout.dimension) < 2 * support &&
      (std::holds_alternative<rigid::Box>(shape) || std::holds_alternative<rigid::Polygon>(shape));
  return thin ? layers : std::min(layers, body.volume);
}

}  // namespace

Estimate estimate(const Layout& layout) {
  const auto& formulation = layout.scene.formulation();
  // One layer of forces, a third of a spacing apart, has as many particles as so many layers.
  const double layers = formulation.boundary() == FORCES ? std::pow(3, layout.dimension - 1)
                                                         : std::ceil(2 * formulation.smoothing() - 1e-9);
  const double h = formulation.smoothing() * layout.spacing;
  const double particle = std::pow(layout.spacing, layout.dimension);

  double boundary = wall_particles(layout, layers);
  for (const BodyLayout& body : layout.bodies)
    boundary += body_volume_in_particles(body, layout, layers * layout.spacing) / particle;
  const double fluid = fluid_volume(layout) / particle;
  const double moved = fluid + buffer_particles(layout, 2 * h);

  Estimate result;
  result.fluid_particles = static_cast<std::uint64_t>(std::llround(fluid));
  result.boundary_particles = static_cast<std::uint64_t>(std::llround(boundary));
  result.memory_bytes =
      static_cast<std::uint64_t>(kBaseBytes + kFluidBytes * moved + kBoundaryBytes * boundary);
  const double step =
      formulation.courant() * h / (protocol::fastest_sound(layout.scene) + layout.scene.liquid().max_speed());
  const auto clock =
      protocol::StepClock::for_run(layout.scene.duration(), layout.scene.output().rate(), step);
  result.steps = clock.steps();
  result.frames = clock.steps() / clock.steps_per_interval() + 1;
  result.run_seconds =
      moved * static_cast<double>(result.steps) / (layout.dimension == 2 ? kSpeed2 : kSpeed3);
  if (layout.scene.other_liquid_size() > 0) result.run_seconds *= kSeveralLiquids;
  return result;
}

}  // namespace sluice::clients
