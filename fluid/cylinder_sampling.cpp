#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid/layers.hpp"

namespace sluice::fluid {

namespace {

// Of a cylinder along z.
Eigen::Vector3d to_surface(const Eigen::Vector3d& x, double radius, double half_length) {
  const double across = x.head<2>().norm(), side = radius - across, end = half_length - std::abs(x.z());
  if (end < side) return {0, 0, x.z() < 0 ? -end : end};
  if (across == 0) return {side, 0, 0};
  return {side * x.x() / across, side * x.y() / across, 0};
}

// z to the axis, the others after it in order.
Eigen::Vector3d turned(const Eigen::Vector3d& x, int axis) {
  Eigen::Vector3d y;
  y[axis] = x.z();
  y[(axis + 1) % 3] = x.x();
  y[(axis + 2) % 3] = x.y();
  return y;
}

}  // namespace

Boundary sample_cylinder(const CylinderShape& cylinder, double spacing, int layers) {
  const double R = cylinder.radius, H = cylinder.half_length;
  const int slices = std::max(1, static_cast<int>(std::lround(2 * H / spacing)));
  const int rings = std::max(1, static_cast<int>(std::lround(R / spacing)));
  const double thick = 2 * H / slices, width = R / rings;
  Boundary body;
  for (int s = 0; s < slices; ++s)
    for (int r = 0; r < rings; ++r) {
      if (r >= layers && std::min(s, slices - 1 - s) >= layers) continue;
      const double outer = R - r * width, inner = outer - width, radius = (outer + inner) / 2;
      const double area = std::numbers::pi * (outer * outer - inner * inner);
      const int count = std::max(1, static_cast<int>(std::lround(area / (width * spacing))));
      for (int k = 0; k < count; ++k) {
        // Every other slice is turned by half a step, so that no rows form along the side.
        const double angle = 2 * std::numbers::pi * (k + 0.5 * (s % 2)) / count;
        const Eigen::Vector3d x(radius * std::cos(angle), radius * std::sin(angle), -H + (s + 0.5) * thick);
        body.position.push_back(turned(x, cylinder.axis));
        body.volume.push_back(area * thick / count);
        body.to_surface.push_back(turned(to_surface(x, R, H), cylinder.axis));
      }
    }
  return body;
}

}  // namespace sluice::fluid
