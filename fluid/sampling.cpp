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

}  // namespace sluice::fluid
