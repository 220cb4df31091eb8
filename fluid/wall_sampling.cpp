#include <cmath>

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

Layers layers_of(const Tank& tank, std::size_t side, double spacing, double support) {
  const int depth = layer_count(support, spacing);
  // Beyond a side with images walls are needed as far as fluid inside may see them, neighbour lists' skin
  // included.
  if (tank.periodic[side / 2] || tank.mirrored[side]) return {2 * depth, true};
  return {tank.closed[side] ? depth : 0, false};
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
        Eigen::Vector3d to_surface = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();
        for (int k = 0; k < dimension; ++k) {
          if (side[k] == 0) continue;
          to_surface[k] = (side[k] < 0 ? tank.min[k] : tank.max[k]) - x[k];
          velocity += tank.velocity[2 * k + (side[k] < 0 ? 0 : 1)];
        }
        walls.position.push_back(x);
        walls.to_surface.push_back(to_surface);
        walls.velocity.push_back(velocity);
        walls.volume.push_back(axis[0].width[a] * axis[1].width[b] * axis[2].width[c]);
      }
  return walls;
}

}  // namespace sluice::fluid
