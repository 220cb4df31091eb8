#include <algorithm>
#include <cmath>
#include <optional>

#include "fluid/sampling.hpp"

namespace sluice::fluid {

namespace {

// Coordinates along one axis: cells between min and max, and layers beyond its sides.
struct Axis {
  std::vector<double> at, width;
  std::vector<int> side;  // -1 below the tank, 1 above, 0 between
};

// Layers beyond a side: of the wall, or of the tank's images, which are as good as inside.
struct Layers {
  int count;
  bool inside;
};

Axis divide(double min, double max, const Layers& below, const Layers& above, double spacing) {
  const int cells = std::max(1, static_cast<int>(std::lround((max - min) / spacing)));
  const double width = (max - min) / cells;
  Axis axis;
  for (int k = -below.count; k < cells + above.count; ++k) {
    const int side = k < 0 ? -1 : k >= cells ? 1 : 0;
    const bool inside = side == 0 || (side < 0 ? below : above).inside;
    const double beyond = side < 0 ? min + (k + 0.5) * spacing : max + (k - cells + 0.5) * spacing;
    axis.at.push_back(inside ? min + (k + 0.5) * width : beyond);
    axis.width.push_back(inside ? width : spacing);
    axis.side.push_back(inside ? 0 : side);
  }
  return axis;
}

const Axis kFlat{{0.0}, {1.0}, {0}};  // the third axis of a plane

bool has_opening(const Tank& tank, int side) {
  return std::any_of(tank.openings.begin(), tank.openings.end(),
                     [side](const Opening& opening) { return opening.side == side; });
}

Layers layers_of(const Tank& tank, std::size_t side, double spacing, double support) {
  const int depth = layer_count(support, spacing);
  if (has_opening(tank, static_cast<int>(side))) return {2 * depth, false};
  // Beyond a side with images walls are needed as far as fluid inside may see them, neighbour lists' skin
  // included.
  if (tank.periodic[side / 2] || tank.mirrored[side]) return {2 * depth, true};
  return {tank.closed[side] ? depth : 0, false};
}

// From x beyond `side` to the nearest channel behind an opening there: in its plane; nothing without
// openings.
std::optional<Eigen::Vector3d> way_to_channel(const Tank& tank, int side, const Eigen::Vector3d& x) {
  const Eigen::Vector3d in_tank = x.cwiseMax(tank.min).cwiseMin(tank.max);
  std::optional<Eigen::Vector3d> nearest;
  for (const Opening& opening : tank.openings) {
    if (opening.side != side) continue;
    Eigen::Vector3d way = in_tank.cwiseMax(opening.min).cwiseMin(opening.max) - in_tank;
    way[side / 2] = 0.0;
    if (!nearest || way.squaredNorm() < nearest->squaredNorm()) nearest = way;
  }
  return nearest;
}

// A point counts for the channel's wall rather than for the side if the channel is nearer than this times the
// side: else what passes the lip of a nozzle is held back by the side's first particles there.
constexpr double kLip = 1.5;

// The way from x [m] to the surface of the wall; nothing where there is no wall. `beyond` says of every axis
// on which side of the tank x is, -1, 0 or 1. Behind an opening the tank goes on as a channel, with walls
// `depth` [m] thick.
std::optional<Eigen::Vector3d> way_to_surface(const Tank& tank, const Eigen::Vector3d& x,
                                              const std::array<int, 3>& beyond, double depth) {
  const bool is_corner = std::count(beyond.begin(), beyond.end(), 0) < 2;
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (int a = 0; a < 3; ++a) {
    if (beyond[a] == 0) continue;
    const int side = 2 * a + (beyond[a] < 0 ? 0 : 1);
    const double to_side = (beyond[a] < 0 ? tank.min : tank.max)[a] - x[a];
    const auto to_channel = way_to_channel(tank, side, x);
    if (to_channel && to_channel->isZero(0)) continue;
    if (!tank.closed[side]) return std::nullopt;
    if (to_channel && !is_corner && to_channel->norm() < std::min(depth, kLip * std::abs(to_side)))
      way += *to_channel;
    else
      way[a] = to_side;
  }
  if (way.isZero(0) || way.cwiseAbs().maxCoeff() > depth) return std::nullopt;
  return way;
}

}  // namespace

std::array<Eigen::Vector3d, 6> Tank::zeros() {
  std::array<Eigen::Vector3d, 6> velocity;
  velocity.fill(Eigen::Vector3d::Zero());
  return velocity;
}

Boundary sample_walls(const Tank& tank, double spacing, double support, int dimension) {
  std::array<Axis, 3> axis{kFlat, kFlat, kFlat};
  for (int a = 0; a < dimension; ++a)
    axis[a] = divide(tank.min[a], tank.max[a], layers_of(tank, 2 * a, spacing, support),
                     layers_of(tank, 2 * a + 1, spacing, support), spacing);
  Boundary walls;
  walls.no_slip = tank.no_slip;
  for (std::size_t c = 0; c < axis[2].at.size(); ++c)
    for (std::size_t b = 0; b < axis[1].at.size(); ++b)
      for (std::size_t a = 0; a < axis[0].at.size(); ++a) {
        const std::array<int, 3> side{axis[0].side[a], axis[1].side[b], axis[2].side[c]};
        if (side == std::array<int, 3>{0, 0, 0}) continue;
        const Eigen::Vector3d x(axis[0].at[a], axis[1].at[b], axis[2].at[c]);
        const auto to_surface = way_to_surface(tank, x, side, layer_count(support, spacing) * spacing);
        if (!to_surface) continue;
        Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
        for (int k = 0; k < dimension; ++k)
          if (side[k] != 0) velocity += tank.velocity[2 * k + (side[k] < 0 ? 0 : 1)];
        walls.position.push_back(x);
        walls.to_surface.push_back(*to_surface);
        walls.velocity.push_back(velocity);
        walls.volume.push_back(axis[0].width[a] * axis[1].width[b] * axis[2].width[c]);
      }
  return walls;
}

}  // namespace sluice::fluid
