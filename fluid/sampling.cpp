#include "fluid/sampling.hpp"

#include <cmath>

namespace sluice::fluid {

int layer_count(double support, double spacing) {
  return static_cast<int>(std::ceil(support / spacing - 1e-9));
}

double particle_volume(double spacing, int dimension) {
  return dimension == 2 ? spacing * spacing : spacing * spacing * spacing;
}

namespace {
// A lattice point this near to a surface, in spacings, is on it whatever rounding says, and not inside.
constexpr double kOnSurface = 1e-9;
}  // namespace

std::vector<Eigen::Vector3d> fill(const Shape& shape, const Eigen::Vector3d& center, double spacing,
                                  int dimension) {
  const Bounds box = bounds(shape, dimension);
  std::array<int, 3> count{1, 1, 1};
  for (int a = 0; a < dimension; ++a)
    count[a] = static_cast<int>(std::floor((box.max[a] - box.min[a]) / spacing + 0.5));
  std::vector<Eigen::Vector3d> points;
  for (int c = 0; c < count[2]; ++c)
    for (int b = 0; b < count[1]; ++b)
      for (int a = 0; a < count[0]; ++a) {
        Eigen::Vector3d x = box.min + spacing * Eigen::Vector3d(a + 0.5, b + 0.5, c + 0.5);
        if (dimension == 2) x.z() = 0.0;
        if (signed_distance(shape, x, dimension) < -kOnSurface * spacing) points.push_back(center + x);
      }
  return points;
}

namespace {

// Coordinates along one axis: cells between min and max, and layers beyond its closed sides.
struct Axis {
  std::vector<double> at, width;
  std::vector<bool> inside;
};

Axis divide(double min, double max, bool wall_below, bool wall_above, double spacing, int layers) {
  const int cells = std::max(1, static_cast<int>(std::lround((max - min) / spacing)));
  const double width = (max - min) / cells;
  Axis axis;
  for (int k = wall_below ? -layers : 0; k < cells + (wall_above ? layers : 0); ++k) {
    const bool inside = k >= 0 && k < cells;
    const double beyond = k < 0 ? min + (k + 0.5) * spacing : max + (k - cells + 0.5) * spacing;
    axis.at.push_back(inside ? min + (k + 0.5) * width : beyond);
    axis.width.push_back(inside ? width : spacing);
    axis.inside.push_back(inside);
  }
  return axis;
}

const Axis kFlat{{0.0}, {1.0}, {true}};  // the third axis of a plane

}  // namespace

Boundary sample_walls(const Eigen::Vector3d& min, const Eigen::Vector3d& max,
                      const std::array<bool, 6>& closed, double spacing, double support, int dimension) {
  const int layers = layer_count(support, spacing);
  std::array<Axis, 3> axis{kFlat, kFlat, kFlat};
  for (int a = 0; a < dimension; ++a)
    axis[a] = divide(min[a], max[a], closed[2 * a], closed[2 * a + 1], spacing, layers);
  Boundary walls;
  for (std::size_t c = 0; c < axis[2].at.size(); ++c)
    for (std::size_t b = 0; b < axis[1].at.size(); ++b)
      for (std::size_t a = 0; a < axis[0].at.size(); ++a) {
        if (axis[0].inside[a] && axis[1].inside[b] && axis[2].inside[c]) continue;
        walls.position.emplace_back(axis[0].at[a], axis[1].at[b], axis[2].at[c]);
        walls.volume.push_back(axis[0].width[a] * axis[1].width[b] * axis[2].width[c]);
      }
  return walls;
}

}  // namespace sluice::fluid
