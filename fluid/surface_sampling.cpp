#include <algorithm>

#include "fluid/layers.hpp"

namespace sluice::fluid {

double surface_spacing(double spacing) {
  return spacing / 3.0;
}

// The first of the layers dx/3 thick.
Boundary sample_wall_surface(const Tank& tank, double spacing, double beyond, int dimension) {
  const double edge = surface_spacing(spacing);
  const Boundary layers = sample_walls(tank, edge, beyond, dimension);
  Boundary surface;
  for (std::size_t w = 0; w < layers.position.size(); ++w) {
    const Eigen::Vector3d& way = layers.to_surface[w];
    const bool is_in_edge = (way.array() != 0.0).count() > 1;
    if (is_in_edge || way.norm() > edge) continue;
    surface.position.push_back(layers.position[w]);
    surface.volume.push_back(layers.volume[w]);
    surface.to_surface.push_back(way);
    surface.velocity.push_back(layers.velocity[w]);
  }
  return surface;
}

Boundary sample_body_surface(const Shape& shape, double spacing, int dimension) {
  const double edge = surface_spacing(spacing);
  return sample_thick(shape, edge, edge, dimension);
}

}  // namespace sluice::fluid
