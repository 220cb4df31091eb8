#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid/flat_face.hpp"
#include "fluid/layers.hpp"

namespace sluice::fluid {

namespace {

// Layers of a thick polygon: a point belongs to the face it is nearest to, which mitres the corners.
Boundary sample_thick(const PolygonShape& polygon, double spacing, double support, int layers) {
  Boundary body;
  const std::vector<FlatFace> faces = flat_faces(polygon, 2);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Feet feet(faces[f], spacing);
    const auto add = [&](const Eigen::Vector3d& x) {
      const double own = faces[f].distance(x);
      for (std::size_t other = 0; other < faces.size(); ++other) {
        const double d = faces[other].distance(x);
        if (d > own || (d == own && other < f)) return;
      }
      if (own < -support) return;
      body.position.push_back(x);
      body.volume.push_back(feet.area() * spacing);
      body.to_surface.push_back(-own * faces[f].normal);
    };
    for (int l = 0; l < layers; ++l)
      for (int a = 0; a < feet.n1; ++a) add(feet.at(a, 0) - (l + 0.5) * spacing * faces[f].normal);
  }
  return body;
}

// From x, inside the box, to the nearest of its faces.
Eigen::Vector3d to_face(const BoxShape& box, const Eigen::Vector3d& x, int dimension) {
  int nearest = 0;
  const Eigen::Vector3d depth = box.half_size - x.cwiseAbs();
  for (int a = 1; a < dimension; ++a)
    if (depth[a] < depth[nearest]) nearest = a;
  return (x[nearest] < 0.0 ? -depth[nearest] : depth[nearest]) * Eigen::Vector3d::Unit(nearest);
}

// A box as a lattice of cells that fit it, hollow where no fluid reaches.
Boundary sample_thick(const BoxShape& box, double spacing, int layers, int dimension) {
  std::array<int, 3> count{1, 1, 1};
  Eigen::Vector3d width = Eigen::Vector3d::Ones();
  for (int a = 0; a < dimension; ++a) {
    count[a] = std::max(1, static_cast<int>(std::lround(2 * box.half_size[a] / spacing)));
    width[a] = 2 * box.half_size[a] / count[a];
  }
  Boundary body;
  for (int c = 0; c < count[2]; ++c)
    for (int b = 0; b < count[1]; ++b)
      for (int a = 0; a < count[0]; ++a) {
        const std::array<int, 3> cell{a, b, c};
        bool shell = false;
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        for (int k = 0; k < dimension; ++k) {
          shell = shell || std::min(cell[k], count[k] - 1 - cell[k]) < layers;
          x[k] = -box.half_size[k] + (cell[k] + 0.5) * width[k];
        }
        if (!shell) continue;
        body.position.push_back(x);
        body.volume.push_back(width.prod());
        body.to_surface.push_back(to_face(box, x, dimension));
      }
  return body;
}

// Points of a circle, or of a sphere by the golden-angle spiral (A. Gonzalez, Math. Geosci. 42, 2010).
std::vector<Eigen::Vector3d> shell_points(double radius, int count, int dimension) {
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < count; ++k) {
    const double z = dimension == 3 ? 1.0 - (2.0 * k + 1.0) / count : 0.0;
    const double angle = dimension == 3 ? golden_angle * k : 2.0 * std::numbers::pi * k / count;
    const double rho = std::sqrt(1.0 - z * z);
    points.push_back(radius * Eigen::Vector3d(rho * std::cos(angle), rho * std::sin(angle), z));
  }
  return points;
}

double ball_volume(double radius, int dimension) {
  const double r = std::max(radius, 0.0);
  return dimension == 2 ? std::numbers::pi * r * r : 4.0 / 3.0 * std::numbers::pi * r * r * r;
}

double ball_surface(double radius, int dimension) {
  return dimension == 2 ? 2.0 * std::numbers::pi * radius : 4.0 * std::numbers::pi * radius * radius;
}

// Concentric shells, each with the volume of its layer.
Boundary sample_ball(const BallShape& ball, double spacing, int layers, int dimension) {
  Boundary body;
  for (int l = 0; l < layers && ball.radius > l * spacing; ++l) {
    const double outer = ball.radius - l * spacing, inner = outer - spacing;
    const double radius = std::max(outer - 0.5 * spacing, 0.0);
    const double cell = dimension == 2 ? spacing : spacing * spacing;
    const int count = std::max(1, static_cast<int>(std::lround(ball_surface(radius, dimension) / cell)));
    const double volume = (ball_volume(outer, dimension) - ball_volume(inner, dimension)) / count;
    for (const Eigen::Vector3d& x : shell_points(count == 1 ? 0.0 : radius, count, dimension)) {
      body.position.push_back(x);
      body.volume.push_back(volume);
      // A particle at the centre is as near to one side as to the other.
      const Eigen::Vector3d outward =
          x.norm() > 0.0 ? Eigen::Vector3d(x.normalized()) : Eigen::Vector3d::UnitX();
      body.to_surface.push_back((ball.radius - x.norm()) * outward);
    }
  }
  return body;
}

}  // namespace

Boundary sample_thick(const Shape& shape, double spacing, double support, int dimension) {
  const int layers = layer_count(support, spacing);
  if (const auto* box = std::get_if<BoxShape>(&shape)) return sample_thick(*box, spacing, layers, dimension);
  if (const auto* ball = std::get_if<BallShape>(&shape))
    return sample_ball(*ball, spacing, layers, dimension);
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape))
    return sample_cylinder(*cylinder, spacing, layers);
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) return sample_mesh(*mesh, spacing, layers);
  if (const auto* compound = std::get_if<CompoundShape>(&shape))
    return sample_compound(*compound, spacing, support, dimension);
  const auto& polygon = std::get<PolygonShape>(shape);
  return is_convex(polygon) ? sample_thick(polygon, spacing, support, layers)
                            : sample_outline(polygon, spacing, layers);
}

Boundary sample_body(const Shape& shape, double spacing, double support, int dimension) {
  return needs_plate_rule(shape, support, dimension) ? sample_plate(shape, spacing, support, dimension)
                                                     : sample_thick(shape, spacing, support, dimension);
}

}  // namespace sluice::fluid
